#include "chain_cholesky.h"

#include <algorithm>
#include <cmath>

namespace sensory_growth::mechanics {

using rod::Matrix3;
using rod::Vector3;

double ChainHessian::largestDiagonal() const {
  double largest = 0.0;
  for (const ChainLink& link : links) largest = std::max(largest, link.rotation.diagonal().cwiseAbs().maxCoeff());
  return largest;
}

bool ChainHessian::isFinite() const {
  return std::all_of(links.begin(), links.end(), [](const ChainLink& link) {
    return link.rotation.allFinite() && link.lever.allFinite() && link.stiffness.allFinite();
  });
}

bool ChainCholesky::factor(const ChainHessian& hessian, double shift) {
  const std::size_t n = hessian.links.size();
  stages_.resize(n);
  Matrix3 stiffness = Matrix3::Zero(), mixed = Matrix3::Zero(), rotation = Matrix3::Zero();
  for (std::size_t e = n; e-- > 0;) {
    const ChainLink& link = hessian.links[e];
    Stage& stage = stages_[e];
    stage.stiffness = stiffness + link.stiffness;
    stage.mixed = mixed;

    // The strain of the element yields to the force.
    const Matrix3& root = link.flexibility;
    const Eigen::LLT<Matrix3> yield(Matrix3::Identity() + root.transpose() * stage.stiffness * root);
    if (yield.info() != Eigen::Success) return false;
    stage.yielding = root * yield.solve(root.transpose());
    const Matrix3 share = stage.stiffness * stage.yielding;
    stage.near_stiffness = stage.stiffness - share * stage.stiffness;
    stage.near_mixed = stage.mixed - share * stage.mixed;
    rotation -= stage.mixed.transpose() * stage.yielding * stage.mixed;

    // The rotation of the element moves the vertex.
    const Matrix3 lever_mixed = link.lever.transpose() * stage.near_mixed;
    stage.base_mixed = stage.near_mixed + stage.near_stiffness * link.lever;
    rotation += link.rotation + lever_mixed + lever_mixed.transpose() +
                link.lever.transpose() * stage.near_stiffness * link.lever;
    rotation.diagonal().array() += shift;
    if (e == 0 && hessian.first_fixed) break;
    stage.pivot.compute(rotation);
    if (stage.pivot.info() != Eigen::Success) return false;

    if (e == 0) break;
    const Matrix3 turned = stage.pivot.solve(stage.base_mixed.transpose());
    const Matrix3 coupled = stage.pivot.solve(link.coupling.transpose());
    stiffness = stage.near_stiffness - stage.base_mixed * turned;
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    mixed = -stage.base_mixed * coupled;
    rotation = -link.coupling * coupled;
  }
  return true;
}

void ChainCholesky::solve(const ChainHessian& hessian, const Field& couples, const Field& gaps,
                          ChainResponse& response) const {
  const auto n = static_cast<Eigen::Index>(stages_.size());
  Field& rotations = response.rotations;
  Field& forces = response.forces;
  rotations.resize(3, n);
  forces.resize(3, n);

  // Towards the base: the linear terms of what lies beyond. They are kept where the response will be.
  Vector3 force = Vector3::Zero(), couple = Vector3::Zero();
  for (Eigen::Index e = n - 1; e >= 0; --e) {
    const ChainLink& link = hessian.links[static_cast<std::size_t>(e)];
    const Stage& stage = stages_[static_cast<std::size_t>(e)];
    forces.col(e) = force;
    const Vector3 yielded = stage.yielding * force;
    force -= stage.stiffness * yielded + stage.near_stiffness * gaps.col(e);
    couple += link.lever.transpose() * force - stage.mixed.transpose() * yielded -
              stage.near_mixed.transpose() * gaps.col(e) - couples.col(e);
    rotations.col(e) = couple;
    if (e == 0) break;
    const Vector3 turn = stage.pivot.solve(couple);
    force -= stage.base_mixed * turn;
    couple = -link.coupling * turn;
  }

  Vector3 displacement = Vector3::Zero();
  for (Eigen::Index e = 0; e < n; ++e) {
    const ChainLink& link = hessian.links[static_cast<std::size_t>(e)];
    const Stage& stage = stages_[static_cast<std::size_t>(e)];
    if (e == 0 && hessian.first_fixed) {
      rotations.col(e).setZero();
    } else {
      Vector3 remaining = rotations.col(e) + stage.base_mixed.transpose() * displacement;
      if (e > 0) remaining += link.coupling.transpose() * rotations.col(e - 1);
      rotations.col(e) = -stage.pivot.solve(remaining);
    }
    const Vector3 rigid = displacement + link.lever * rotations.col(e) - gaps.col(e);
    const Vector3 pull = stage.stiffness * rigid + stage.mixed * rotations.col(e) + forces.col(e);
    const Vector3 yielded = stage.yielding * pull;
    displacement = rigid - yielded;
    forces.col(e) = stage.stiffness * yielded - pull;
  }
}

ChainEigenpair lowestEigenpair(const ChainHessian& hessian, const Field& start, double tolerance) {
  constexpr int kMaxIterations = 200;
  constexpr int kIterationsPerShift = 8;

  ChainCholesky factor;
  const double scale = hessian.largestDiagonal();
  double shift = 0.0;
  while (!factor.factor(hessian, shift)) shift = shift > 0.0 ? 4.0 * shift : 1e-12 * scale;

  ChainEigenpair pair;
  const Field no_gaps = Field::Zero(3, start.cols());
  Field vector = start.normalized();
  for (int i = 1; i <= kMaxIterations; ++i) {
    factor.solve(hessian, vector, no_gaps, pair.response);
    Field& rotations = pair.response.rotations;
    const double norm = rotations.norm();
    if (norm == 0.0) break;  // nothing may turn
    // (H + shift) rotations = vector, so this is the Rayleigh quotient of the rotations.
    const double value = vector.cwiseProduct(rotations).sum() / (norm * norm) - shift;
    const double change = std::abs(value - pair.value);
    pair.value = value;
    rotations /= norm;
    pair.response.forces /= norm;
    vector = rotations;
    if (i > 1 && change <= tolerance * std::abs(value) + 1e-15 * scale) break;
    if (i % kIterationsPerShift == 0) {
      // The Rayleigh quotient is an upper bound: a shift slightly beyond it sharpens the ratio to the next eigenvalue.
      const double closer = -value + 0.3 * std::abs(value) + change;
      if (closer < shift || shift == 0.0) {
        if (factor.factor(hessian, closer)) {
          shift = closer;
        } else {
          factor.factor(hessian, shift);
        }
      }
    }
  }
  return pair;
}

}  // namespace sensory_growth::mechanics
