#include "sensory_growth/simulation/elastic_response.h"

#include <algorithm>
#include <cstddef>

namespace sensory_growth::simulation {

void ElasticResponse::learn(const rod::Rod& before, const rod::Rod& after, double dt) {
  constexpr double kMostAmplification = 20.0;
  trend_.assign(after.size(), rod::Vector3::Zero());
  double turning = 0.0;
  double rest_turning = 0.0;
  for (std::size_t j = after.firstBend(); j < after.size(); ++j) {
    const rod::Vector3 change = after.bends[j].curvature - before.bends[j].curvature;
    const rod::Vector3 rest_change = after.bends[j].rest_curvature - before.bends[j].rest_curvature;
    trend_[j] = (change - rest_change) / dt;
    const double length = after.voronoiLength(j);
    turning += length * change.head<2>().norm();
    rest_turning += length * rest_change.head<2>().norm();
  }
  amplification_ = rest_turning > 0.0 ? std::clamp(turning / rest_turning, 1.0, kMostAmplification) : 1.0;
}

void ElasticResponse::anticipate(rod::Rod& rod, double dt) const {
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) rod.bends[j].curvature += dt * trend_[j];
}

}  // namespace sensory_growth::simulation
