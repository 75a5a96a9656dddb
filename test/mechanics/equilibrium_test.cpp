// Static equilibria against closed forms and independent shooting solutions: V1, V2, V3 of model.md 18.

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/division.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using support::order;

struct Deflection {
  double load;         ///< beta = w L^3 / B or alpha = P L^2 / B
  double x, z, angle;  ///< of the tip over L, and the angle of the tip from the horizontal [rad]
};

rod::Rod horizontal(std::size_t elements, const rod::Section& section) {
  return rod::straightRod({Vector3::Zero(), support::alongX()}, 1.0, elements, section);
}

double tipError(const rod::Rod& rod, double x, double z) {
  return (rod.vertices.back().position - Vector3(x, 0.0, z)).norm();
}

rod::Rod heavyCantilever(std::size_t elements, double beta) {
  rod::Rod rod = horizontal(elements, support::inextensibleSection(1.0, beta));
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok()) << describe(report);
  return rod;
}

class HeavyCantilever : public testing::TestWithParam<Deflection> {};

TEST_P(HeavyCantilever, AgreesWithTheElastica) {
  const Deflection expected = GetParam();
  const rod::Rod rod = heavyCantilever(100, expected.load);
  EXPECT_LT(tipError(rod, expected.x, expected.z), 2e-4);
  const Vector3 tangent = rod.apex().frame * Vector3::UnitZ();
  EXPECT_NEAR(std::atan2(tangent.z(), tangent.x()), expected.angle, 2e-4);
}

INSTANTIATE_TEST_SUITE_P(V1, HeavyCantilever,
                         testing::Values(Deflection{1, 0.991246395, -0.123471402, -0.165115561},
                                         Deflection{5, 0.846657180, -0.495905045, -0.697004778},
                                         Deflection{10, 0.656353761, -0.700199716, -1.052643117},
                                         Deflection{20, 0.445232052, -0.829881443, -1.339501542}));

TEST(HeavyCantileverConvergence, IsSecondOrderInSpace) {
  const auto error = [](std::size_t n) { return tipError(heavyCantilever(n, 10.0), 0.656353761, -0.700199716); };
  EXPECT_NEAR(error(50), 2.31e-4, 0.02e-4);  // model.md 1.4
  EXPECT_NEAR(order(error(50), error(100)), 2.0, 0.02);
  EXPECT_NEAR(order(error(100), error(200)), 2.0, 0.02);
}

TEST(HeavyCantileverConvergence, VeryHeavyConvergesToTheElastica) {
  const auto error = [](std::size_t n) { return tipError(heavyCantilever(n, 50.0), 0.245014756, -0.907917123); };
  EXPECT_NEAR(order(error(100), error(200)), 2.0, 0.05);
  EXPECT_LT(error(400), 5e-5);
}

struct Slenderness {
  double ratio;  ///< L / R
  double x, z;
};

class CosseratCantilever : public testing::TestWithParam<Slenderness> {};

TEST_P(CosseratCantilever, AgreesWithTheExtensibleShearableRod) {
  const Slenderness expected = GetParam();
  rod::Section section = support::section(1.0 / expected.ratio, 1.0, 10.0);
  // V2 prescribes alpha G A = E A / 3, that is alpha = 1 for G = E / 3.
  section.shear_correction = 1.0;
  rod::Rod rod = horizontal(100, section);
  ASSERT_TRUE(StaticEquilibrium().relax(rod, support::unitGravity()).ok());
  EXPECT_LT(tipError(rod, expected.x, expected.z), 2e-4);
}

INSTANTIATE_TEST_SUITE_P(V2, CosseratCantilever,
                         testing::Values(Slenderness{10, 0.652039667, -0.722990158},
                                         Slenderness{20, 0.655275835, -0.705876094},
                                         Slenderness{100, 0.656310653, -0.700426501}));

class EndLoad : public testing::TestWithParam<Deflection> {};

TEST_P(EndLoad, AgreesWithTheElastica) {
  const Deflection expected = GetParam();
  rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 0.0));
  Loads loads;
  loads.tip_force = -expected.load * Vector3::UnitZ();
  ASSERT_TRUE(StaticEquilibrium().relax(rod, loads).ok());
  EXPECT_LT(tipError(rod, expected.x, expected.z), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(V3, EndLoad,
                         testing::Values(Deflection{1, 0.943566764, -0.301720774, 0},
                                         Deflection{2, 0.839358279, -0.493457480, 0},
                                         Deflection{5, 0.612371639, -0.713791524, 0},
                                         Deflection{10, 0.445004402, -0.810609025, 0}));

class NewtonIterations : public testing::TestWithParam<double> {};

TEST_P(NewtonIterations, DoNotDependOnSlenderness) {
  rod::Rod rod = horizontal(100, support::section(1.0 / GetParam(), 1.0, 10.0));
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok());
  EXPECT_LE(report.iterations, 5);  // model.md 12.5
  EXPECT_LT(report.residual, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(LengthOverRadius, NewtonIterations, testing::Values(10, 100, 1000, 3000));

TEST(StaticEquilibrium, FindsTheRestShapeWithoutLoads) {
  rod::Rod rod = horizontal(40, support::section(0.01, 1.0, 1.0));
  for (rod::Bend& b : rod.bends) b.rest_curvature = {0.0, 2.0, 3.0};
  const RelaxationReport report = StaticEquilibrium().relax(rod, {});
  ASSERT_TRUE(report.ok());
  EXPECT_GT(report.lowest_eigenvalue.value(), 0.0);
  for (const rod::Bend& b : rod.bends) EXPECT_LT((b.curvature - b.rest_curvature).norm(), 1e-9);
}

TEST(StaticEquilibrium, TurnsRigidlyWithBaseAndLoads) {
  std::mt19937 generator(11);
  rod::Rod rod = support::randomRod(generator, 30);
  Loads loads;
  loads.gravity = {0.3, -0.2, -1.0};
  loads.tip_force = {0.1, 0.4, -0.3};
  const rod::Quaternion turn = rod::exp({0.7, -1.1, 0.4});
  rod::Rod turned = rod;
  turned.base = {turn * rod.base.position, turn * rod.base.frame};
  turned.rebuild();
  Loads turned_loads;
  turned_loads.gravity = turn * loads.gravity;
  turned_loads.tip_force = turn * loads.tip_force;

  RelaxationSettings strict;
  strict.tolerance = 1e-13;
  ASSERT_TRUE(StaticEquilibrium(strict).relax(rod, loads).ok());
  ASSERT_TRUE(StaticEquilibrium(strict).relax(turned, turned_loads).ok());
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    EXPECT_LT((turned.vertices[v].position - turn * rod.vertices[v].position).norm(), 1e-11);
  }
}

TEST(StaticEquilibrium, DoesNotDependOnTheRollOfTheBase) {
  const auto relaxed = [](double roll) {
    rod::Rod rod = rod::straightRod({Vector3::Zero(), support::rolled(support::alongX(), roll)}, 1.0, 50,
                                    support::section(0.02, 1.0, 10.0));
    EXPECT_TRUE(StaticEquilibrium().relax(rod, support::unitGravity()).ok());
    return rod;
  };
  const rod::Rod reference = relaxed(0.0);
  for (const double roll : {0.5, 1.7, -2.9}) {
    const rod::Rod rod = relaxed(roll);
    for (std::size_t v = 0; v <= rod.size(); ++v) {
      EXPECT_LT((rod.vertices[v].position - reference.vertices[v].position).norm(), 1e-12);
    }
  }
}

TEST(StaticEquilibrium, HarmonicStiffnessKeepsSecondOrderAtAJump) {
  // V7: B = 16 for s < 1/2 and 1 beyond, tip load 0.05.
  const auto relative_error = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::inextensibleSection(1.0, 0.0));
    for (std::size_t e = 0; e < n / 2; ++e) rod.elements[e].section = support::inextensibleSection(16.0, 0.0);
    Loads loads;
    loads.tip_force = {0.0, 0.0, -0.05};
    EXPECT_TRUE(StaticEquilibrium().relax(rod, loads).ok());
    return std::abs(rod.vertices.back().position.z() / -0.00299472363 - 1.0);
  };
  EXPECT_LT(relative_error(100), 2e-4);
  EXPECT_NEAR(order(relative_error(40), relative_error(80)), 2.0, 0.05);
}

TEST(StaticEquilibrium, RefusesNumbersThatAreNotFinite) {
  rod::Rod rod = horizontal(10, support::section(0.01, 1.0, 1.0));
  const rod::Rod before = rod;
  Loads loads = support::unitGravity();
  loads.tip_force.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(StaticEquilibrium().relax(rod, loads).reason, RelaxationReason::not_finite);
  const auto broken = [&](const std::function<void(rod::Rod&)>& damage) {
    rod::Rod damaged = before;
    damage(damaged);
    const RelaxationReason reason = StaticEquilibrium().relax(damaged, support::unitGravity()).reason;
    EXPECT_EQ(damaged.vertices.back().position, before.vertices.back().position);
    return reason;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(broken([&](rod::Rod& r) { r.bends[3].rest_curvature.x() = nan; }), RelaxationReason::not_finite);
  EXPECT_EQ(broken([&](rod::Rod& r) { r.elements[2].section.young_modulus = nan; }), RelaxationReason::not_finite);
  EXPECT_EQ(broken([&](rod::Rod& r) { r.elements[2].section.density = nan; }), RelaxationReason::not_finite);
  EXPECT_EQ(broken([&](rod::Rod& r) { r.elements[2].rest_length = -1.0; }), RelaxationReason::not_finite);
  EXPECT_EQ(broken([&](rod::Rod& r) { r.base.frame.x() = nan; }), RelaxationReason::not_finite);
  loads.tip_force = {0.0, 1e308, 0.0};
  EXPECT_EQ(StaticEquilibrium().relax(rod, loads).reason, RelaxationReason::not_finite);
}

TEST(StaticEquilibrium, SaysWhenTheRodIsTooCoarseAndLeavesItAlone) {
  rod::Rod rod = horizontal(4, support::section(0.01, 1.0, 0.0));
  for (rod::Bend& b : rod.bends) b.rest_curvature = {0.0, 8.0, 0.0};  // 2 rad between neighbours
  const RelaxationReport report = StaticEquilibrium().relax(rod, {});
  EXPECT_EQ(report.reason, RelaxationReason::unresolved_bend);
  EXPECT_NEAR(report.largest_bend, 2.0, 1e-8);
  EXPECT_EQ(rod.vertices.back().position.x(), 1.0);
}

TEST(StaticEquilibrium, DoesNotAskForLessThanRoundOff) {
  RelaxationSettings impossible;
  impossible.tolerance = 0.0;
  for (const std::size_t n : {100u, 10000u}) {
    rod::Rod rod = horizontal(n, support::section(0.01, 1.0, 1.0));
    const RelaxationReport report = StaticEquilibrium(impossible).relax(rod, support::unitGravity());
    EXPECT_TRUE(report.ok()) << describe(report);
    EXPECT_LE(report.iterations, 6);
  }
}

TEST(StaticEquilibrium, LimitsTheTurnOfAnIteration) {
  // Few elements with a strong rest curvature: unlimited steps would leave the range where rotation vectors are unique.
  rod::Rod rod = horizontal(6, support::section(0.01, 1.0, 10.0));
  for (rod::Bend& b : rod.bends) b.rest_curvature = {3.0, -6.0, 2.0};
  const RelaxationReport report = StaticEquilibrium().relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok()) << describe(report);
  EXPECT_GT(report.lowest_eigenvalue.value(), 0.0);
}

TEST(StaticEquilibrium, SaysWhenIterationsRunOut) {
  RelaxationSettings hurried;
  hurried.max_iterations = 2;
  rod::Rod rod = horizontal(100, support::section(0.01, 1.0, 10.0));
  const RelaxationReport report = StaticEquilibrium(hurried).relax(rod, support::unitGravity());
  EXPECT_EQ(report.reason, RelaxationReason::too_many_iterations);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_NE(describe(report).find("too_many_iterations"), std::string::npos);
}

TEST(LoadSteps, ReachWhatAtOnceTakesTooManyIterations) {
  // The tilted column of model.md 12.5 needs 25 iterations at four times Greenhill's load.
  rod::Rod rod = rod::straightRod({Vector3::Zero(), rod::exp({0.0, 1e-3, 0.0})}, 1.0, 100,
                                  support::inextensibleSection(1.0, 4.0 * 7.837347439));
  RelaxationSettings hurried;
  hurried.max_iterations = 12;
  StaticEquilibrium equilibrium(hurried);
  rod::Rod at_once = rod;
  EXPECT_EQ(equilibrium.relax(at_once, support::unitGravity()).reason, RelaxationReason::too_many_iterations);
  const RelaxationReport report = equilibrium.relaxInLoadSteps(rod, support::unitGravity());
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_GT(report.load_steps, 1);
  EXPECT_NE(describe(report).find("load steps"), std::string::npos);
  ASSERT_TRUE(StaticEquilibrium().relax(at_once, support::unitGravity()).ok());
  EXPECT_LT((rod.vertices.back().position - at_once.vertices.back().position).norm(), 1e-7);
}

TEST(LoadSteps, GiveUpAndLeaveTheRodAlone) {
  rod::Rod rod = horizontal(50, support::section(0.01, 1.0, 10.0));
  const rod::Rod before = rod;
  RelaxationSettings hopeless;
  hopeless.max_iterations = 1;
  const RelaxationReport report = StaticEquilibrium(hopeless).relaxInLoadSteps(rod, support::unitGravity());
  EXPECT_EQ(report.reason, RelaxationReason::too_many_iterations);
  EXPECT_EQ(rod.vertices.back().position, before.vertices.back().position);
}

}  // namespace
}  // namespace sensory_growth::mechanics
