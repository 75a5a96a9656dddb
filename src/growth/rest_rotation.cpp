#include "sensory_growth/growth/rest_rotation.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Geometry>

namespace sensory_growth::growth {

void turn(rod::Rod& rod, const RestRotation& rotation, const std::vector<double>& rates, double dt,
          std::vector<rod::Vector3>& drive) {
  const Eigen::Rotation2Dd turned(rotation.angularVelocity() * dt);
  const double slowest = rotation.gate * *std::max_element(rates.begin(), rates.end());
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    if (!(rod::voronoiMean(rod, j, [&](std::size_t e) { return rates[e]; }) > slowest)) continue;
    rod::Bend& bend = rod.bends[j];
    const Eigen::Vector2d rest = bend.rest_curvature.head<2>();
    const Eigen::Vector2d increment = turned * rest - rest;
    bend.rest_curvature.head<2>() += increment;
    bend.curvature.head<2>() += increment;  // the elastic strain stays
    drive[j].head<2>() = (turned * drive[j].head<2>()).eval();
  }
}

}  // namespace sensory_growth::growth
