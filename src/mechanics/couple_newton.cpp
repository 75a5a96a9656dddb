#include "couple_newton.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sensory_growth::mechanics {
namespace {

using rod::Matrix3;
using rod::Vector3;

/// The Jacobian at the current frames. The couple, constant in the body, adds half its cross product to the Hessian of
/// the last element: the matrix has no Cholesky factor, but an LU one.
class CoupledJacobian {
 public:
  /// Factors it and eliminates minus the gradient.
  void factor(const ReducedEnergy& energy) {
    energy.blocks(right_, diagonal_, upper_);
    const std::size_t n = energy.size();
    first_ = energy.firstFree();
    diagonal_[n - 1] += 0.5 * rod::hat(energy.tipCouple());
    for (Vector3& w : right_) w = -w;
    pivots_.resize(n);
    for (std::size_t e = n; e-- > first_;) {
      pivots_[e].compute(diagonal_[e]);
      if (e == 0) break;
      const Matrix3 lower = upper_[e].transpose();
      diagonal_[e - 1] -= upper_[e] * pivots_[e].solve(lower);
      right_[e - 1] -= upper_[e] * pivots_[e].solve(right_[e]);
    }
  }

  TurnField step() {
    TurnField step(right_.size(), Vector3::Zero());
    for (std::size_t e = first_; e < step.size(); ++e) {
      if (e > 0) right_[e] -= upper_[e].transpose() * step[e - 1];
      step[e] = pivots_[e].solve(right_[e]);
    }
    return step;
  }

 private:
  std::size_t first_ = 0;
  TurnField right_;
  std::vector<Matrix3> diagonal_, upper_;
  std::vector<Eigen::PartialPivLU<Matrix3>> pivots_;
};

}  // namespace

bool balanceCouple(ReducedEnergy& energy, double tolerance, double max_rotation, int& iterations) {
  constexpr int kMostIterations = 60;
  constexpr double kSmallestScale = 1e-4;
  CoupledJacobian jacobian;
  double residual = energy.evaluate().largest_gradient;
  for (int i = 0; i < kMostIterations && residual >= tolerance; ++i, ++iterations) {
    jacobian.factor(energy);
    energy.setStep(jacobian.step());
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
