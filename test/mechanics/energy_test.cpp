// Gradient, Hessian and factor of the reduced energy against differences of the full energy and dense algebra, on
// random states and on every instruction set (model.md 17).

#include "sensory_growth/mechanics/energy.h"

#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include "reduced_energy.h"
#include "sensory_growth/rod/instruction_set.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Matrix3;
using rod::Vector3;

using rod::availableInstructionSets;
using rod::InstructionSet;
using rod::useInstructionSet;

using Case = std::tuple<unsigned, InstructionSet>;

class RandomRod : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const auto [seed, set] = GetParam();
    generator_.seed(seed);
    useInstructionSet(set);
    // Lengths on both sides of full packets and tiles.
    const std::size_t sizes[] = {1, 2, 6, 7, 8, 9, 31, 32, 33, 70};
    rod_ = support::randomRod(generator_, sizes[seed % 10]);
    loads_.gravity = support::randomVector(generator_, 2.0);
    loads_.tip_force = support::randomVector(generator_, 1.0);
    loads_.line_force = support::randomVector(generator_, 1.0);
    direction_.resize(rod_.size());
    for (Vector3& w : direction_) w = support::randomVector(generator_, 1.0);
  }
  void TearDown() override { useInstructionSet(availableInstructionSets().back()); }

  /// The rod with its frames turned by h along the random direction and optimal strains.
  rod::Rod at(double h) {
    rod::Rod rod = rod_;
    for (std::size_t e = 0; e < rod.size(); ++e) {
      rod.elements[e].frame = (rod.elements[e].frame * rod::exp(h * direction_[e])).normalized();
      const rod::Quaternion& below = e > 0 ? rod.elements[e - 1].frame : rod.base.frame;
      rod.bends[e].curvature = rod::log(below.conjugate() * rod.elements[e].frame) / rod.voronoiLength(e);
    }
    energy_.assign(rod, loads_);
    energy_.writeTo(rod);
    return rod;
  }

  double reduced(double h) {
    at(h);
    return energy_.evaluate().energy;
  }
  double full(double h) { return energy(at(h), loads_).total(); }

  Eigen::VectorXd flat(const TurnField& field) const {
    Eigen::VectorXd x(3 * static_cast<Eigen::Index>(field.size()));
    for (std::size_t e = 0; e < field.size(); ++e) x.segment<3>(3 * static_cast<Eigen::Index>(e)) = field[e];
    return x;
  }

  /// At h = 0.
  void differentiate(Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    at(0.0);
    TurnField g;
    std::vector<Matrix3> diagonal, upper;
    energy_.blocks(g, diagonal, upper);
    gradient = flat(g);
    hessian.setZero(gradient.size(), gradient.size());
    for (std::size_t e = 0; e < g.size(); ++e) {
      const auto i = 3 * static_cast<Eigen::Index>(e);
      hessian.block<3, 3>(i, i) = diagonal[e];
      if (e == 0) continue;
      hessian.block<3, 3>(i - 3, i) = upper[e];
      hessian.block<3, 3>(i, i - 3) = upper[e].transpose();
    }
  }

  std::mt19937 generator_;
  rod::Rod rod_;
  Loads loads_;
  TurnField direction_;
  ReducedEnergy energy_;
};

TEST_P(RandomRod, ReducedEnergyDiffersFromTheFullOneByAConstant) {
  const double here = full(0.0) - reduced(0.0);
  const double there = full(0.2) - reduced(0.2);
  EXPECT_NEAR(here, there, 1e-13 * energy_.evaluate().magnitude);
}

TEST_P(RandomRod, OptimalStrainsMinimiseTheFullEnergy) {
  const rod::Rod rod = at(0.0);
  const double least = energy(rod, loads_).total();
  for (int i = 0; i < 20; ++i) {
    rod::Rod other = rod;
    for (rod::Element& e : other.elements) e.strain += support::randomVector(generator_, 1e-3);
    other.rebuildPositions();
    EXPECT_GT(energy(other, loads_).total(), least);
  }
}

TEST_P(RandomRod, GradientAgreesWithDifferences) {
  const double h = 1e-6;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  differentiate(gradient, hessian);
  const double reported = energy_.evaluate().largest_gradient;
  const double difference = (full(h) - full(-h)) / (2.0 * h);
  EXPECT_NEAR(gradient.dot(flat(direction_)), difference, 1e-8 * hessian.norm());
  double largest = 0.0;
  for (Eigen::Index i = 0; i < gradient.size(); i += 3) largest = std::max(largest, gradient.segment<3>(i).norm());
  EXPECT_NEAR(reported, largest, 1e-13 * largest);
}

TEST_P(RandomRod, HessianAgreesWithSecondDifferences) {
  // Along a geodesic the second derivative of the energy is w^T H w: the connection terms are antisymmetric.
  const double h = 1e-4;
  const double second = (reduced(h) - 2.0 * reduced(0.0) + reduced(-h)) / (h * h);
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  differentiate(gradient, hessian);
  EXPECT_NEAR(flat(direction_).dot(hessian * flat(direction_)), second, 1e-5 * std::abs(second));
}

TEST_P(RandomRod, NewtonStepSolvesTheDenseSystem) {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  differentiate(gradient, hessian);
  const double shift = 2.0 * energy_.stiffnessScale();
  ASSERT_TRUE(energy_.findStep(shift));
  hessian.diagonal().array() += shift;
  const Eigen::VectorXd step = hessian.ldlt().solve(-gradient);
  EXPECT_NEAR(energy_.decrement(), -gradient.dot(step), 1e-12 * energy_.decrement());
  const rod::Rod before = at(0.0);
  energy_.findStep(shift);
  const ReducedEnergy::Evaluation by_parts = energy_.tryStep(1.0);
  const ReducedEnergy::Evaluation at_once = energy_.tryWholeStep();
  EXPECT_NEAR(at_once.energy, by_parts.energy, 1e-13 * by_parts.magnitude);
  EXPECT_NEAR(at_once.largest_gradient, by_parts.largest_gradient, 1e-12 * energy_.stiffnessScale());
  EXPECT_NEAR(at_once.largest_bend, by_parts.largest_bend, 1e-13);
  energy_.accept();
  const TurnField turns = energy_.turnsFrom(before);
  for (std::size_t e = 0; e < turns.size(); ++e) {
    EXPECT_LT((turns[e] - step.segment<3>(3 * static_cast<Eigen::Index>(e))).norm(), 1e-11);
  }
}

TEST_P(RandomRod, LowestEigenpairIsOne) {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  differentiate(gradient, hessian);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> dense(hessian);
  const double lowest = dense.eigenvalues()[0];
  const double shift = std::max(0.0, -1.1 * lowest);
  EXPECT_NEAR(energy_.lowestEigenvalue(shift).value(), lowest, 1e-4 * std::abs(lowest));
  const Eigen::VectorXd vector = flat(energy_.eigenvector(energy_.lean()));
  EXPECT_NEAR(vector.norm(), 1.0, 1e-9);
  EXPECT_NEAR(vector.dot(hessian * vector), lowest, 1e-4 * std::abs(lowest));
  const double margin = 1e-3 * std::abs(lowest);
  EXPECT_TRUE(energy_.findStep(-lowest + margin));
  EXPECT_FALSE(energy_.findStep(-lowest - margin));
}

TEST_P(RandomRod, FramesAreTheRodsOwn) {
  // The shape written back is the one the full formulas of rod/ make of curvature and strain.
  rod::Rod rod = at(0.3);
  rod::Rod rebuilt = rod;
  rebuilt.rebuild();
  for (std::size_t e = 0; e < rod.size(); ++e) {
    EXPECT_LT((rebuilt.elements[e].frame.toRotationMatrix() - rod.elements[e].frame.toRotationMatrix()).norm(), 1e-12);
    EXPECT_LT((rebuilt.vertices[e + 1].position - rod.vertices[e + 1].position).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRod,
                         testing::Combine(testing::Range(1u, 21u), testing::ValuesIn(availableInstructionSets())),
                         [](const auto& info) {
                           return std::to_string(std::get<0>(info.param)) + name(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace sensory_growth::mechanics
