#pragma once

/// How the pull of a point source changes with the distance to it (model.md 4.3): lambda(d) / lambda, a factor on the
/// sensitivity.

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sensory_growth::growth {

/// As strong from everywhere.
struct ConstantPull {};

/// (length / d)^exponent.
struct InversePowerPull {
  double length = 1.0;    ///< distance at which the factor is 1 [m]
  double exponent = 2.0;  ///< [-]
};

/// exp(-d / length).
struct ExponentialPull {
  double length = 1.0;  ///< [m]
};

/// exp(-d^2 / (2 length^2)).
struct GaussianPull {
  double length = 1.0;  ///< [m]
};

/// Linear between samples, constant before the first and beyond the last.
struct SampledPull {
  std::vector<double> distances;  ///< increasing [m]
  std::vector<double> factors;    ///< as many [-]
};

using DistanceLaw = std::variant<ConstantPull, InversePowerPull, ExponentialPull, GaussianPull, SampledPull>;

/// Expects a law without fault and, for InversePowerPull, a distance that is not 0.
double factor(const DistanceLaw& law, double distance);

/// Why the law makes no sense, or nothing. The smallest distance [m] at which it is asked is the softening length.
std::optional<std::string> findFault(const DistanceLaw& law, double smallest_distance);

}  // namespace sensory_growth::growth
