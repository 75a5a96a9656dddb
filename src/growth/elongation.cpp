#include "sensory_growth/growth/elongation.h"

#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

/// Rates of elements of the given lengths: the difference of the velocities of their ends over their length.
void cellRates(const Profile& profile, const std::vector<double>& lengths, std::vector<double>& rates) {
  double L = 0.0;
  for (const double length : lengths) L += length;
  rates.resize(lengths.size());
  double s = 0.0;
  double below = 0.0;
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    s += lengths[e];
    const double above = velocity(profile, s, L);
    rates[e] = (above - below) / lengths[e];
    below = above;
  }
}

void restLengths(const rod::Rod& rod, std::vector<double>& lengths) {
  lengths.resize(rod.size());
  for (std::size_t e = 0; e < rod.size(); ++e) lengths[e] = rod.elements[e].rest_length;
}

}  // namespace

void elementRates(const Profile& profile, const rod::Rod& rod, std::vector<double>& rates) {
  std::vector<double> lengths;
  restLengths(rod, lengths);
  cellRates(profile, lengths, rates);
}

const GrowthStrain& Elongation::strain(const Profile& profile, const rod::Rod& rod, double dt) {
  const std::size_t n = rod.size();
  restLengths(rod, initial_);

  // Classical RK4 for y = log(length), y' = rate(lengths).
  constexpr double kNode[] = {0.0, 0.5, 0.5, 1.0};
  constexpr double kWeight[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  sum_.assign(n, 0.0);
  stage_ = initial_;
  for (int stage = 0; stage < 4; ++stage) {
    if (stage > 0) {
      for (std::size_t e = 0; e < n; ++e) stage_[e] = initial_[e] * std::exp(kNode[stage] * dt * slope_[e]);
    }
    cellRates(profile, stage_, slope_);
    for (std::size_t e = 0; e < n; ++e) sum_[e] += kWeight[stage] * slope_[e];
  }

  strain_.elements.resize(n);
  strain_.bends.resize(n);
  for (std::size_t e = 0; e < n; ++e) {
    strain_.elements[e] = dt * sum_[e];
    const double below = e > 0 ? initial_[e - 1] : 0.0;
    const double gain =
        (e > 0 ? below * std::expm1(strain_.elements[e - 1]) : 0.0) + initial_[e] * std::expm1(strain_.elements[e]);
    strain_.bends[e] = std::log1p(gain / (below + initial_[e]));
  }
  return strain_;
}

const GrowthStrain& Elongation::strainAtFixedLength(const Profile& profile, const rod::Rod& rod, double dt) {
  restLengths(rod, initial_);
  cellRates(profile, initial_, slope_);
  strain_.elements.resize(rod.size());
  strain_.bends.resize(rod.size());
  for (std::size_t e = 0; e < rod.size(); ++e) {
    strain_.elements[e] = dt * slope_[e];
    strain_.bends[e] = rod::voronoiMean(rod, e, [&](std::size_t k) { return dt * slope_[k]; });
  }
  return strain_;
}

void elongate(rod::Rod& rod, const GrowthStrain& strain) {
  double old_below = 0.0;
  double new_below = 0.0;
  for (std::size_t e = 0; e < rod.size(); ++e) {
    double& length = rod.elements[e].rest_length;
    const double old_length = length;
    length *= std::exp(strain.elements[e]);
    rod::Bend& bend = rod.bends[e];
    const double diluted = bend.rest_curvature.z() * ((old_below + old_length) / (new_below + length));
    bend.curvature.z() += diluted - bend.rest_curvature.z();
    bend.rest_curvature.z() = diluted;
    old_below = old_length;
    new_below = length;
  }
}

}  // namespace sensory_growth::growth
