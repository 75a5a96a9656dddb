#include "sensory_growth/growth/elongation.h"

#include <cstddef>

#include "kernels/profile_kernels.h"

namespace sensory_growth::growth {
namespace {

/// Rates of n elements of given lengths: the difference of the velocities of their ends over their length.
template <typename Length>
void cellRates(const Profile& profile, std::size_t n, const Length& length, std::vector<double>& rates) {
  rates.resize(n);
  double s = 0.0;
  for (std::size_t e = 0; e < n; ++e) rates[e] = s += length(e);
  velocities(profile, s, rates);
  double below = 0.0;
  for (std::size_t e = 0; e < n; ++e) {
    const double above = rates[e];
    rates[e] = (above - below) / length(e);
    below = above;
  }
}

void restLengths(const rod::Rod& rod, std::vector<double>& lengths) {
  lengths.resize(rod.size());
  for (std::size_t e = 0; e < rod.size(); ++e) lengths[e] = rod.elements[e].rest_length;
}

}  // namespace

void elementRates(const Profile& profile, const rod::Rod& rod, std::vector<double>& rates) {
  const auto length = [&](std::size_t e) { return rod.elements[e].rest_length; };
  cellRates(profile, rod.size(), length, rates);
}

const GrowthStrain& Elongation::strain(const Profile& profile, const rod::Rod& rod, const std::vector<double>& rates,
                                       double dt) {
  const std::size_t n = rod.size();
  restLengths(rod, initial_);
  stage_.resize(n);
  strain_.elements.resize(n);
  strain_.bends.resize(n);
  strain_.lengths.resize(n);

  const kernels::ProfileKernels& loops = kernels::profileKernels();
  // Classical RK4 for y = log(length), y' = rate(lengths).
  for (std::size_t e = 0; e < n; ++e) strain_.elements[e] = dt / 6.0 * rates[e];
  const auto addStage = [&](const std::vector<double>& slope, double node, double weight) {
    loops.grow(initial_.data(), slope.data(), node * dt, stage_.data(), n);
    cellRates(
        profile, n, [&](std::size_t e) { return stage_[e]; }, slope_);
    for (std::size_t e = 0; e < n; ++e) strain_.elements[e] += weight * dt * slope_[e];
  };
  addStage(rates, 0.5, 1.0 / 3.0);
  addStage(slope_, 0.5, 1.0 / 3.0);
  addStage(slope_, 1.0, 1.0 / 6.0);

  loops.grow(initial_.data(), strain_.elements.data(), 1.0, strain_.lengths.data(), n);
  strain_.bends[0] = strain_.lengths[0] / initial_[0];
  for (std::size_t e = 1; e < n; ++e) {
    strain_.bends[e] = (strain_.lengths[e - 1] + strain_.lengths[e]) / (initial_[e - 1] + initial_[e]);
  }
  loops.logarithm(strain_.bends.data(), n);
  return strain_;
}

const GrowthStrain& Elongation::strainAtFixedLength(const rod::Rod& rod, const std::vector<double>& rates, double dt) {
  restLengths(rod, strain_.lengths);
  strain_.elements.resize(rod.size());
  strain_.bends.resize(rod.size());
  for (std::size_t e = 0; e < rod.size(); ++e) {
    strain_.elements[e] = dt * rates[e];
    strain_.bends[e] = rod::voronoiMean(rod, e, [&](std::size_t k) { return dt * rates[k]; });
  }
  return strain_;
}

void elongate(rod::Rod& rod, const GrowthStrain& strain, TwistTransport twist, std::vector<rod::Vector3>& drive) {
  double old_below = 0.0;
  double new_below = 0.0;
  for (std::size_t e = 0; e < rod.size(); ++e) {
    double& length = rod.elements[e].rest_length;
    const double old_length = length;
    length = strain.lengths[e];
    rod::Bend& bend = rod.bends[e];
    if (e < rod.firstBend()) {
      bend.curvature *= old_length / length;  // where a hinge stands does not change
    } else if (twist == TwistTransport::angle) {
      const double dilution = (old_below + old_length) / (new_below + length);
      const double diluted = bend.rest_curvature.z() * dilution;
      bend.curvature.z() += diluted - bend.rest_curvature.z();
      bend.rest_curvature.z() = diluted;
      drive[e].z() *= dilution;
    }
    old_below = old_length;
    new_below = length;
  }
}

}  // namespace sensory_growth::growth
