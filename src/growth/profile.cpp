#include "sensory_growth/growth/profile.h"

#include <algorithm>
#include <cmath>

#include "kernels/profile_kernels.h"

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
  template <typename Plain>
  void operator()(const Plain& p) const {
    for (double& v : s) v = Velocity{v, L}(p);
  }
};

}  // namespace

double rate(const Profile& profile, double s, double L) { return std::visit(Rate{s, L}, profile); }

double velocity(const Profile& profile, double s, double L) { return std::visit(Velocity{s, L}, profile); }

void velocities(const Profile& profile, double L, std::vector<double>& s) { std::visit(Velocities{L, s}, profile); }

}  // namespace sensory_growth::growth
