// Rods of few elements on every base, small couples, long columns: where formulas meet their limits.

#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/dynamics.h"
#include "sensory_growth/mechanics/rest_shape.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::BaseSupport;
using rod::Vector3;

rod::Rod column(std::size_t elements, double weight) {
  return rod::straightRod({}, 1.0, elements, support::inextensibleSection(1.0, weight));
}

class FewElements : public testing::TestWithParam<std::size_t> {};

TEST_P(FewElements, HangFromAHinge) {
  rod::Rod rod = column(GetParam(), 3.0);
  rod.base_support = BaseSupport::hinged;
  rod.bends[0].curvature = {0.0, 1.2 / rod.voronoiLength(0), 0.0};
  rod.rebuild();
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_LT((rod.vertices.back().position + Vector3::UnitZ()).norm(), 1e-7);
}

TEST_P(FewElements, StandOnAFrozenOne) {
  rod::Rod rod = column(GetParam(), 3.0);
  rod.base_support = BaseSupport::frozen_first_element;
  Loads loads = support::unitGravity();
  EXPECT_TRUE(StaticEquilibrium().relax(rod, loads).ok());
  loads.surroundings.springs.push_back({1.0, {0.3, 0.0, 1.0}, 2.0});
  const RelaxationReport report = StaticEquilibrium().relax(rod, loads);
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_TRUE(std::isfinite(report.lowest_eigenvalue.value()));
}

INSTANTIATE_TEST_SUITE_P(Elements, FewElements, testing::Values(1, 2, 3));

TEST(HingedBase, MayTurnByMoreThanABendMay) {
  // The base frame points up, the rod hangs: 2.9 rad are no unresolved bend, in statics and in dynamics.
  const auto hanging = [] {
    rod::Rod rod = rod::straightRod({}, 1.0, 8, support::section(0.05, 1.0, 2.0));
    rod.base_support = BaseSupport::hinged;
    rod.bends[0].curvature = {0.0, 2.9 / rod.voronoiLength(0), 0.0};
    rod.rebuild();
    return rod;
  };
  rod::Rod still = hanging();
  EXPECT_TRUE(StaticEquilibrium().relax(still, support::unitGravity()).ok());
  rod::Rod moving = hanging();
  const RelaxationReport report = DynamicRelaxation().advance(moving, support::unitGravity(), 0.5);
  EXPECT_TRUE(report.ok()) << describe(report);
  EXPECT_LT(report.largest_bend, 0.1);
}

TEST(BodyCouple, DoesNotHideAnInstability) {
  // About the axis it would drive the buckled column round and round, so here it bends.
  for (const double couple : {1e-300, 1e-6}) {
    rod::Rod rod = column(50, 40.0);
    Loads loads = support::unitGravity();
    loads.tip_couple = {0.0, couple, 0.0};
    const RelaxationReport report = StaticEquilibrium().relax(rod, loads);
    ASSERT_TRUE(report.ok()) << describe(report);
    EXPECT_LT(rod.vertices.back().position.z(), 0.5);
  }
}

TEST(LongColumn, BucklesInAsFewIterationsAsAShortOne) {
  rod::Rod rod = column(4000, 1.5 * 7.837347439);
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_LE(report.iterations, 8);                                   // as with 100 elements, model.md 12.5
  EXPECT_NEAR(rod.vertices.back().position.x(), 0.848622001, 1e-6);  // V6
}

class Base : public testing::TestWithParam<BaseSupport> {};

TEST_P(Base, EveryMethodFindsTheSameRestShape) {
  const auto curved = [] {
    rod::Rod rod =
        rod::straightRod({Vector3::Zero(), rod::exp({0.2, -0.4, 0.1})}, 1.0, 12, support::section(0.05, 1.0, 1.0));
    rod.base_support = GetParam();
    for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) rod.bends[j].rest_curvature = {0.4, 1.1, -0.6};
    return rod;
  };
  rod::Rod rest = curved(), still = curved(), moving = curved();
  ASSERT_TRUE(assumeRestShape(rest, {}).ok());
  ASSERT_TRUE(StaticEquilibrium().relax(still, {}).ok());
  const RelaxationReport report = DynamicRelaxation().relax(moving, {});
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_LT((still.vertices.back().position - rest.vertices.back().position).norm(), 1e-8);
  EXPECT_LT((moving.vertices.back().position - rest.vertices.back().position).norm(), 1e-7);
}

// Not on a hinge, where nothing says which way an unloaded rod points.
INSTANTIATE_TEST_SUITE_P(Supports, Base, testing::Values(BaseSupport::clamped, BaseSupport::frozen_first_element));

TEST(DynamicRelaxation, DoesNotMoveBackInTime) {
  rod::Rod rod = rod::straightRod({}, 1.0, 4, support::section(0.05, 1.0, 1.0));
  EXPECT_THROW(DynamicRelaxation().advance(rod, {}, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace sensory_growth::mechanics
