// Gradient and Newton step of a rod in its surroundings against differences of an energy summed up here (model.md 17).

#include "supported_energy.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/energy.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

class RandomSurroundings : public testing::TestWithParam<std::tuple<unsigned, rod::BaseSupport>> {
 protected:
  static constexpr std::size_t kElements = 6;
  static constexpr double kPenalty = 40.0;

  void SetUp() override {
    std::mt19937 generator(std::get<0>(GetParam()));
    rod_ = support::randomRod(generator, kElements);
    rod_.base_support = std::get<1>(GetParam());
    if (rod_.base_support == rod::BaseSupport::frozen_first_element) {
      rod_.bends[0].curvature.setZero();
      rod_.rebuild();
    }
    loads_.gravity = support::randomVector(generator, 2.0);
    loads_.tip_force = support::randomVector(generator, 1.0);
    loads_.line_force = support::randomVector(generator, 1.0);
    Surroundings& s = loads_.surroundings;
    for (const double label : {0.3, 0.3, 0.5, 1.0}) {
      s.springs.push_back({label, support::randomVector(generator, 2.0), 7.0 * label});
    }
    const Vector3 middle = 0.5 * (rod_.vertices[2].position + rod_.vertices[3].position);
    s.walls.push_back({middle, support::randomVector(generator, 1.0).normalized(), 30.0});
    s.walls.push_back({middle + Vector3(0.01, 0.0, 0.0), support::randomVector(generator, 1.0).normalized()});
    s.held_apex = HeldApex{rod_.vertices.back().position + support::randomVector(generator, 0.3),
                           rod_.apex().frame * rod::exp(support::randomVector(generator, 0.5))};
    direction_ = randomVariation(generator);
    other_ = randomVariation(generator);

    energy_.assign(rod_, loads_);
    energy_.surroundings().setPenalty(kPenalty);
    energy_.evaluate(at(direction_, 0.0));
    energy_.differentiate(gradient_);
  }

  Variation randomVariation(std::mt19937& generator) const {
    Variation v{Field(3, kElements), Field(3, kElements)};
    for (Eigen::Index e = 0; e < v.rotations.cols(); ++e) {
      v.rotations.col(e) = support::randomVector(generator, 1.0);
      v.strains.col(e) = support::randomVector(generator, 0.3);
    }
    if (rod_.base_support == rod::BaseSupport::frozen_first_element) v.rotations.col(0).setZero();
    return v;
  }

  Configuration at(const Variation& direction, double h) const {
    Configuration c{{}, Field(3, kElements)};
    for (std::size_t e = 0; e < kElements; ++e) {
      const auto column = static_cast<Eigen::Index>(e);
      c.frames.push_back((rod_.elements[e].frame * rod::exp(h * direction.rotations.col(column))).normalized());
      c.strains.col(column) = rod_.elements[e].strain + h * direction.strains.col(column);
    }
    return c;
  }

  /// Term by term, from the definitions.
  double energyAt(const Configuration& c) const {
    rod::Rod rod = rod_;
    for (std::size_t e = 0; e < kElements; ++e) {
      const rod::Quaternion below = e > 0 ? c.frames[e - 1] : rod.base.frame;
      rod.elements[e].frame = c.frames[e];
      rod.elements[e].strain = c.strains.col(static_cast<Eigen::Index>(e));
      rod.bends[e].curvature = rod::log(below.conjugate() * c.frames[e]) / rod.voronoiLength(e);
    }
    rod.rebuildPositions();

    const Surroundings& s = loads_.surroundings;
    const Energy without = energy(rod, loads_);
    double sum = without.bending + without.stretching + without.load;
    const std::size_t tied[] = {2, 2, 3, 6};
    for (std::size_t i = 0; i < s.springs.size(); ++i) {
      sum += 0.5 * s.springs[i].stiffness * (rod.vertices[tied[i]].position - s.springs[i].anchor).squaredNorm();
    }
    for (const Wall& wall : s.walls) {
      for (std::size_t v = 1; v <= kElements; ++v) {
        const double depth = std::max(0.0, wall.normal.dot(wall.point - rod.vertices[v].position));
        sum += 0.5 * (std::isinf(wall.stiffness) ? kPenalty : wall.stiffness) * depth * depth;
      }
    }
    sum += 0.5 * kPenalty * (rod.vertices.back().position - s.held_apex->position).squaredNorm();
    const double half = 0.5 * rod.elements.back().rest_length;
    const Vector3 bent =
        rod::log(c.frames.back().conjugate() * *s.held_apex->frame) / half - rod.bends.back().rest_curvature;
    return sum + 0.5 * half * bent.dot(rod.elements.back().section.bendStiffness().cwiseProduct(bent));
  }

  rod::Rod rod_;
  Loads loads_;
  Variation direction_, other_, gradient_;
  SupportedEnergy energy_;
};

TEST_P(RandomSurroundings, EnergyIsTheSumOfItsTermsUpToAConstant) {
  const double here = energy_.evaluate(at(direction_, 0.0)) - energyAt(at(direction_, 0.0));
  const double there = energy_.evaluate(at(direction_, 0.1)) - energyAt(at(direction_, 0.1));
  EXPECT_NEAR(here, there, 1e-11 * energy_.magnitude());
}

TEST_P(RandomSurroundings, GradientAgreesWithDifferences) {
  const double h = 1e-6;
  const double difference = (energyAt(at(direction_, h)) - energyAt(at(direction_, -h))) / (2.0 * h);
  EXPECT_NEAR(gradient_.dot(direction_), difference, 1e-6 * energy_.magnitude());
}

TEST_P(RandomSurroundings, NewtonStepSolvesForTheSecondDifferences) {
  // In exponential coordinates, v^T (H + shift) step = -gradient . v for every v; the mixed difference is v^T H step.
  ChainHessian hessian;
  energy_.differentiateTwice(1.0, hessian);
  const double shift = 2.0 * hessian.largestDiagonal();
  ChainCholesky factor;
  ASSERT_TRUE(factor.factor(hessian, shift));
  Variation step;
  energy_.newtonStep(hessian, factor, gradient_, step);

  const double unit = 1.0 / step.rotations.colwise().norm().maxCoeff();
  const double h = 1e-4;
  for (const Variation& v : {direction_, other_}) {
    const Variation plus{v.rotations + unit * step.rotations, v.strains + unit * step.strains};
    const Variation minus{v.rotations - unit * step.rotations, v.strains - unit * step.strains};
    const double mixed =
        (energyAt(at(plus, h)) + energyAt(at(plus, -h)) - energyAt(at(minus, h)) - energyAt(at(minus, -h))) /
        (4.0 * h * h * unit);
    const double shifted = mixed + shift * v.rotations.cwiseProduct(step.rotations).sum();
    EXPECT_NEAR(shifted, -gradient_.dot(v), 1e-4 * energy_.magnitude());
  }
}

TEST_P(RandomSurroundings, LowestEigenvalueSeparatesWhatFactorsFromWhatDoesNot) {
  ChainHessian hessian;
  energy_.differentiateTwice(1.0, hessian);
  const ChainEigenpair pair = lowestEigenpair(hessian, direction_.rotations, 1e-12);
  const double margin = 1e-3 * std::abs(pair.value);
  EXPECT_TRUE(ChainCholesky().factor(hessian, -pair.value + margin));
  EXPECT_FALSE(ChainCholesky().factor(hessian, -pair.value - margin));
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSurroundings,
                         testing::Combine(testing::Range(1u, 9u),
                                          testing::Values(rod::BaseSupport::clamped,
                                                          rod::BaseSupport::frozen_first_element,
                                                          rod::BaseSupport::hinged)));

}  // namespace
}  // namespace sensory_growth::mechanics
