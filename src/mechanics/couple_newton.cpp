#include "couple_newton.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sensory_growth::mechanics {
namespace {

using rod::Matrix3;
using rod::Vector3;

/// The Newton step at the current frames. The couple, constant in the body, adds half its cross product to the Hessian
/// of the last element: the matrix has no Cholesky factor, but an LU one.
class CoupledStep {
 public:
  TurnField find(const ReducedEnergy& energy) {
    energy.blocks(right_, diagonal_, upper_);
    const std::size_t n = energy.size();
    diagonal_[n - 1] += 0.5 * rod::hat(energy.tipCouple());
    for (Vector3& w : right_) w = -w;
    pivots_.resize(n);
    const std::size_t first = energy.firstFree();
    for (std::size_t e = n; e-- > first;) {
      pivots_[e].compute(diagonal_[e]);
      if (e == 0) break;
      const Matrix3 lower = upper_[e].transpose();
      diagonal_[e - 1] -= upper_[e] * pivots_[e].solve(lower);
      right_[e - 1] -= upper_[e] * pivots_[e].solve(right_[e]);
    }
    TurnField step(n, Vector3::Zero());
    for (std::size_t e = first; e < n; ++e) {
      if (e > 0) right_[e] -= upper_[e].transpose() * step[e - 1];
      step[e] = pivots_[e].solve(right_[e]);
    }
    return step;
  }

 private:
  TurnField right_;
  std::vector<Matrix3> diagonal_, upper_;
  std::vector<Eigen::PartialPivLU<Matrix3>> pivots_;
};

}  // namespace

bool balanceCouple(ReducedEnergy& energy, double tolerance, double max_rotation, int& iterations) {
  constexpr int kMostIterations = 60;
  constexpr double kSmallestScale = 1e-4;
  CoupledStep coupled;
  double residual = energy.evaluate().largest_gradient;
  for (int i = 0; i < kMostIterations && residual >= tolerance; ++i, ++iterations) {
    energy.setStep(coupled.find(energy));
    if (!std::isfinite(energy.largestTurn())) return false;
    double scale = std::min(1.0, max_rotation / energy.largestTurn());
    double there = energy.tryStep(scale).largest_gradient;
    while (!(there < (1.0 - 1e-4 * scale) * residual)) {
      scale *= 0.5;
      if (scale < kSmallestScale) return false;
      there = energy.tryStep(scale).largest_gradient;
    }
    energy.accept();
    residual = there;
  }
  return residual < tolerance;
}

}  // namespace sensory_growth::mechanics
