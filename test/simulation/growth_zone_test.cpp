// Kinematics of a growth zone through the public step: how long it and its tissue become, and the step limit by the
// way of the tip (C5).

#include <cmath>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::grown;
using support::kinematicScenario;
using support::onlyRod;
using support::order;
using support::takeSteps;
using support::tip;

/// A zone of 6 cm that grows by 1 / (20 h), from 1 mm.
TEST(GrowthZone, GrowsExponentiallyThenLinearlyThroughManyDivisions) {
  const double hour = 3600.0;
  const double zone = 0.06, tau = 20.0 * hour;
  Scenario scenario = kinematicScenario(0.02 * hour, 1);
  OrganScenario& organ = scenario.organs.front();
  organ.length = 1e-3;
  organ.longest_element = 1e-3;
  organ.profile = growth::ApicalFlatProfile{1.0 / tau, zone};
  Simulation simulation(scenario);
  takeSteps(simulation, std::lround(40.0 * hour / scenario.stepping.step));
  EXPECT_NEAR(onlyRod(simulation).restLength() / (1e-3 * std::exp(2.0)), 1.0, 1e-12);
  takeSteps(simulation, std::lround(80.0 * hour / scenario.stepping.step));
  const double full_at = tau * std::log(60.0);
  const double length = zone + zone / tau * (120.0 * hour - full_at);
  EXPECT_NEAR(onlyRod(simulation).restLength() / length, 1.0, 1e-6);
  EXPECT_GT(onlyRod(simulation).size(), 64u);  // more than six generations

  const double before = onlyRod(simulation).restLength();
  takeSteps(simulation, std::lround(10.0 * hour / scenario.stepping.step));
  EXPECT_NEAR((onlyRod(simulation).restLength() - before) / 10.0, 3e-3, 3e-9);  // 3.0 mm/h
}

TEST(GrowthZone, StretchesTissueUntilItLeaves) {
  // Zone of length 1 at rate 1. Tissue at distance d from the apex leaves after ln(1 / d), stretched by 1 / d; elements
  // that were [a, b] from the apex have by then the mean stretch ln(b / a) / (b - a).
  Scenario scenario = kinematicScenario(1e-3, 50);
  OrganScenario& organ = scenario.organs.front();
  organ.profile = growth::ApicalFlatProfile{1.0, 1.0};
  Simulation simulation(scenario);
  const double d = 0.4;  // at vertex 30
  const auto distance = [&] {
    const rod::Rod& rod = onlyRod(simulation);
    double sum = 0.0;
    for (std::size_t e = 30; e < rod.size(); ++e) sum += rod.elements[e].rest_length;
    return sum;
  };
  takeSteps(simulation, 900);
  EXPECT_NEAR(distance(), d * std::exp(0.9), 1e-6);
  takeSteps(simulation, 16);  // ln(1 / 0.4) = 0.91629
  EXPECT_NEAR(distance(), d * std::exp(0.916), 1e-6);
  EXPECT_LT(distance(), 1.0);
  takeSteps(simulation, 1);
  EXPECT_GT(distance(), 1.0);

  takeSteps(simulation, 600);
  for (std::size_t e = 0; e < 30; ++e) {
    const double a = 1.0 - 0.02 * static_cast<double>(e + 1);
    const double b = a + 0.02;
    const rod::Element& element = onlyRod(simulation).elements[e];
    EXPECT_NEAR(element.rest_length / element.reference_length, std::log(b / a) / (b - a), 1e-5) << e;
  }
}

/// Tip of an organ that bends towards a light, its parts limited by the way of the tip alone.
Vector3 tipWithLimit(double tip_advance) {
  Scenario scenario = kinematicScenario(1.0, 50);
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sky", Vector3::UnitZ(), 1.0}}};
  scenario.stepping.limits.tip_advance = tip_advance;
  scenario.stepping.limits.smallest_part = 1e-4;
  OrganScenario& organ = scenario.organs.front();
  organ.profile = growth::LogisticProfile{1.0, 0.6, 15.0};
  organ.longest_element = 0.1;  // no element grows that long
  organ.senses.light_direction = 0.05;
  organ.bending.proprioception.intrinsic_length = 0.01;
  return tip(grown(scenario, 1));
}

TEST(TipAdvanceLimit, GivesTheSameShapeToSecondOrderWhenHalved) {
  const Vector3 tips[] = {tipWithLimit(0.4), tipWithLimit(0.2), tipWithLimit(0.1), tipWithLimit(0.05)};
  EXPECT_LT((tips[0] - tips[1]).norm(), 1e-3);
  EXPECT_NEAR(order((tips[0] - tips[1]).norm(), (tips[1] - tips[2]).norm()), 2.0, 0.15);
  EXPECT_NEAR(order((tips[1] - tips[2]).norm(), (tips[2] - tips[3]).norm()), 2.0, 0.1);
}

}  // namespace
}  // namespace sensory_growth::simulation
