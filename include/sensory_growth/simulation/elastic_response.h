#pragma once

#include <vector>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::simulation {

/// How an organ gives way elastically while its rest state grows, as the last part of a step showed: what to expect of
/// the next one.
class ElasticResponse {
 public:
  /// Of an organ that has not grown.
  ElasticResponse() = default;

  /// What was learned before. Throws std::invalid_argument if it cannot have been.
  ElasticResponse(std::vector<rod::Vector3> trend, double amplification);

  /// Takes two equilibria of an organ, dt [s] of growth apart and with the same elements.
  void learn(const rod::Rod& before, const rod::Rod& after, double dt);

  /// After a division or a jump to another equilibrium the past says nothing about how bends give way.
  void forgetTrend() { trend_.clear(); }

  /// Whether there is a trend for every bend of the rod.
  bool knowsTrend(const rod::Rod& rod) const { return trend_.size() == rod.size(); }

  /// Rate of the elastic part of each curvature [1/(m s)]; empty if there is no trend.
  const std::vector<rod::Vector3>& trend() const { return trend_; }

  /// Adds to the curvature what the trend makes of it in dt [s]: a rod that was brought along by growth alone is off
  /// its equilibrium by the first order of dt, then by the second.
  void anticipate(rod::Rod& rod, double dt) const;

  /// How many times more the organ turned than its rest state: the nearer it is to falling over, the more
  /// (model.md 11.2). Bounded, so that a jump to another equilibrium shortens one part, not all that follow.
  double amplification() const { return amplification_; }

 private:
  std::vector<rod::Vector3> trend_;
  double amplification_ = 1.0;
};

}  // namespace sensory_growth::simulation
