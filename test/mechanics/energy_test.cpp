// Gradient and Hessian of the reduced energy against differences of the full energy on random states (model.md 17).

#include "sensory_growth/mechanics/energy.h"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/reduced_energy.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

class RandomRod : public testing::TestWithParam<unsigned> {
 protected:
  void SetUp() override {
    std::mt19937 generator(GetParam());
    rod_ = support::randomRod(generator, 6);
    loads_.gravity = support::randomVector(generator, 2.0);
    loads_.tip_force = support::randomVector(generator, 1.0);
    direction_.resize(rod_.size());
    for (Vector3& w : direction_) w = support::randomVector(generator, 1.0);
    energy_.assign(rod_, loads_);
  }

  ReducedEnergy::Frames moved(double h) const {
    ReducedEnergy::Frames frames;
    for (std::size_t e = 0; e < rod_.size(); ++e) {
      frames.push_back((rod_.elements[e].frame * rod::exp(h * direction_[e])).normalized());
    }
    return frames;
  }

  /// The rod at the given frames with the optimal strains.
  rod::Rod at(const ReducedEnergy::Frames& frames) {
    energy_.evaluate(frames);
    rod::Rod rod = rod_;
    for (std::size_t e = 0; e < rod.size(); ++e) {
      rod.elements[e].frame = frames[e];
      rod.elements[e].strain = energy_.strain(e);
      rod.bends[e].curvature = energy_.curvature(e);
    }
    rod.rebuildPositions();
    return rod;
  }

  RotationField gradient(const ReducedEnergy::Frames& frames) {
    RotationField g;
    energy_.evaluate(frames);
    energy_.differentiate(g, hessian_);
    return g;
  }

  rod::Rod rod_;
  Loads loads_;
  RotationField direction_;
  ReducedEnergy energy_;
  BlockTridiagonal hessian_;
};

TEST_P(RandomRod, ReducedEnergyDiffersFromTheFullOneByAConstant) {
  const double here = energy(at(moved(0.0)), loads_).total() - energy_.evaluate(moved(0.0));
  const double there = energy(at(moved(0.2)), loads_).total() - energy_.evaluate(moved(0.2));
  EXPECT_NEAR(here, there, 1e-12);
}

TEST_P(RandomRod, OptimalStrainsMinimiseTheFullEnergy) {
  rod::Rod rod = at(moved(0.0));
  const double least = energy(rod, loads_).total();
  std::mt19937 generator(GetParam() + 100);
  for (int i = 0; i < 20; ++i) {
    rod::Rod other = rod;
    for (rod::Element& e : other.elements) e.strain += support::randomVector(generator, 1e-3);
    other.rebuildPositions();
    EXPECT_GT(energy(other, loads_).total(), least);
  }
}

TEST_P(RandomRod, GradientAgreesWithDifferences) {
  const double h = 1e-6;
  const double forward = energy(at(moved(h)), loads_).total();
  const double backward = energy(at(moved(-h)), loads_).total();
  EXPECT_NEAR(dot(gradient(moved(0.0)), direction_), (forward - backward) / (2.0 * h), 1e-7);
}

TEST_P(RandomRod, HessianAgreesWithSecondDifferences) {
  // Along a geodesic the second derivative of the energy is w^T H w: the connection terms are antisymmetric.
  const double h = 1e-4;
  const double middle = energy_.evaluate(moved(0.0));
  const double second = (energy_.evaluate(moved(h)) - 2.0 * middle + energy_.evaluate(moved(-h))) / (h * h);
  gradient(moved(0.0));
  RotationField product;
  hessian_.multiply(direction_, product);
  EXPECT_NEAR(dot(direction_, product), second, 1e-5 * std::abs(second));
}

TEST_P(RandomRod, SolveInvertsMultiply) {
  gradient(moved(0.0));
  const double shift = hessian_.largestDiagonal();
  BlockCholesky factor;
  ASSERT_TRUE(factor.factor(hessian_, shift));
  RotationField x;
  hessian_.multiply(direction_, x);
  for (std::size_t e = 0; e < x.size(); ++e) x[e] += shift * direction_[e];
  factor.solve(x);
  for (std::size_t e = 0; e < x.size(); ++e) EXPECT_LT((x[e] - direction_[e]).norm(), 1e-12);
}

TEST_P(RandomRod, LowestEigenpairIsOne) {
  gradient(moved(0.0));
  const auto n = static_cast<Eigen::Index>(3 * rod_.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index e = 0; e < n / 3; ++e) {
    dense.block<3, 3>(3 * e, 3 * e) = hessian_.diagonal[e];
    if (3 * e + 3 == n) break;
    dense.block<3, 3>(3 * e, 3 * e + 3) = hessian_.upper[e];
    dense.block<3, 3>(3 * e + 3, 3 * e) = hessian_.upper[e].transpose();
  }
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues()[0];
  const Eigenpair pair = lowestEigenpair(hessian_, direction_, 1e-12);
  EXPECT_NEAR(pair.value, lowest, 1e-6 * std::abs(lowest));
  RotationField product;
  hessian_.multiply(pair.vector, product);
  for (std::size_t e = 0; e < product.size(); ++e) {
    EXPECT_LT((product[e] - pair.value * pair.vector[e]).norm(), 1e-4 * hessian_.largestDiagonal());
  }
  const double margin = 1e-3 * std::abs(lowest);
  EXPECT_TRUE(BlockCholesky().factor(hessian_, -lowest + margin));
  EXPECT_FALSE(BlockCholesky().factor(hessian_, -lowest - margin));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRod, testing::Range(1u, 11u));

}  // namespace
}  // namespace sensory_growth::mechanics
