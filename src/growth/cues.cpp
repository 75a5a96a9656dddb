#include "sensory_growth/growth/cues.h"

#include <cmath>

namespace sensory_growth::growth {
namespace {

/// Length of the vector and the softening taken together, free of overflow and underflow.
double softened(const rod::Vector3& v, double softening) {
  const double square = v.squaredNorm() + softening * softening;
  return std::isnormal(square) ? std::sqrt(square) : std::hypot(v.stableNorm(), softening);
}

}  // namespace

CueField::CueField(const Sensitivities& sensitivities, const Environment& environment)
    : sensitivities_(sensitivities), point_sources_(environment.point_sources) {
  everywhere_ = -sensitivities.gravity * environment.down;
  for (const LightDirection& light : environment.light_directions) {
    everywhere_ += sensitivities.light_direction * light.strength * light.towards;
  }
}

rod::Vector3 CueField::at(const rod::Vector3& position) const {
  rod::Vector3 delta = everywhere_;
  for (const PointSource& source : point_sources_) {
    const rod::Vector3 towards = source.position - position;
    const double distance = softened(towards, sensitivities_.softening_length);
    if (distance > 0.0) delta += (sensitivities_.point_source * source.strength / distance) * towards;
  }
  return delta;
}

rod::Vector3 differentialGrowth(const Sensitivities& sensitivities, const Environment& environment,
                                const rod::Vector3& position) {
  return CueField(sensitivities, environment).at(position);
}

}  // namespace sensory_growth::growth
