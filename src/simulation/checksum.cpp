#include "sensory_growth/simulation/checksum.h"

#include <xxhash.h>

#include "sensory_growth/simulation/parameters.h"

namespace sensory_growth::simulation {

void Checksum::add(const std::string& text) {
  add(std::uint64_t{text.size()});
  bytes_ += text;
}

void Checksum::add(const rod::Section& section) {
  for (const double value :
       {section.radius, section.young_modulus, section.shear_modulus, section.density, section.shear_correction}) {
    add(value);
  }
  add(std::uint64_t{section.inextensible});
}

void Checksum::add(const rod::Rod& rod) {
  add(rod.base.position);
  add(rod.base.frame);
  add(static_cast<std::uint64_t>(rod.base_support));
  add(std::uint64_t{rod.size()});
  for (const rod::Element& element : rod.elements) {
    add(element.rest_length);
    add(element.reference_length);
    add(element.section);
    add(element.age);
    add(element.strain);
    add(element.rest_strain);
    add(element.frame);
    add(element.angular_velocity);
  }
  for (const rod::Bend& bend : rod.bends) {
    add(bend.curvature);
    add(bend.rest_curvature);
  }
  for (const rod::Vertex& vertex : rod.vertices) {
    add(vertex.position);
    add(vertex.label);
    add(vertex.velocity);
  }
}

void Checksum::add(const growth::Environment& environment) {
  add(environment.time);
  add(environment.down);
  add(std::uint64_t{environment.point_sources.size()});
  for (const growth::PointSource& source : environment.point_sources) {
    add(source.id);
    add(source.position);
    add(source.strength);
    add(source.velocity);
  }
  add(std::uint64_t{environment.light_directions.size()});
  for (const growth::LightDirection& light : environment.light_directions) {
    add(light.id);
    add(light.towards);
    add(light.strength);
  }
}

std::uint64_t Checksum::value() const { return XXH3_64bits(bytes_.data(), bytes_.size()); }

std::uint64_t checksum(const Simulation& simulation) {
  Checksum sum;
  sum.add(simulation.stepIndex());
  sum.add(simulation.gravity());
  sum.add(simulation.environment());
  for (const Organ& organ : simulation.organs()) {
    sum.add(organ.scenario().id);
    sum.add(organ.rod());
    for (const Parameter& parameter : parameters()) {
      const std::optional<double> value = parameter.get(organ.scenario());
      sum.add(std::uint64_t{value.has_value()});
      sum.add(value.value_or(0.0));
    }
  }
  return sum.value();
}

}  // namespace sensory_growth::simulation
