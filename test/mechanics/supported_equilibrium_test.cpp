// Rods with springs, walls, held ends and other bases against closed forms, the elastica, and the solver for dead
// loads.

#include "sensory_growth/mechanics/supported_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using support::order;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

rod::Rod horizontal(std::size_t elements, const rod::Section& section) {
  return rod::straightRod({Vector3::Zero(), support::alongX()}, 1.0, elements, section);
}

rod::Rod upright(std::size_t elements, const rod::Section& section) {
  return rod::straightRod({}, 1.0, elements, section);
}

Wall floorAt(double height, double stiffness = kInfinity) {
  return {Vector3(0.0, 0.0, height), Vector3::UnitZ(), stiffness};
}

Loads withWall(Loads loads, const Wall& wall) {
  loads.surroundings.walls.push_back(wall);
  return loads;
}

Loads withHeldApex(Loads loads, const Vector3& position, std::optional<rod::Quaternion> frame = {}) {
  loads.surroundings.held_apex = HeldApex{position, frame};
  return loads;
}

Vector3 tip(const rod::Rod& rod) { return rod.vertices.back().position; }

double largestDistance(const rod::Rod& one, const rod::Rod& other) {
  double largest = 0.0;
  for (std::size_t v = 0; v <= one.size(); ++v) {
    largest = std::max(largest, (one.vertices[v].position - other.vertices[v].position).norm());
  }
  return largest;
}

/// Relaxes and expects success.
Reactions relax(rod::Rod& rod, const Loads& loads) {
  SupportedEquilibrium equilibrium;
  const RelaxationReport report = equilibrium.relax(rod, loads);
  EXPECT_TRUE(report.ok()) << describe(report);
  return equilibrium.reactions();
}

// V11: heavy cantilever, beta = 10, whose tip touches a floor at -0.5 L.

constexpr double kTouchingTip = 0.849930;
constexpr double kTouchingForce = 1.894581;

TEST(RigidFloor, CarriesTheTipOfAHeavyCantilever) {
  rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 10.0));
  const Reactions reactions = relax(rod, withWall(support::unitGravity(), floorAt(-0.5)));
  EXPECT_NEAR(tip(rod).x(), kTouchingTip, 1e-3);
  EXPECT_NEAR(tip(rod).z(), -0.5, kSupportTolerance);
  EXPECT_NEAR(reactions.walls.at(0).z(), kTouchingForce, 1e-3);
  EXPECT_EQ(reactions.walls.at(0).head<2>().norm(), 0.0);
}

TEST(RigidFloor, IsMetToSecondOrder) {
  const auto errors = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::inextensibleSection(1.0, 10.0));
    const Reactions reactions = relax(rod, withWall(support::unitGravity(), floorAt(-0.5)));
    return std::pair(tip(rod).x() - kTouchingTip, reactions.walls.at(0).z() - kTouchingForce);
  };
  const auto [coarse, coarse_force] = errors(20);
  const auto [fine, fine_force] = errors(40);
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.1);
  EXPECT_NEAR(order(coarse_force, fine_force), 2.0, 0.1);
}

class Penalty : public testing::TestWithParam<std::tuple<std::pair<double, int>, double>> {};

TEST_P(Penalty, NeedsIterationsThatDoNotDependOnSlenderness) {
  const auto [wall, slenderness] = GetParam();
  const auto [stiffness, iterations] = wall;
  const rod::Section section = std::isinf(slenderness) ? support::inextensibleSection(1.0, 10.0)
                                                       : support::section(1.0 / slenderness, 1.0, 10.0);
  rod::Rod rod = horizontal(100, section);
  const RelaxationReport report =
      SupportedEquilibrium().relax(rod, withWall(support::unitGravity(), floorAt(-0.5, stiffness)));
  EXPECT_TRUE(report.ok()) << describe(report);
  EXPECT_LE(report.iterations, iterations);
  EXPECT_GT(report.lowest_eigenvalue.value(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(ModelMd12_3, Penalty,
                         testing::Combine(testing::Values(std::pair(1e2, 6), std::pair(1e4, 10), std::pair(1e6, 20),
                                                          std::pair(kInfinity, 20)),
                                          testing::Values(30.0, 100.0, 1000.0, 3000.0, kInfinity)));

TEST(SoftFloor, PushesWithStiffnessTimesDepth) {
  rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 10.0));
  const Reactions reactions = relax(rod, withWall(support::unitGravity(), floorAt(-0.5, 1e2)));
  double push = 0.0;
  for (const rod::Vertex& v : rod.vertices) push += 1e2 * std::max(0.0, -0.5 - v.position.z());
  EXPECT_GT(push, 1.0);
  EXPECT_NEAR(reactions.walls.at(0).z(), push, 1e-10);
}

TEST(RigidFloor, CarriesARodThatLiesOnIt) {
  // Small slopes: a clamp h above the floor holds up a length a, a^4 = 72 B h / w, and bears 2 w a / 3.
  const double w = 1.152, h = 1e-3, a = 0.5;
  const auto error = [&](std::size_t n) {
    rod::Rod rod = horizontal(n, support::inextensibleSection(1.0, w));
    const Reactions reactions = relax(rod, withWall(support::unitGravity(), floorAt(-h)));
    for (const rod::Vertex& v : rod.vertices) {
      EXPECT_GT(v.position.z(), -h - kSupportTolerance);
      if (v.label <= a + 2.0 / static_cast<double>(n)) continue;
      EXPECT_NEAR(v.position.z(), -h, 1e-5 * h);
    }
    return reactions.walls.at(0).z() / (w - 2.0 / 3.0 * w * a) - 1.0;
  };
  EXPECT_LT(std::abs(error(40)), 2e-3);
  EXPECT_LT(std::abs(error(160)), 2e-4);
}

TEST(RigidWalls, HoldARodInACorner) {
  // A stiff tip force pushes the apex into a corner; both walls bear it where they face it.
  rod::Rod rod = horizontal(40, support::inextensibleSection(1.0, 0.0));
  Loads loads;
  loads.tip_force = {0.0, 5.0, -5.0};
  loads.surroundings.walls = {floorAt(-0.2), {Vector3(0.0, 0.1, 0.0), -Vector3::UnitY()}};
  const Reactions reactions = relax(rod, loads);
  EXPECT_NEAR(tip(rod).z(), -0.2, kSupportTolerance);
  EXPECT_NEAR(tip(rod).y(), 0.1, kSupportTolerance);
  EXPECT_GT(reactions.walls[0].z(), 0.0);
  EXPECT_LT(reactions.walls[1].y(), 0.0);
}

TEST(IdleSurroundings, LeaveTheEquilibriumOfDeadLoads) {
  for (const double slenderness : {20.0, 1000.0}) {
    rod::Rod rod = horizontal(60, support::section(1.0 / slenderness, 1.0, 10.0));
    for (rod::Bend& b : rod.bends) b.rest_curvature = {1.0, 0.5, -0.7};
    Loads loads = support::unitGravity();
    loads.tip_force = {0.3, -0.4, 0.2};
    rod::Rod expected = rod;
    ASSERT_TRUE(StaticEquilibrium().relax(expected, loads).ok());
    loads.surroundings.springs.push_back({0.5, Vector3(1.0, 2.0, 3.0), 0.0});
    loads.surroundings.walls.push_back(floorAt(-3.0));
    const Reactions reactions = relax(rod, loads);
    EXPECT_LT(largestDistance(rod, expected), 1e-9);
    EXPECT_EQ(reactions.springs.at(0).norm(), 0.0);
    EXPECT_EQ(reactions.walls.at(0).norm(), 0.0);
  }
}

TEST(Spring, ThatIsSoftAndFarIsADeadForce) {
  // V3, alpha = 5.
  rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 0.0));
  Loads loads;
  loads.surroundings.springs.push_back({1.0, Vector3(0.0, 0.0, -5e6), 1e-6});
  relax(rod, loads);
  EXPECT_LT((tip(rod) - Vector3(0.612371639, 0.0, -0.713791524)).norm(), 1e-4);
}

TEST(Spring, SharesALoadWithACantilever) {
  // Small deflection: 3 B / L^3 and k in parallel.
  for (const double k : {0.5, 3.0, 1e3}) {
    rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 0.0));
    Loads loads;
    loads.tip_force = {0.0, 0.0, -1e-4};
    loads.surroundings.springs.push_back({1.0, tip(rod), k});
    const Reactions reactions = relax(rod, loads);
    EXPECT_NEAR(tip(rod).z() * (3.0 + k) / -1e-4, 1.0, 1e-4);
    EXPECT_NEAR(reactions.springs.at(0).z() * (3.0 + k) / (1e-4 * k), 1.0, 1e-4);
  }
}

TEST(Spring, IsTiedToTheNearestVertex) {
  const rod::Rod rod = horizontal(10, support::section(0.01, 1.0, 0.0));
  const auto tied = [&](double label) { return tiedVertex(rod, {label, Vector3::Zero(), 1.0}); };
  EXPECT_EQ(tied(0.0), 0u);
  EXPECT_EQ(tied(0.26), 3u);
  EXPECT_EQ(tied(0.24), 2u);
  EXPECT_EQ(tied(0.96), 10u);
  EXPECT_EQ(tied(1.0), 10u);
}

TEST(HeldApex, OfAProppedCantileverBearsThreeEighths) {
  const auto error = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::section(1e-3, 1.0, 0.0));
    Loads loads = withHeldApex({}, tip(rod));
    loads.line_force = {0.0, 0.0, -1e-3};
    return relax(rod, loads).apex_force.z() / 1e-3 - 3.0 / 8.0;
  };
  EXPECT_NEAR(error(100), 0.0, 1e-4);
  EXPECT_NEAR(order(error(20), error(40)), 2.0, 0.05);
}

TEST(HeldApex, WithItsFrameClampsTheOtherEnd) {
  const auto error = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::section(1e-3, 1.0, 0.0));
    Loads loads = withHeldApex({}, tip(rod), support::alongX());
    loads.line_force = {0.0, 0.0, -1e-3};
    const Reactions reactions = relax(rod, loads);
    EXPECT_NEAR(reactions.apex_force.z(), 1e-3 / 2.0, 1e-9);
    EXPECT_NEAR(std::abs(reactions.apex_couple.y()), 1e-3 / 12.0, 1e-3 / static_cast<double>(n * n));
    return rod.vertices[n / 2].position.z() / (-1e-3 / 384.0) - 1.0;
  };
  EXPECT_NEAR(error(100), 0.0, 1e-3);
  EXPECT_NEAR(order(error(20), error(40)), 2.0, 0.05);
}

/// Shortening at which a straight rod between two supports buckles, by bisection.
double bucklingStrain(rod::BaseSupport base, std::optional<rod::Quaternion> frame, double slenderness) {
  double straight = 0.0, buckled = 100.0 / (slenderness * slenderness);
  while (buckled - straight > 1e-3 * buckled) {
    const double strain = 0.5 * (straight + buckled);
    rod::Rod rod = upright(60, support::section(1.0 / slenderness, 1.0, 0.0));
    rod.base_support = base;
    relax(rod, withHeldApex({}, (1.0 - strain) * Vector3::UnitZ(), frame));
    const bool bent = rod.vertices[30].position.head<2>().norm() > 1e-8;
    (bent ? buckled : straight) = strain;
  }
  return straight;
}

TEST(HeldApex, ThatComesCloserBucklesAPinnedRodAtEulersLoad) {
  EXPECT_NEAR(bucklingStrain(rod::BaseSupport::hinged, {}, 100.0) / (M_PI * M_PI / 4e4), 1.0, 5e-3);
}

TEST(HeldApex, ThatComesCloserBucklesAClampedRodAtFourTimesEulersLoad) {
  const double strain = bucklingStrain(rod::BaseSupport::clamped, rod::Quaternion::Identity(), 100.0);
  EXPECT_NEAR(strain / (4.0 * M_PI * M_PI / 4e4), 1.0, 5e-3);
}

struct Elastica {
  double load;    ///< over Euler's
  double height;  ///< distance of the ends
  double bulge;   ///< of the middle, times 2
};

class PinnedColumn : public testing::TestWithParam<Elastica> {};

TEST_P(PinnedColumn, FollowsTheElastica) {
  // V4: half of a pinned column is a cantilever under end load.
  const Elastica expected = GetParam();
  for (const rod::Section& section : {support::inextensibleSection(1.0, 0.0), support::section(1e-3, 1.0, 0.0)}) {
    rod::Rod rod = upright(100, section);
    rod.base_support = rod::BaseSupport::hinged;
    const Reactions reactions = relax(rod, withHeldApex({}, expected.height * Vector3::UnitZ()));
    EXPECT_NEAR(-reactions.apex_force.z() / (M_PI * M_PI), expected.load, 3e-4);
    EXPECT_NEAR(rod.vertices[50].position.head<2>().norm(), 0.5 * expected.bulge, 2e-4);
    EXPECT_NEAR(rod.vertices[50].position.z(), 0.5 * expected.height, 1e-6);
    // Any azimuth is an equilibrium; it bulges about where it is said to.
    EXPECT_GT(rod.vertices[50].position.x(), 0.99 * 0.5 * expected.bulge);
  }
}

INSTANTIATE_TEST_SUITE_P(V4, PinnedColumn,
                         testing::Values(Elastica{1.015396866, 0.969730907, 0.219413042},
                                         Elastica{1.151719620, 0.741019606, 0.593207646},
                                         Elastica{1.884800869, 0.123159972, 0.803170991}));

TEST(HeldApex, MayBeFarFromWhereTheRodStands) {
  rod::Rod rod = upright(60, support::section(0.01, 1.0, 1.0));
  const rod::Quaternion down = rod::exp({0.0, M_PI, 0.0});
  const Loads loads = withHeldApex(support::unitGravity(), Vector3(0.3, 0.0, 0.0), down);
  relax(rod, loads);
  EXPECT_LT((tip(rod) - Vector3(0.3, 0.0, 0.0)).norm(), 1.01 * kSupportTolerance);
  // The extrapolated frame of the apex has the order of the discretisation.
  EXPECT_LT(rod.apex().frame.angularDistance(down), 1e-2);
}

TEST(HingedBase, LetsARodHangDown) {
  for (const rod::Quaternion& start : {support::alongX(), rod::exp({0.1, 0.2, 0.0}), rod::exp({0.0, 0.0, 0.0})}) {
    rod::Rod rod = rod::straightRod({Vector3::Zero(), start}, 1.0, 50, support::inextensibleSection(1.0, 10.0));
    rod.base_support = rod::BaseSupport::hinged;
    relax(rod, support::unitGravity());
    for (const rod::Vertex& v : rod.vertices) EXPECT_LT((v.position + v.label * Vector3::UnitZ()).norm(), 1e-8);
  }
}

TEST(HingedBase, TurnsUntilASpringBearsTheRod) {
  // Stiff rod at an angle phi: the spring's anchor (a, 0, c) bears half the weight, tan phi = (k c - W / 2) / (k a).
  rod::Rod rod = horizontal(20, support::inextensibleSection(1e5, 1.0));
  rod.base_support = rod::BaseSupport::hinged;
  Loads loads = support::unitGravity();
  loads.surroundings.springs.push_back({1.0, Vector3(1.0, 0.0, 0.8), 2.0});
  relax(rod, loads);
  const double phi = std::atan2(2.0 * 0.8 - 0.5, 2.0);
  EXPECT_LT((tip(rod) - Vector3(std::cos(phi), 0.0, std::sin(phi))).norm(), 2e-5);
}

TEST(FrozenFirstElement, CostsAnOrder) {
  const auto error = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::inextensibleSection(1.0, 10.0));
    rod.base_support = rod::BaseSupport::frozen_first_element;
    relax(rod, withWall(support::unitGravity(), floorAt(-2.0)));
    EXPECT_EQ(rod.elements[0].frame.angularDistance(rod.base.frame), 0.0);
    return (tip(rod) - Vector3(0.656353761, 0.0, -0.700199716)).norm();
  };
  EXPECT_NEAR(error(50), 1.95e-2, 0.01e-2);  // model.md 1.4
  EXPECT_NEAR(error(100), 9.69e-3, 0.01e-3);
  EXPECT_NEAR(error(200), 4.84e-3, 0.01e-3);
}

TEST(TipCouple, BendsIntoACircleAndTwists) {
  // V9.
  rod::Rod rod = horizontal(50, support::section(0.01, 1.5, 0.0));
  Loads loads = withWall({}, floorAt(-9.0));
  loads.tip_couple = {0.0, 3.0, 0.0};
  relax(rod, loads);
  for (const rod::Bend& b : rod.bends) EXPECT_LT((b.curvature - Vector3(0.0, 2.0, 0.0)).norm(), 1e-8);
  loads.tip_couple = {0.0, 0.0, 0.5};
  rod = horizontal(50, support::section(0.01, 1.5, 0.0));
  relax(rod, loads);
  for (const rod::Bend& b : rod.bends) EXPECT_LT((b.curvature - Vector3(0.0, 0.0, 0.5)).norm(), 1e-8);
}

TEST(TipCouple, KeepsConvergenceQuadraticInSpace) {
  rod::Rod rod = horizontal(50, support::section(0.01, 1.0, 5.0));
  Loads loads = withWall(support::unitGravity(), floorAt(-0.4, 1e2));
  loads.tip_couple = {0.8, -0.5, 0.6};
  const RelaxationReport report = SupportedEquilibrium().relax(rod, loads);
  EXPECT_TRUE(report.ok()) << describe(report);
  EXPECT_LE(report.iterations, 10);
}

TEST(SupportedEquilibrium, TurnsRigidlyWithEverything) {
  std::mt19937 generator(5);
  rod::Rod rod = support::randomRod(generator, 30);
  Loads loads;
  loads.gravity = {0.3, -0.2, -1.0};
  loads.tip_couple = {0.1, 0.2, 0.1};
  loads.line_force = {0.1, 0.4, -0.3};
  const Vector3 middle = rod.vertices[15].position;
  loads.surroundings.springs.push_back({0.5, middle + Vector3(0.3, 0.1, 0.0), 20.0});
  loads.surroundings.walls.push_back({middle, Vector3(0.6, 0.0, 0.8), 50.0});
  loads.surroundings.held_apex = HeldApex{tip(rod) - Vector3(0.0, 0.05, 0.1), rod.apex().frame};

  const rod::Quaternion turn = rod::exp({0.7, -1.1, 0.4});
  const Vector3 shift(0.5, -2.0, 1.0);
  const auto moved = [&](const Vector3& x) -> Vector3 { return turn * x + shift; };
  rod::Rod turned_rod = rod;
  turned_rod.base = {moved(rod.base.position), turn * rod.base.frame};
  turned_rod.rebuild();
  Loads turned = loads;
  turned.gravity = turn * loads.gravity;
  turned.line_force = turn * loads.line_force;
  Surroundings& s = turned.surroundings;
  s.springs[0].anchor = moved(s.springs[0].anchor);
  s.walls[0].point = moved(s.walls[0].point);
  s.walls[0].normal = turn * s.walls[0].normal;
  s.held_apex = HeldApex{moved(s.held_apex->position), turn * *s.held_apex->frame};

  const Reactions reactions = relax(rod, loads);
  const Reactions turned_reactions = relax(turned_rod, turned);
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    EXPECT_LT((turned_rod.vertices[v].position - moved(rod.vertices[v].position)).norm(), 1e-8);
  }
  EXPECT_LT((turned_reactions.apex_force - turn * reactions.apex_force).norm(), 1e-5);
  EXPECT_LT((turned_reactions.apex_couple - turn * reactions.apex_couple).norm(), 1e-5);
}

TEST(SupportedEquilibrium, SaysWhenTheApexIsHeldOutOfReachAndLeavesTheRodAlone) {
  rod::Rod rod = upright(20, support::inextensibleSection(1.0, 1.0));
  const rod::Rod before = rod;
  const RelaxationReport report = SupportedEquilibrium().relax(rod, withHeldApex({}, {0.0, 0.9, 0.9}));
  EXPECT_EQ(report.reason, RelaxationReason::out_of_reach) << describe(report);
  EXPECT_EQ(largestDistance(rod, before), 0.0);
  EXPECT_NE(describe(report).find("out_of_reach"), std::string::npos);
}

TEST(SupportedEquilibrium, SaysWhenIterationsRunOutAndLeavesTheRodAlone) {
  RelaxationSettings hurried;
  hurried.max_iterations = 2;
  rod::Rod rod = horizontal(20, support::section(0.01, 1.0, 10.0));
  const rod::Rod before = rod;
  const RelaxationReport report =
      SupportedEquilibrium(hurried).relax(rod, withWall(support::unitGravity(), floorAt(-0.5)));
  EXPECT_EQ(report.reason, RelaxationReason::too_many_iterations);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_EQ(largestDistance(rod, before), 0.0);
}

TEST(SupportedEquilibrium, RefusesNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto reason = [](const Loads& loads) {
    rod::Rod rod = horizontal(10, support::section(0.01, 1.0, 1.0));
    const rod::Rod before = rod;
    const RelaxationReason found = SupportedEquilibrium().relax(rod, loads).reason;
    EXPECT_EQ(largestDistance(rod, before), 0.0);
    return found;
  };
  Loads loads = support::unitGravity();
  loads.surroundings.springs.push_back({1.0, Vector3(0.0, nan, 0.0), 1.0});
  EXPECT_EQ(reason(loads), RelaxationReason::not_finite);
  EXPECT_EQ(reason(withWall({}, floorAt(nan))), RelaxationReason::not_finite);
  EXPECT_EQ(reason(withWall({}, floorAt(-1.0, nan))), RelaxationReason::not_finite);
  EXPECT_EQ(reason(withHeldApex({}, {nan, 0.0, 0.0})), RelaxationReason::not_finite);
  loads = {};
  loads.tip_couple.x() = nan;
  EXPECT_EQ(reason(loads), RelaxationReason::not_finite);
  loads = withWall({}, floorAt(-1.0));
  for (const double huge : {1e160, 1e308}) {
    loads.tip_force = {0.0, 0.0, -huge};
    EXPECT_EQ(reason(loads), RelaxationReason::not_finite);
  }
}

}  // namespace
}  // namespace sensory_growth::mechanics
