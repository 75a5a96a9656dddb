#pragma once

/// Growth-rate profiles along an organ (model.md 2): how fast tissue elongates at a given distance from the apex.

#include <cstddef>
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

/// Fastest at the apex and fading like a bell: rate exp(-pi/4 (distance / zone_length)^2). A long organ elongates as
/// fast as with a flat zone of the same length; the standard deviation is sqrt(2 / pi) zone_length.
struct ApicalGaussianProfile {
  double rate = 0.0;         ///< of the apex [1/s]
  double zone_length = 0.0;  ///< [m]
};

/// Rates as they were measured at some distances from the apex, linear in between. Beyond the last sample its rate
/// holds.
class SampledProfile {
 public:
  /// As many rates [1/s], none negative, as distances [m], which begin with 0 and increase. Throws
  /// std::invalid_argument naming the sample at fault.
  SampledProfile(std::vector<double> distances, std::vector<double> rates);

  double rateAt(double distance) const;        ///< [1/s]
  double velocityOver(double distance) const;  ///< how fast that much of the tip elongates, exactly [m/s]
  double largestRate() const;                  ///< [1/s]

 private:
  std::size_t sampleBelow(double distance) const;

  std::vector<double> distances_, rates_;
  std::vector<double> velocities_;  ///< over each distance
};

using Profile = std::variant<LogisticProfile, UniformProfile, ApicalFlatProfile, ApicalGaussianProfile, SampledProfile>;

/// The rate that no part of an organ of any length exceeds [1/s].
double largestRate(const Profile& profile);

/// Relative elongation rate [1/s] at rest arc length s [m] from the base of an organ of rest length L [m].
double rate(const Profile& profile, double s, double L);

/// Velocity [m/s] of the material point at s relative to the base: the integral of rate over [0, s]. Exact and free of
/// overflow for any s in [0, L], organs shorter than their zone included.
double velocity(const Profile& profile, double s, double L);

/// The same for many points of one organ: replaces each s by its velocity.
void velocities(const Profile& profile, double L, std::vector<double>& s);

}  // namespace sensory_growth::growth
