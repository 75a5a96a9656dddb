#pragma once

/// From what surrounds an organ to the differential growth vector at a point of it (model.md 4.3).

#include <string>
#include <vector>

#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::growth {

/// A lamp, or anything else that attracts (strength > 0) or repels from one place.
struct PointSource {
  std::string id;                                ///< unique among point sources
  rod::Vector3 position = rod::Vector3::Zero();  ///< [m]
  double strength = 1.0;                         ///< [-]
};

/// Parallel light, such as that of the sun.
struct LightDirection {
  std::string id;                                ///< unique among light directions
  rod::Vector3 towards = rod::Vector3::UnitX();  ///< unit vector that points to the light
  double strength = 1.0;                         ///< [-]
};

/// Everything that can be sensed.
struct Environment {
  rod::Vector3 down = -rod::Vector3::UnitZ();  ///< unit vector of gravity as it is sensed; zero in weightlessness
  std::vector<PointSource> point_sources;
  std::vector<LightDirection> light_directions;
};

/// How strongly an organ answers each cue. All sensitivities are dimensionless; a negative one turns away.
struct Sensitivities {
  double gravity = 0.0;  ///< > 0 for a shoot (grows up), < 0 for a root
  double light_direction = 0.0;
  double point_source = 0.0;
  double softening_length =
      0.0;  ///< distance to a point source below which its pull fades, so that it stays finite [m]
};

/// The lab-frame differential growth vector [-] as a function of place. Must not outlive its arguments.
class CueField {
 public:
  CueField(const Sensitivities& sensitivities, const Environment& environment);

  /// Finite for every finite input.
  rod::Vector3 at(const rod::Vector3& position) const;

 private:
  const Sensitivities& sensitivities_;
  const std::vector<PointSource>& point_sources_;
  rod::Vector3 everywhere_;  ///< of the cues that come from afar
};

/// The field at one place.
rod::Vector3 differentialGrowth(const Sensitivities& sensitivities, const Environment& environment,
                                const rod::Vector3& position);

}  // namespace sensory_growth::growth
