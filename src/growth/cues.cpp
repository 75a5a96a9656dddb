#include "sensory_growth/growth/cues.h"

#include <cmath>

namespace sensory_growth::growth {
namespace {

/// Length of the vector and the softening taken together, free of overflow and underflow.
double softened(const rod::Vector3& v, double softening) {
  const double square = v.squaredNorm() + softening * softening;
  return std::isnormal(square) ? std::sqrt(square) : std::hypot(v.stableNorm(), softening);
}

constexpr double kTurn = 6.283185307179586;

}  // namespace

const char* name(Cue cue) {
  switch (cue) {
    case Cue::gravity:
      return "gravity";
    case Cue::light_direction:
      return "light_direction";
    case Cue::point_source:
      return "point_source";
    case Cue::oscillator:
      return "oscillator";
  }
  return "?";
}

CueField::CueField(const Senses& senses, const Environment& environment, double time)
    : senses_(senses),
      point_sources_(environment.point_sources),
      later_(time - environment.time),
      up_(-senses.gravity * environment.down),
      towards_lights_(rod::Vector3::Zero()),
      apical_phase_(kTurn * time / senses.oscillator.period + senses.oscillator.phase) {
  for (const LightDirection& light : environment.light_directions) {
    towards_lights_ += senses.light_direction * light.strength * light.towards;
  }
}

SectionCues CueField::at(const Place& place) const {
  const auto section = [directors = place.frame.toRotationMatrix()](const rod::Vector3& v) -> Eigen::Vector2d {
    return directors.leftCols<2>().transpose() * v;
  };
  // In the order of Cue.
  return {section(up_), section(towards_lights_), section(towardsPointSources(place.position)),
          oscillation(place.from_apex)};
}

rod::Vector3 CueField::towardsPointSources(const rod::Vector3& position) const {
  rod::Vector3 sum = rod::Vector3::Zero();
  for (const PointSource& source : point_sources_) {
    const rod::Vector3 towards = source.place(later_) - position;
    const double distance = softened(towards, senses_.softening_length);
    if (distance > 0.0) sum += (senses_.point_source * source.strength / distance) * towards;
  }
  return sum;
}

Eigen::Vector2d CueField::oscillation(double from_apex) const {
  const Oscillator& oscillator = senses_.oscillator;
  if (oscillator.amplitude == 0.0) return Eigen::Vector2d::Zero();
  const double phase = apical_phase_ - oscillator.phase_gradient * from_apex;
  return oscillator.amplitude * Eigen::Vector2d(std::cos(phase), std::sin(phase));
}

void sense(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod, CueFields& cues) {
  const CueField field(senses, environment, time);
  for (SectionField& cue : cues) cue.assign(rod.size(), Eigen::Vector2d::Zero());
  double from_apex = rod.restLength();
  for (std::size_t j = 0; j < rod.size(); ++j) {
    if (j >= rod.firstBend()) {
      const SectionCues here = field.at({rod.vertices[j].position, rod.bendFrame(j), from_apex});
      for (std::size_t cue = 0; cue < kCues; ++cue) cues[cue][j] = here[cue];
    }
    from_apex -= rod.elements[j].rest_length;
  }
}

}  // namespace sensory_growth::growth
