#include "sensory_growth/growth/profile.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernels/profile_kernels.h"

namespace sensory_growth::growth {
namespace {

/// log(1 + exp(u)) without overflow.
double softplus(double u) { return std::max(u, 0.0) + std::log1p(std::exp(-std::abs(u))); }

double zoneStart(double zone_length, double L) { return std::max(L - zone_length, 0.0); }

/// One over the distance from the apex at which the exponent of a Gaussian zone is one [1/m].
double steepness(const ApicalGaussianProfile& p) { return 0.5 * std::sqrt(M_PI) / p.zone_length; }

struct Rate {
  double s, L;

  double operator()(const LogisticProfile& p) const {
    const double u = p.steepness * (s - (L - p.zone_length)) / p.zone_length;
    return p.rate / (1.0 + std::exp(-u));
  }
  double operator()(const UniformProfile& p) const { return p.rate; }
  double operator()(const ApicalFlatProfile& p) const { return s >= zoneStart(p.zone_length, L) ? p.rate : 0.0; }
  double operator()(const ApicalGaussianProfile& p) const {
    const double u = steepness(p) * (L - s);
    return p.rate * std::exp(-u * u);
  }
  double operator()(const SampledProfile& p) const { return p.rateAt(L - s); }
};

struct Velocity {
  double s, L;

  double operator()(const LogisticProfile& p) const {
    const double per_length = p.steepness / p.zone_length;
    const double u0 = -per_length * (L - p.zone_length);
    return p.rate / per_length * (softplus(u0 + per_length * s) - softplus(u0));
  }
  double operator()(const UniformProfile& p) const { return p.rate * s; }
  double operator()(const ApicalFlatProfile& p) const {
    return p.rate * std::max(0.0, s - zoneStart(p.zone_length, L));
  }
  double operator()(const ApicalGaussianProfile& p) const {
    // The complement keeps its digits far from the apex, where rates are tiny.
    const double a = steepness(p);
    return p.rate * p.zone_length * (std::erfc(a * (L - s)) - std::erfc(a * L));
  }
  double operator()(const SampledProfile& p) const { return p.velocityOver(L) - p.velocityOver(L - s); }
};

/// The same for many points; differs from Velocity by round-off.
struct Velocities {
  double L;
  std::vector<double>& s;

  void operator()(const LogisticProfile& p) const {
    const double per_length = p.steepness / p.zone_length;
    const double u0 = -per_length * (L - p.zone_length);
    const double scale = p.rate / per_length;
    const double at_base = scale * softplus(u0);
    kernels::profileKernels().softplus({u0, per_length, scale}, s.data(), s.size());
    for (double& v : s) v -= at_base;
  }
  void operator()(const ApicalGaussianProfile& p) const {
    const double a = steepness(p);
    const double at_base = std::erfc(a * L);
    for (double& v : s) v = p.rate * p.zone_length * (std::erfc(a * (L - v)) - at_base);
  }
  template <typename Plain>
  void operator()(const Plain& p) const {
    for (double& v : s) v = Velocity{v, L}(p);
  }
};

struct LargestRate {
  double operator()(const SampledProfile& p) const { return p.largestRate(); }
  template <typename Plain>
  double operator()(const Plain& p) const {
    return p.rate;
  }
};

[[noreturn]] void refuse(const char* what, std::size_t sample, double value, const char* why) {
  std::ostringstream message;
  message << what << " " << sample + 1 << " is " << value << " " << why;
  throw std::invalid_argument(message.str());
}

}  // namespace

SampledProfile::SampledProfile(std::vector<double> distances, std::vector<double> rates)
    : distances_(std::move(distances)), rates_(std::move(rates)) {
  if (distances_.empty() || distances_.size() != rates_.size()) {
    throw std::invalid_argument(std::to_string(distances_.size()) + " distances with " + std::to_string(rates_.size()) +
                                " rates; give as many, one at least");
  }
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    const bool is_in_order = i == 0 ? distances_[i] == 0.0 : distances_[i] > distances_[i - 1];
    if (!is_in_order || !std::isfinite(distances_[i])) {
      refuse("distance", i, distances_[i], "m; distances begin with 0 and increase");
    }
    if (!(rates_[i] >= 0.0) || !std::isfinite(rates_[i])) refuse("rate", i, rates_[i], "1/s; it must not be negative");
  }
  velocities_.assign(1, 0.0);
  for (std::size_t i = 1; i < distances_.size(); ++i) {
    velocities_.push_back(velocities_[i - 1] + 0.5 * (rates_[i - 1] + rates_[i]) * (distances_[i] - distances_[i - 1]));
  }
}

/// The last sample that is no farther from the apex.
std::size_t SampledProfile::sampleBelow(double distance) const {
  const auto beyond = std::upper_bound(distances_.begin() + 1, distances_.end(), distance);
  return static_cast<std::size_t>(beyond - distances_.begin()) - 1;
}

double SampledProfile::rateAt(double distance) const {
  const std::size_t i = sampleBelow(distance);
  if (i + 1 == distances_.size()) return rates_[i];
  const double fraction = (distance - distances_[i]) / (distances_[i + 1] - distances_[i]);
  return (1.0 - fraction) * rates_[i] + fraction * rates_[i + 1];
}

double SampledProfile::velocityOver(double distance) const {
  const std::size_t i = sampleBelow(distance);
  return velocities_[i] + 0.5 * (rates_[i] + rateAt(distance)) * (distance - distances_[i]);
}

double SampledProfile::largestRate() const { return *std::max_element(rates_.begin(), rates_.end()); }

double rate(const Profile& profile, double s, double L) { return std::visit(Rate{s, L}, profile); }

double velocity(const Profile& profile, double s, double L) { return std::visit(Velocity{s, L}, profile); }

void velocities(const Profile& profile, double L, std::vector<double>& s) { std::visit(Velocities{L, s}, profile); }

double largestRate(const Profile& profile) { return std::visit(LargestRate{}, profile); }

}  // namespace sensory_growth::growth
