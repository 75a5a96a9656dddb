#pragma once

/// Growth-rate profiles along an organ (model.md 2): how fast tissue elongates at a given distance from the apex.

#include <variant>
#include <vector>

namespace sensory_growth::growth {

/// Smooth apical zone: rate / (1 + exp(-u)), u = steepness (s - (L - zone_length)) / zone_length.
struct LogisticProfile {
  double rate = 0.0;         ///< relative elongation rate of the apex [1/s]
  double zone_length = 0.0;  ///< [m]
  double steepness = 15.0;   ///< m [-]
};

/// The whole organ elongates at one rate; its length grows exponentially.
struct UniformProfile {
  double rate = 0.0;  ///< [1/s]
};

/// One rate within zone_length of the apex, none below.
struct ApicalFlatProfile {
  double rate = 0.0;         ///< [1/s]
  double zone_length = 0.0;  ///< [m]
};

using Profile = std::variant<LogisticProfile, UniformProfile, ApicalFlatProfile>;

/// Relative elongation rate [1/s] at rest arc length s [m] from the base of an organ of rest length L [m].
double rate(const Profile& profile, double s, double L);

/// Velocity [m/s] of the material point at s relative to the base: the integral of rate over [0, s]. Exact and free of
/// overflow for any s in [0, L], organs shorter than their zone included.
double velocity(const Profile& profile, double s, double L);

/// The same for many points of one organ: replaces each s by its velocity.
void velocities(const Profile& profile, double L, std::vector<double>& s);

}  // namespace sensory_growth::growth
