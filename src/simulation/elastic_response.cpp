#include "sensory_growth/simulation/elastic_response.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace sensory_growth::simulation {
namespace {

constexpr double kMostAmplification = 20.0;
constexpr double kFastest = 1e30;  // [1/(m s)]; beyond it, curvatures are no longer finite

}  // namespace

ElasticResponse::ElasticResponse(std::vector<rod::Vector3> trend, double amplification)
    : trend_(std::move(trend)), amplification_(amplification) {
  const auto is_rate = [](const rod::Vector3& rate) { return (rate.array().abs() <= kFastest).all(); };
  if (!std::all_of(trend_.begin(), trend_.end(), is_rate) ||
      !(amplification_ >= 1.0 && amplification_ <= kMostAmplification)) {
    throw std::invalid_argument("the elastic response is none that an organ can have");
  }
}

void ElasticResponse::learn(const rod::Rod& before, const rod::Rod& after, double dt) {
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
