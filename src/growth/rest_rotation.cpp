#include "sensory_growth/growth/rest_rotation.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

namespace sensory_growth::growth {

namespace {

/// Part of a time in which a number is positive that goes straight from one value to another.
double positiveShare(double from, double to) {
  if (from > 0.0 && to > 0.0) return 1.0;
  if (from > 0.0) return from / (from - to);
  return to > 0.0 ? to / (to - from) : 0.0;
}

}  // namespace

void turn(rod::Rod& rod, const RestRotation& rotation, const std::vector<double>& rates,
          const std::vector<double>& end_rates, double dt, std::vector<rod::Vector3>& drive) {
  const auto gate = [&](const std::vector<double>& r) { return rotation.gate * *std::max_element(r.begin(), r.end()); };
  const auto rateAt = [&](const std::vector<double>& r, std::size_t j) {
    return rod::voronoiMean(rod, j, [&](std::size_t e) { return r[e]; });
  };
  const double start_gate = gate(rates);
  const double end_gate = gate(end_rates);
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const double share = positiveShare(rateAt(rates, j) - start_gate, rateAt(end_rates, j) - end_gate);
    if (share == 0.0) continue;
    const Eigen::Rotation2Dd turned(rotation.angularVelocity() * share * dt);
    rod::Bend& bend = rod.bends[j];
    const Eigen::Vector2d rest = bend.rest_curvature.head<2>();
    const Eigen::Vector2d increment = turned * rest - rest;
    bend.rest_curvature.head<2>() += increment;
    bend.curvature.head<2>() += increment;  // the elastic strain stays
    drive[j].head<2>() = (turned * drive[j].head<2>()).eval();
  }
}

}  // namespace sensory_growth::growth
