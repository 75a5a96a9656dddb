// Columns that outgrow what they can bear (V23), and organs that have buckled.

#include <cmath>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;
using support::takeSteps;

TEST(GrowingColumn, LosesItsStabilityAtGreenhillsLength) {
  // B = w = 1, from length 0.5: 0.5 exp(t) = 7.837347439^(1/3) at 1.379447. The lowest eigenvalue crosses zero there.
  Scenario scenario = kinematicScenario(0.0025, 100);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::Quaternion::Identity();
  organ.length = 0.5;
  organ.section = support::inextensibleSection(1.0, 1.0);
  Simulation simulation(scenario);
  takeSteps(simulation, 549);
  const double before = *simulation.organs().front().lowestEigenvalue();
  takeSteps(simulation, 2);
  const double now = *simulation.organs().front().lowestEigenvalue();
  EXPECT_GT(now, 0.0);
  EXPECT_NEAR(simulation.time() + 0.005 * now / (before - now), 1.379447, 1e-4);
}

TEST(BuckledOrgan, ThatSwingsAboutTheVerticalDoesNotFail) {
  // Buckled under its weight, it grows against its sag and so prefers the other side ever again (docs/model.md 12.4).
  Scenario scenario = kinematicScenario(0.05, 30);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::Quaternion::Identity();
  organ.length = 1.0;
  organ.section = support::section(0.02, 1.0, 1.0);
  organ.profile = growth::ApicalFlatProfile{1.0, 0.6};
  organ.senses.gravity = 0.4 * 0.02;
  organ.bending.proprioception.intrinsic_length = 0.4 * 0.02;
  organ.longest_element = 0.1;
  Simulation simulation(scenario);
  for (int i = 0; i < 120; ++i) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
  EXPECT_LT(simulation.organs().front().rod().vertices.back().position.z(), 0.0);  // it hangs
}

TEST(GrowingColumn, BucklesUnderItsWeightAndSaysSo) {
  // Greenhill: B = w = 1 buckles at L = 7.8373^(1/3) = 1.98635; growing from 0.5 that is at time 1.379447 (V23).
  Scenario scenario = kinematicScenario(0.02, 100);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::Quaternion::Identity();
  organ.length = 0.5;
  organ.section = support::inextensibleSection(1.0, 1.0);
  Simulation simulation(scenario);
  double buckled_at = 0.0;
  int branch_switches = 0;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(simulation.step().ok);
    branch_switches += simulation.organs().front().report().branch_switches;
    if (buckled_at == 0.0 && branch_switches > 0) buckled_at = simulation.time();
    const Vector3 tip = simulation.organs().front().rod().vertices.back().position;
    if (buckled_at == 0.0) {
      EXPECT_LT(std::hypot(tip.x(), tip.y()), 1e-6);
    }
  }
  EXPECT_EQ(branch_switches, 1);
  EXPECT_GT(buckled_at, 1.379447);
  EXPECT_LT(buckled_at, 1.379447 + 0.02);
  const rod::Rod& rod = simulation.organs().front().rod();
  const Vector3 tip = rod.vertices.back().position / rod.restLength();
  EXPECT_NEAR(std::hypot(tip.x(), tip.y()), 0.373844, 5e-4);
  EXPECT_NEAR(tip.z(), -0.674885, 5e-4);
}

}  // namespace
}  // namespace sensory_growth::simulation
