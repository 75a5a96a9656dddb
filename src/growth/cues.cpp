#include "sensory_growth/growth/cues.h"

#include <algorithm>
#include <cmath>

#include "kernels/cue_kernels.h"

namespace sensory_growth::growth {
namespace {

/// Length of the vector and the softening taken together, free of overflow and underflow.
double softened(const rod::Vector3& v, double softening) {
  const double square = v.squaredNorm() + softening * softening;
  return std::isnormal(square) ? std::sqrt(square) : std::hypot(v.stableNorm(), softening);
}

/// d1 and d2 of a frame: the first two columns of its matrix.
Eigen::Matrix<double, 3, 2> sectionAxes(const rod::Quaternion& q) {
  const double x2 = 2.0 * q.x(), y2 = 2.0 * q.y(), z2 = 2.0 * q.z();
  Eigen::Matrix<double, 3, 2> axes;
  axes << 1.0 - (y2 * q.y() + z2 * q.z()), x2 * q.y() - z2 * q.w(),  //
      x2 * q.y() + z2 * q.w(), 1.0 - (x2 * q.x() + z2 * q.z()),      //
      x2 * q.z() - y2 * q.w(), y2 * q.z() + x2 * q.w();
  return axes;
}

/// Frames and places of the bends from `first` on; the last one again where there are no more.
void gather(const rod::Rod& rod, std::size_t first, kernels::BendPacket& bends) {
  const auto put = [](const rod::Quaternion& q, double(&frames)[4][kernels::kBends], std::size_t i) {
    frames[0][i] = q.w(), frames[1][i] = q.x(), frames[2][i] = q.y(), frames[3][i] = q.z();
  };
  for (std::size_t i = 0; i < kernels::kBends; ++i) {
    const std::size_t j = std::min(first + i, rod.size() - 1);
    put(j > 0 ? rod.elements[j - 1].frame : rod.base.frame, bends.below, i);
    put(rod.elements[j].frame, bends.above, i);
    for (int k = 0; k < 3; ++k) bends.position[k][i] = rod.vertices[j].position[k];
  }
}

Eigen::Vector2d component(const kernels::FieldPacket& field, std::size_t i) {
  return {field.along[0][i], field.along[1][i]};
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

std::optional<std::string> findFault(const Senses& senses) {
  const Oscillator& o = senses.oscillator;
  for (const double value :
       {senses.gravity, senses.light_direction, senses.point_source, o.amplitude, o.phase, o.phase_gradient}) {
    if (!std::isfinite(value)) return "sensitivities and the oscillator must be finite";
  }
  if (!(senses.softening_length >= 0.0) || !std::isfinite(senses.softening_length)) {
    return "softening_length must be >= 0 m";
  }
  if (!(senses.intensity_exponent > 0.0) || !std::isfinite(senses.intensity_exponent)) {
    return "intensity_exponent must be > 0";
  }
  if (!(std::abs(o.period) > 0.0)) return "period of circumnutation must not be 0 s";
  return findFault(senses.distance, senses.softening_length);
}

CueField::CueField(const Senses& senses, const Environment& environment, double time)
    : senses_(senses),
      point_sources_(environment.point_sources),
      later_(time - environment.time),
      up_(-senses.gravity * environment.down),
      towards_lights_(rod::Vector3::Zero()),
      apical_phase_(kTurn * time / senses.oscillator.period + senses.oscillator.phase) {
  for (const LightDirection& light : environment.light_directions) {
    towards_lights_ += senses.light_direction * response(light.strength) * light.towards;
  }
}

SectionCues CueField::at(const Place& place) const {
  const auto section = [axes = sectionAxes(place.frame)](const rod::Vector3& v) -> Eigen::Vector2d {
    return {axes.col(0).dot(v), axes.col(1).dot(v)};
  };
  // In the order of Cue.
  return {section(up_), section(towards_lights_), section(towardsPointSources(place.position)),
          oscillation(place.from_apex)};
}

/// Weber's and Fechner's kind of answer: not to the strength of a stimulus, but to a power of it.
double CueField::response(double strength) const {
  const double exponent = senses_.intensity_exponent;
  return exponent == 1.0 ? strength : std::copysign(std::pow(std::abs(strength), exponent), strength);
}

rod::Vector3 CueField::towardsPointSources(const rod::Vector3& position) const {
  rod::Vector3 sum = rod::Vector3::Zero();
  for (const PointSource& source : point_sources_) {
    const rod::Vector3 towards = source.place(later_) - position;
    const double distance = softened(towards, senses_.softening_length);
    if (!(distance > 0.0)) continue;
    sum += (senses_.point_source * response(source.strength) * factor(senses_.distance, distance) / distance) * towards;
  }
  return sum;
}

Eigen::Vector2d CueField::oscillation(double from_apex) const {
  const Oscillator& oscillator = senses_.oscillator;
  if (oscillator.amplitude == 0.0) return Eigen::Vector2d::Zero();
  const double phase = apical_phase_ - oscillator.phase_gradient * from_apex;
  return oscillator.amplitude * Eigen::Vector2d(std::cos(phase), std::sin(phase));
}

void CueField::along(const rod::Rod& rod, CueFields& cues) const {
  const std::size_t n = rod.size();
  for (SectionField& cue : cues) cue.assign(n, Eigen::Vector2d::Zero());
  const auto field = [&cues](Cue cue) { return cues[static_cast<std::size_t>(cue)].data(); };
  const kernels::CueKernels& loops = kernels::cueKernels();
  kernels::BendPacket bends;
  kernels::SectionPacket section;
  kernels::FieldPacket everywhere;
  kernels::PullPacket pull;
  for (std::size_t first = rod.firstBend(); first < n; first += kernels::kBends) {
    const std::size_t count = std::min(kernels::kBends, n - first);
    gather(rod, first, bends);
    loops.section(bends, section);
    const auto project = [&](Cue cue, const rod::Vector3& vector) {
      if (vector.isZero(0.0)) return;
      loops.project(section, {vector.x(), vector.y(), vector.z()}, everywhere);
      for (std::size_t i = 0; i < count; ++i) field(cue)[first + i] = component(everywhere, i);
    };
    project(Cue::gravity, up_);
    project(Cue::light_direction, towards_lights_);
    bool are_normal = true;
    for (const PointSource& source : point_sources_) {
      const rod::Vector3 place = source.place(later_);
      const double strength = senses_.point_source * response(source.strength);
      are_normal = loops.pull(bends, section, {place.x(), place.y(), place.z()}, senses_.softening_length, pull);
      if (!are_normal) break;
      for (std::size_t i = 0; i < count; ++i) {
        field(Cue::point_source)[first + i] +=
            strength * factor(senses_.distance, pull.distance[i]) * component(pull.direction, i);
      }
    }
    for (std::size_t j = first; !are_normal && j < first + count; ++j) {
      const Eigen::Matrix<double, 3, 2> axes = sectionAxes(rod.bendFrame(j));
      field(Cue::point_source)[j] = axes.transpose() * towardsPointSources(rod.vertices[j].position);
    }
  }
  if (senses_.oscillator.amplitude == 0.0) return;
  double from_apex = rod.restLength();
  for (std::size_t j = 0; j < n; ++j) {
    if (j >= rod.firstBend()) field(Cue::oscillator)[j] = oscillation(from_apex);
    from_apex -= rod.elements[j].rest_length;
  }
}

void sense(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod, CueFields& cues) {
  CueField(senses, environment, time).along(rod, cues);
}

}  // namespace sensory_growth::growth
