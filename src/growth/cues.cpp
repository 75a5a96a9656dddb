#include "sensory_growth/growth/cues.h"

#include <cmath>

namespace sensory_growth::growth {

rod::Vector3 differentialGrowth(const Sensitivities& sensitivities, const Environment& environment,
                                const rod::Vector3& position) {
  rod::Vector3 delta = -sensitivities.gravity * environment.down;
  for (const LightDirection& light : environment.light_directions) {
    delta += sensitivities.light_direction * light.strength * light.towards;
  }
  for (const PointSource& source : environment.point_sources) {
    const rod::Vector3 towards = source.position - position;
    const double distance = std::hypot(towards.stableNorm(), sensitivities.softening_length);
    if (distance > 0.0) delta += sensitivities.point_source * source.strength * (towards / distance);
  }
  return delta;
}

}  // namespace sensory_growth::growth
