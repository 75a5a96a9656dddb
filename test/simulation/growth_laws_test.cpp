// Growth and bending through the public step: V13, V14, V18b of model.md 18, the signs of 4.3 and orders of
// convergence.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::grown;
using support::kinematicScenario;
using support::kUnlimited;
using support::order;
using support::tip;
using support::tipAngle;

// --- V13: gravitropism and proprioception at fixed length
// -------------------------------------------------------------

rod::Rod steadyShoot(std::size_t elements) {
  Scenario scenario = kinematicScenario(0.2, elements);
  OrganScenario& organ = scenario.organs.front();
  organ.elongation = false;
  organ.senses.gravity = 0.3;
  organ.bending.proprioception.intrinsic_length = 0.06;
  return grown(scenario, 250);
}

const Vector3 kSteadyTip(0.311464127, 0.0, 0.861379644);

TEST(GraviProprioceptiveShoot, SettlesInTheUniversalShape) {
  const rod::Rod rod = steadyShoot(100);
  EXPECT_LT((tip(rod) - kSteadyTip).norm(), 1e-4);
  const double convergence_length = 0.06 / 0.3;
  for (std::size_t v = 0; v < rod.vertices.size(); ++v) {
    const double u = static_cast<double>(v) / static_cast<double>(rod.size()) / convergence_length;
    const Vector3 expected(2.0 * std::atan(std::tanh(0.5 * u)), 0.0, std::log(std::cosh(u)));
    EXPECT_LT((rod.vertices[v].position - convergence_length * expected).norm(), 1e-4) << "vertex " << v;
  }
  EXPECT_NEAR(tipAngle(rod), 2.0 * std::atan(std::exp(-1.0 / convergence_length)), 1e-4);
}

TEST(GraviProprioceptiveShoot, DecaysExponentiallyFromASmallTilt) {
  Scenario scenario = kinematicScenario(0.2, 200);
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::exp({0.0, 0.01, 0.0});
  organ.elongation = false;
  organ.senses.gravity = 0.05;
  organ.bending.proprioception.intrinsic_length = 0.05;
  EXPECT_NEAR(tipAngle(grown(scenario, 250)) / 0.01, std::exp(-1.0), 1e-4);
}

TEST(GraviProprioceptiveShoot, IsSecondOrderInSpace) {
  const auto error = [](std::size_t n) { return (tip(steadyShoot(n)) - kSteadyTip).norm(); };
  EXPECT_NEAR(error(50), 2.4e-4, 0.2e-4);  // model.md 1.2
  EXPECT_NEAR(order(error(50), error(100)), 2.0, 0.02);
  EXPECT_NEAR(order(error(100), error(200)), 2.0, 0.02);
}

// --- V14: gravitropism alone oscillates
// -------------------------------------------------------------------------------

double oscillationError(int steps, bool second_order) {
  Scenario scenario = kinematicScenario(3.0 / steps, 200);
  scenario.stepping.second_order = second_order;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::exp({0.0, 0.01, 0.0});
  organ.elongation = false;
  organ.senses.gravity = 0.1;
  return std::abs(tipAngle(grown(scenario, steps)) / 0.01 - -0.210059);
}

TEST(GravitropismAlone, FollowsTheBesselFunction) { EXPECT_LT(oscillationError(120, true), 1e-3); }

TEST(GravitropismAlone, IsSecondOrderInTimeUnlessToldOtherwise) {
  EXPECT_NEAR(order(oscillationError(15, true), oscillationError(30, true)), 2.0, 0.25);
  EXPECT_NEAR(order(oscillationError(30, true), oscillationError(60, true)), 2.0, 0.25);
  EXPECT_NEAR(order(oscillationError(30, false), oscillationError(60, false)), 1.0, 0.1);
}

// --- V18b: phototropism with apical growth and division
// ---------------------------------------------------------------

rod::Rod apicalPhototropism(double step, double longest) {
  Scenario scenario = kinematicScenario(step);
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sky", Vector3::UnitZ(), 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  organ.section.radius = 0.1;
  organ.elements = static_cast<std::size_t>(std::lround(1.0 / longest));
  organ.longest_element = longest * (1.0 + 1e-9);
  organ.profile = growth::ApicalFlatProfile{1.0, 1.0};
  organ.senses.light_direction = 0.05;
  organ.bending.proprioception.intrinsic_length = 0.01;
  return grown(scenario, std::lround(1.0 / step));
}

TEST(ApicalPhototropism, ReachesTheReferenceTip) {
  const rod::Rod rod = apicalPhototropism(0.01, 0.01);
  EXPECT_NEAR(tip(rod).x(), 1.877188, 2e-5);
  EXPECT_NEAR(tip(rod).z(), 0.531217, 2e-5);
  EXPECT_NEAR(M_PI_2 - tipAngle(rod), 0.697962, 2e-5);
  EXPECT_NEAR(rod.restLength(), 2.0, 1e-6);
  EXPECT_GT(rod.size(), 190u);
}

TEST(ApicalPhototropism, IsSecondOrderWhenStepAndElementsShrinkTogether) {
  const auto error = [](double h) { return (tip(apicalPhototropism(h, h)) - Vector3(1.877188, 0.0, 0.531217)).norm(); };
  EXPECT_NEAR(order(error(0.1), error(0.05)), 2.0, 0.3);
  EXPECT_NEAR(order(error(0.05), error(0.025)), 2.0, 0.3);
}

// --- Signs and invariance
// ---------------------------------------------------------------------------------------------

class RolledOrgan : public testing::TestWithParam<double> {
 protected:
  Scenario scenario() const {
    Scenario s = kinematicScenario(0.01);
    s.organs.front().base.frame = support::rolled(support::alongX(), GetParam());
    return s;
  }
};

TEST_P(RolledOrgan, ShootsLiftTheirTip) {
  Scenario s = scenario();
  s.organs.front().senses.gravity = 0.2;
  EXPECT_NEAR(tip(grown(s, 10)).z(), 0.239, 5e-4);  // model.md 4.3
}

TEST_P(RolledOrgan, LampsDrawTheTipTowardsThem) {
  Scenario s = scenario();
  s.organs.front().senses.point_source = 0.2;
  s.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.5, 3.0, 4.0}, 1.0}}};
  const Vector3 end = tip(grown(s, 10));
  EXPECT_GT(end.y(), 0.05);
  EXPECT_GT(end.z(), 0.05);
}

TEST_P(RolledOrgan, CentrelineDoesNotDependOnRoll) {
  const auto centreline = [](const rod::Quaternion& frame) {
    Scenario s = kinematicScenario(0.05, 40);
    s.relaxation = RelaxationMethod::statics;
    s.relaxation_settings.tolerance = 1e-13;
    s.weight = true;
    s.gravity = -Vector3::UnitZ();
    OrganScenario& organ = s.organs.front();
    organ.base.frame = frame;
    organ.section = support::section(0.05, 1.0, 2.0);
    organ.senses = {0.1, 0.2, 0.1, 0.01};
    organ.bending.proprioception.intrinsic_length = 0.02;
    s.protocol = {
        {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 1.0, 0.3}, 1.0}},
        {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0.2, -1.0, 0.5}, 1.0}}};
    return grown(s, 10);
  };
  const rod::Rod reference = centreline(support::alongX());
  const rod::Rod rolled = centreline(support::rolled(support::alongX(), GetParam()));
  for (std::size_t v = 0; v < reference.vertices.size(); ++v) {
    EXPECT_LT((rolled.vertices[v].position - reference.vertices[v].position).norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Rolls, RolledOrgan, testing::Values(0.0, 0.6, M_PI_2, -2.5));

TEST(ElasticOrgan, TurnsRigidlyWithBaseGravityAndCues) {
  const auto run = [](const rod::Quaternion& turn) {
    Scenario s = kinematicScenario(0.05, 40);
    s.relaxation = RelaxationMethod::statics;
    s.relaxation_settings.tolerance = 1e-13;
    s.weight = true;
    s.gravity = turn * Vector3(0.1, 0.2, -1.0);
    OrganScenario& organ = s.organs.front();
    organ.base = {turn * Vector3(0.3, 0.1, -0.2), turn * support::alongX()};
    organ.section = support::section(0.05, 1.0, 2.0);
    organ.loads.tip_force = turn * Vector3(0.1, -0.2, 0.1);
    organ.rest_curvature = {0.2, -0.1, 0.6};
    organ.senses = {0.1, 0.2, 0.1, 0.01};
    organ.bending.proprioception.intrinsic_length = 0.02;
    s.protocol = {{0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp",
                                        turn * Vector3(1.0, 1.0, 0.3), 1.0}},
                  {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun",
                                        turn * Vector3(0.2, -1.0, 0.5), 1.0}}};
    return grown(s, 10);
  };
  const rod::Quaternion turn = rod::exp({0.7, -1.1, 0.4});
  const rod::Rod reference = run(rod::Quaternion::Identity());
  const rod::Rod turned = run(turn);
  for (std::size_t v = 0; v < reference.vertices.size(); ++v) {
    EXPECT_LT((turned.vertices[v].position - turn * reference.vertices[v].position).norm(), 1e-11);
  }
}

TEST(NoCuesNoWeight, UniformGrowthLeavesRestCurvatureBitForBit) {
  Scenario scenario = kinematicScenario(0.05, 30);
  scenario.organs.front().rest_curvature = {0.3, -0.7, 0.4};
  const rod::Rod rod = grown(scenario, 20);
  for (std::size_t j = 0; j < rod.size(); ++j) {
    EXPECT_EQ(rod.bends[j].rest_curvature.x(), 0.3);
    EXPECT_EQ(rod.bends[j].rest_curvature.y(), -0.7);
    EXPECT_NEAR(rod.bends[j].rest_curvature.z() * rod.restLength(), 0.4, 1e-14);
  }
}

TEST(Proprioception, DecaysExactlyForAnyStep) {
  // gamma / R = 3 per unit strain; an explicit scheme would be unstable for steps above 2 / 3.
  Scenario scenario = kinematicScenario(1.0, 30);
  OrganScenario& organ = scenario.organs.front();
  organ.elongation = false;
  organ.rest_curvature = {0.3, -0.7, 0.4};
  organ.bending.proprioception.intrinsic_length = 0.15;
  const rod::Rod rod = grown(scenario, 2);
  for (const rod::Bend& bend : rod.bends) {
    EXPECT_NEAR(bend.rest_curvature.x(), 0.3 * std::exp(-6.0), 1e-15);
    EXPECT_NEAR(bend.rest_curvature.y(), -0.7 * std::exp(-6.0), 1e-15);
    EXPECT_EQ(bend.rest_curvature.z(), 0.4);
  }
}

// --- Elasticity, weight and growth together
// ---------------------------------------------------------------------------

/// A weighted organ, twisted by a couple at its tip, that grows by exp(0.8) while it rights itself towards a lamp.
Vector3 elasticTip(int steps) {
  Scenario scenario = kinematicScenario(0.8 / steps, 40);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-12;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 2.0, 1.0}, 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, 1.0, 1.5);
  organ.loads.tip_couple = {0.0, 0.1, 0.4};
  organ.senses = {0.15, 0.0, 0.05, 0.01};
  organ.bending.proprioception.intrinsic_length = 0.03;
  return tip(grown(scenario, steps));
}

TEST(ElasticOrgan, IsSecondOrderInTime) {
  const Vector3 tips[] = {elasticTip(40), elasticTip(80), elasticTip(160), elasticTip(320)};
  EXPECT_NEAR(order((tips[0] - tips[1]).norm(), (tips[1] - tips[2]).norm()), 2.0, 0.1);
  EXPECT_NEAR(order((tips[1] - tips[2]).norm(), (tips[2] - tips[3]).norm()), 2.0, 0.1);
}

TEST(ElasticOrgan, WarmStartNeedsAboutTwoIterations) {
  Scenario scenario = kinematicScenario(0.02, 45);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.02, 1.0, 0.1);
  organ.senses.gravity = 0.1;
  organ.bending.proprioception.intrinsic_length = 0.02;
  organ.longest_element = 1.5 / 45;
  Simulation simulation(scenario);
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(simulation.step().ok);
    const OrganReport& report = simulation.organs().front().report();
    EXPECT_LE(report.relaxation.iterations, 2);  // model.md 12.5: mean 1.9, at most 2
    EXPECT_LE(report.iterations, report.divisions > 0 ? 5 : 4);
  }
  EXPECT_GT(simulation.organs().front().rod().size(), 45u);
}

}  // namespace
}  // namespace sensory_growth::simulation
