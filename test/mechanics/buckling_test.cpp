// Heavy columns: V5 and V6 of model.md 18, iteration counts of 12.5.

#include <cmath>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

constexpr double kGreenhill = 7.837347439;

/// Upright column of length 1 and stiffness 1, leaning by `tilt` [rad].
rod::Rod column(std::size_t elements, double beta, double tilt = 0.0) {
  const rod::Pose base{Vector3::Zero(), rod::exp({0.0, tilt, 0.0})};
  return rod::straightRod(base, 1.0, elements, support::inextensibleSection(1.0, beta));
}

/// Zero of the lowest eigenvalue by bisection.
double bucklingLoad(std::size_t elements) {
  double stable = 7.0;
  double unstable = 8.5;
  StaticEquilibrium equilibrium;
  while (unstable - stable > 1e-9) {
    const double beta = 0.5 * (stable + unstable);
    const bool upright = equilibrium.lowestEigenvalue(column(elements, beta), support::unitGravity()) > 0.0;
    (upright ? stable : unstable) = beta;
  }
  return stable;
}

TEST(SelfBuckling, HappensAtGreenhillsLoad) {
  EXPECT_NEAR(bucklingLoad(100) / kGreenhill - 1.0, -0.5155e-4, 0.005e-4);
  EXPECT_NEAR(bucklingLoad(50) / kGreenhill - 1.0, -0.5155 / 2500.0, 0.005 / 2500.0);
}

struct Buckled {
  double load;  ///< over Greenhill's
  double lateral, height;
  int iterations;  ///< of model.md 12.5, from exactly upright
};

class BeyondBuckling : public testing::TestWithParam<Buckled> {};

TEST_P(BeyondBuckling, AnUprightColumnFindsTheBuckledShape) {
  const Buckled expected = GetParam();
  rod::Rod rod = column(100, expected.load * kGreenhill);
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_EQ(report.branch_switches, 1);
  EXPECT_LE(report.iterations, expected.iterations);
  const Vector3 tip = rod.vertices.back().position;
  EXPECT_NEAR(std::hypot(tip.x(), tip.y()), expected.lateral, 5e-4);
  EXPECT_NEAR(tip.z(), expected.height, 5e-4);
  // Any azimuth is an equilibrium, so the lowest eigenvalue is zero; the one we take does not change from run to run.
  EXPECT_NEAR(report.lowest_eigenvalue.value(), 0.0, 1e-6);
  EXPECT_GT(tip.x(), 0.0);
  EXPECT_NEAR(tip.y(), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(V6, BeyondBuckling,
                         testing::Values(Buckled{1.02, 0.293061428, 0.947968580, 4},
                                         Buckled{1.1, 0.588959139, 0.763178719, 5},
                                         Buckled{1.5, 0.848622001, 0.191308221, 8},
                                         Buckled{2.0, 0.798234849, -0.144507054, 9}));

TEST(Approach, HasAnErrorOfFourthOrder) {
  // From the equilibrium under a load that differs by a little.
  const auto error = [](double difference) {
    RelaxationSettings strict;
    strict.tolerance = 1e-15;
    StaticEquilibrium equilibrium(strict);
    rod::Rod exact = column(40, 4.0, 0.3);
    EXPECT_TRUE(equilibrium.relax(exact, support::unitGravity()).ok());
    rod::Rod rod = column(40, 4.0, 0.3);
    EXPECT_TRUE(equilibrium.relax(rod, scaled(support::unitGravity(), 1.0 - difference)).ok());
    const RelaxationReport report = equilibrium.approach(rod, support::unitGravity());
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.iterations, 2);
    return (rod.vertices.back().position - exact.vertices.back().position).norm();
  };
  EXPECT_NEAR(support::order(error(0.04), error(0.02)), 4.0, 0.3);
}

TEST(Approach, RelaxesWhatIsNotCloseOrCannotStand) {
  rod::Rod upright = column(100, 1.5 * kGreenhill);
  const RelaxationReport report = StaticEquilibrium().approach(upright, support::unitGravity());
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.branch_switches, 1);
  EXPECT_NEAR(upright.vertices.back().position.z(), 0.191308221, 5e-4);  // V6
}

TEST(Stability, IsDecidedWithoutTheEigenvalue) {
  rod::Rod standing = column(100, 0.99 * kGreenhill);
  const RelaxationReport stable = StaticEquilibrium().relax(standing, support::unitGravity(), Stability::decided);
  EXPECT_TRUE(stable.ok());
  EXPECT_FALSE(stable.lowest_eigenvalue.has_value());
  rod::Rod falling = column(100, 1.01 * kGreenhill);
  const RelaxationReport unstable = StaticEquilibrium().relax(falling, support::unitGravity(), Stability::decided);
  EXPECT_TRUE(unstable.ok());
  EXPECT_EQ(unstable.branch_switches, 1);
}

TEST(SelfBuckling, BelowTheLoadTheColumnStaysUpright) {
  rod::Rod rod = column(100, 0.999 * kGreenhill);
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.branch_switches, 0);
  EXPECT_GT(report.lowest_eigenvalue.value(), 0.0);
  EXPECT_LT(std::abs(rod.vertices.back().position.x()), 1e-12);
}

struct Tilted {
  double load;
  int iterations;
};

class TiltedColumn : public testing::TestWithParam<Tilted> {};

TEST_P(TiltedColumn, NeedsNoMoreIterationsThanThePrototype) {
  rod::Rod rod = column(100, GetParam().load * kGreenhill, 1e-3);
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok()) << describe(report);
  EXPECT_LE(report.iterations, GetParam().iterations);
}

INSTANTIATE_TEST_SUITE_P(ModelMd12_5, TiltedColumn,
                         testing::Values(Tilted{0.5, 2}, Tilted{0.9, 2}, Tilted{0.99, 4}, Tilted{1.0, 5},
                                         Tilted{1.01, 5}, Tilted{1.1, 10}, Tilted{1.5, 10}, Tilted{2.0, 20},
                                         Tilted{4.0, 25}));

}  // namespace
}  // namespace sensory_growth::mechanics
