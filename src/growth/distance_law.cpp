#include "sensory_growth/growth/distance_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <sstream>

namespace sensory_growth::growth {
namespace {

/// Sources may be strong, but a pull stronger than this is surely an error of unit.
constexpr double kLargestFactor = 1e6;

double at(const ConstantPull&, double) { return 1.0; }

double at(const InversePowerPull& pull, double distance) { return std::pow(pull.length / distance, pull.exponent); }

double at(const ExponentialPull& pull, double distance) { return std::exp(-distance / pull.length); }

double at(const GaussianPull& pull, double distance) {
  const double u = distance / pull.length;
  return std::exp(-0.5 * u * u);
}

double at(const SampledPull& pull, double distance) {
  const std::vector<double>& d = pull.distances;
  const std::size_t above = std::upper_bound(d.begin(), d.end(), distance) - d.begin();
  if (above == 0) return pull.factors.front();
  if (above == d.size()) return pull.factors.back();
  const double part = (distance - d[above - 1]) / (d[above] - d[above - 1]);
  return pull.factors[above - 1] + part * (pull.factors[above] - pull.factors[above - 1]);
}

bool isLength(double value) { return value > 0.0 && std::isfinite(value); }

std::optional<std::string> faultOf(const ConstantPull&, double) { return std::nullopt; }

std::optional<std::string> faultOf(const InversePowerPull& pull, double smallest_distance) {
  if (!isLength(pull.length)) return "length of the distance law must be > 0 m";
  if (!(pull.exponent >= 0.0) || !std::isfinite(pull.exponent)) return "exponent of the distance law must be >= 0";
  const double largest = smallest_distance > 0.0 ? at(pull, smallest_distance) : HUGE_VAL;
  if (largest <= kLargestFactor) return std::nullopt;
  std::ostringstream out;
  out << "the pull grows " << largest << " times towards the source, more than " << kLargestFactor
      << "; give a longer softening_length";
  return out.str();
}

template <typename Pull>
std::optional<std::string> faultOf(const Pull& pull, double) {
  if (isLength(pull.length)) return std::nullopt;
  return "length of the distance law must be > 0 m";
}

std::optional<std::string> faultOf(const SampledPull& pull, double) {
  const std::vector<double>& d = pull.distances;
  if (d.empty() || d.size() != pull.factors.size()) {
    return "the distance law has " + std::to_string(d.size()) + " distances and " +
           std::to_string(pull.factors.size()) + " factors; give as many, at least one";
  }
  if (std::adjacent_find(d.begin(), d.end(), std::greater_equal<>()) != d.end()) {
    return "distances of the distance law must increase";
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(d.begin(), d.end(), is_finite) ||
      !std::all_of(pull.factors.begin(), pull.factors.end(), is_finite)) {
    return "distances and factors of the distance law must be finite";
  }
  return std::nullopt;
}

}  // namespace

double factor(const DistanceLaw& law, double distance) {
  return std::visit([distance](const auto& pull) { return at(pull, distance); }, law);
}

std::optional<std::string> findFault(const DistanceLaw& law, double smallest_distance) {
  return std::visit([=](const auto& pull) { return faultOf(pull, smallest_distance); }, law);
}

}  // namespace sensory_growth::growth
