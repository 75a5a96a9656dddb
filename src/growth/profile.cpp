#include "sensory_growth/growth/profile.h"

#include <algorithm>
#include <cmath>

namespace sensory_growth::growth {
namespace {

/// log(1 + exp(u)) without overflow.
double softplus(double u) { return std::max(u, 0.0) + std::log1p(std::exp(-std::abs(u))); }

double zoneStart(double zone_length, double L) { return std::max(L - zone_length, 0.0); }

struct Rate {
  double s, L;

  double operator()(const LogisticProfile& p) const {
    const double u = p.steepness * (s - (L - p.zone_length)) / p.zone_length;
    return p.rate / (1.0 + std::exp(-u));
  }
  double operator()(const UniformProfile& p) const { return p.rate; }
  double operator()(const ApicalFlatProfile& p) const { return s >= zoneStart(p.zone_length, L) ? p.rate : 0.0; }
};

/// Velocity as a function of s alone: what the points of an organ have in common is worked out once.
struct VelocityAlong {
  double L;

  auto operator()(const LogisticProfile& p) const {
    const double per_length = p.steepness / p.zone_length;
    const double u0 = -per_length * (L - p.zone_length);
    const double scale = p.rate / per_length;
    return [=, at_base = softplus(u0)](double s) { return scale * (softplus(u0 + per_length * s) - at_base); };
  }
  auto operator()(const UniformProfile& p) const {
    return [rate = p.rate](double s) { return rate * s; };
  }
  auto operator()(const ApicalFlatProfile& p) const {
    return [rate = p.rate, start = zoneStart(p.zone_length, L)](double s) { return rate * std::max(0.0, s - start); };
  }
};

}  // namespace

double rate(const Profile& profile, double s, double L) { return std::visit(Rate{s, L}, profile); }

double velocity(const Profile& profile, double s, double L) {
  return std::visit([=](const auto& p) { return VelocityAlong{L}(p)(s); }, profile);
}

void velocities(const Profile& profile, double L, std::vector<double>& s) {
  std::visit([&](const auto& p) { std::transform(s.begin(), s.end(), s.begin(), VelocityAlong{L}(p)); }, profile);
}

}  // namespace sensory_growth::growth
