#pragma once

/// What surrounds the organs and can be sensed.

#include <string>
#include <vector>

#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::growth {

/// A lamp, or anything else that attracts (strength > 0) or repels from one place.
struct PointSource {
  std::string id;                                ///< unique among point sources
  rod::Vector3 position = rod::Vector3::Zero();  ///< [m]
  double strength = 1.0;                         ///< [-]
  rod::Vector3 velocity = rod::Vector3::Zero();  ///< per second of growth time [m/s]

  /// Where it is `later` [s] than the time for which `position` holds.
  rod::Vector3 place(double later) const { return position + later * velocity; }
};

/// Parallel light, such as that of the sun.
struct LightDirection {
  std::string id;                                ///< unique among light directions
  rod::Vector3 towards = rod::Vector3::UnitX();  ///< unit vector that points to the light
  double strength = 1.0;                         ///< [-]
};

/// Everything outside an organ that it can sense.
struct Environment {
  double time = 0.0;                           ///< growth time at which all this holds [s]
  rod::Vector3 down = -rod::Vector3::UnitZ();  ///< unit vector of gravity as it is sensed; zero in weightlessness
  std::vector<PointSource> point_sources;
  std::vector<LightDirection> light_directions;
};

}  // namespace sensory_growth::growth
