// Aging through the public step: deposition that moves nothing (V24), the clock of a growth zone, orders in time.

#include <algorithm>
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

/// A horizontal organ that hangs under its weight (beta = 3) and ages by plain time without growing.
Scenario agingScenario(double step, bool stiffens, bool thickens) {
  Scenario scenario = kinematicScenario(step, 50);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-12;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, 1.0, 3.0);
  organ.profile = growth::UniformProfile{0.0};
  organ.aging = growth::Aging{};
  organ.aging->clock = growth::AgingClock::time;
  if (stiffens) organ.aging->young_modulus = growth::Maturation{10.0 * organ.section.young_modulus, 0.5};
  if (thickens) organ.aging->radius = growth::Maturation{0.08, 0.7};
  return scenario;
}

TEST(AgingOrgan, StiffensWithoutMoving) {
  const Scenario scenario = agingScenario(0.2, true, false);
  Simulation simulation(scenario);
  const rod::Rod before = onlyRod(simulation);
  takeSteps(simulation, 10);  // V24
  for (std::size_t v = 0; v <= before.size(); ++v) {
    EXPECT_LT((onlyRod(simulation).vertices[v].position - before.vertices[v].position).norm(), 1e-11) << v;
  }
  const double stiffer = 10.0 - 9.0 * std::exp(-2.0 / 0.5);
  EXPECT_NEAR(onlyRod(simulation).elements[7].section.young_modulus / scenario.organs[0].section.young_modulus, stiffer,
              1e-12);
  EXPECT_NEAR(onlyRod(simulation).elements[7].age, 2.0, 1e-12);
}

TEST(AgingOrgan, SinksUnderTheWeightItAdds) {
  const Scenario scenario = agingScenario(0.05, false, true);
  Simulation simulation(scenario);
  const double height = tip(onlyRod(simulation)).z();
  takeSteps(simulation, 60);
  const rod::Rod& rod = onlyRod(simulation);
  const double radius = 0.08 - 0.03 * std::exp(-3.0 / 0.7);
  EXPECT_NEAR(rod.elements[3].section.radius, radius, 1e-14);
  EXPECT_NEAR(rod.vertexMass(10), 3.0 / 50.0 * std::pow(radius / 0.05, 2.0), 1e-12);
  EXPECT_LT(tip(rod).z(), height - 0.02);

  // New tissue carries new weight alone: an organ that had been thick from the start hangs less.
  Scenario thick = scenario;
  thick.organs.front().section.radius = radius;
  EXPECT_GT(tip(onlyRod(Simulation(thick))).z(), height);
}

/// Tip of an organ that grows, rights itself and ages, with stress coupling or without.
Vector3 agingTip(int steps, bool coupled, const growth::Proprioception& proprioception, double torque) {
  Scenario scenario = agingScenario(0.8 / steps, true, true);
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, 1.0, 1.5);
  organ.profile = growth::UniformProfile{1.0};
  organ.senses.gravity = 0.15;
  organ.bending.proprioception = proprioception;
  organ.aging->young_modulus->mature = 3.0 * organ.section.young_modulus;
  organ.loads.tip_couple.z() = torque;
  if (coupled) {
    // Leaning, so that all of it is pressed and neither the factor nor the clock comes to the bounds where they have
    // kinks.
    organ.base.frame = rod::exp({0.0, 0.4, 0.0});
    organ.section = support::section(0.05, 1.0, 0.5);
    organ.aging->clock = growth::AgingClock::maturation;
    organ.stress_coupling = growth::StressCoupling{};
    organ.stress_coupling->yield_margin = 400.0;
  }
  return tip(grown(scenario, steps));
}

void expectSecondOrder(bool coupled, const growth::Proprioception& proprioception, double torque = 0.0) {
  const auto tipAfter = [&](int steps) { return agingTip(steps, coupled, proprioception, torque); };
  const Vector3 tips[] = {tipAfter(40), tipAfter(80), tipAfter(160), tipAfter(320)};
  EXPECT_NEAR(order((tips[0] - tips[1]).norm(), (tips[1] - tips[2]).norm()), 2.0, 0.1);
  EXPECT_NEAR(order((tips[1] - tips[2]).norm(), (tips[2] - tips[3]).norm()), 2.0, 0.1);
}

TEST(AgingOrgan, IsSecondOrderInTimeUnderAnyGrowthLaw) {
  expectSecondOrder(false, {});
  expectSecondOrder(false, {0.03, 0.0, 0.0, Eigen::Vector2d::Zero()});
  expectSecondOrder(false, {0.0, 0.03, 0.0, Eigen::Vector2d::Zero()});
  expectSecondOrder(false, {0.02, 0.0, 0.03, Eigen::Vector2d::Zero()});
}

TEST(AgingOrgan, IsSecondOrderInTimeWithStressCoupling) {
  expectSecondOrder(true, {});
  expectSecondOrder(true, {0.02, 0.01, 0.03, Eigen::Vector2d::Zero()});
}

TEST(AgingOrgan, IsSecondOrderInTimeWhereTwistIsDepositedAndDiluted) {
  expectSecondOrder(false, {0.03, 0.0, 0.0, Eigen::Vector2d::Zero()}, 0.4);
  expectSecondOrder(true, {0.02, 0.01, 0.03, Eigen::Vector2d::Zero()}, 0.4);
}

TEST(AgingOrgan, AgesBehindItsGrowthZone) {
  // Flat zone of length 1 at rate 1: tissue at distance d from the apex left it (d - 1) ago and has aged since then.
  Scenario scenario = kinematicScenario(0.01, 200);
  OrganScenario& organ = scenario.organs.front();
  organ.length = 2.0;
  organ.longest_element = 0.01 * (1.0 + 1e-9);
  organ.profile = growth::ApicalFlatProfile{1.0, 1.0};
  organ.aging = growth::Aging{};
  organ.aging->radius = growth::Maturation{0.2, 1.0};
  const rod::Rod rod = grown(scenario, 150);
  double s = 0.0;
  for (const rod::Element& element : rod.elements) {
    const double from_apex = rod.restLength() - (s += element.rest_length) + 0.5 * element.rest_length;
    EXPECT_NEAR(element.age, std::clamp(from_apex - 1.0, 0.0, 1.5), 0.012) << from_apex;
  }
  EXPECT_NEAR(rod.elements.back().age, 0.0, 1e-12);
  EXPECT_NEAR(rod.elements.back().section.radius, 0.05, 1e-12);
}

/// Distance of the tips of a static organ and one that moves in time, which take the same steps.
double lag(RelaxationMethod method, double step) {
  Scenario scenario = agingScenario(step, true, true);
  scenario.organs.front().elements = 20;
  scenario.organs.front().section = support::section(0.05, 1.0, 1.0);
  scenario.growth_per_second = 0.02;
  const Vector3 still = tip(grown(scenario, std::lround(1.0 / step)));
  scenario.relaxation = method;
  return (tip(grown(scenario, std::lround(1.0 / step))) - still).norm();
}

TEST(AgingOrgan, MovesWithTheStiffnessAndMassOfItsAge) {
  EXPECT_LT(lag(RelaxationMethod::dynamics, 0.1), 1e-6);
  EXPECT_LT(lag(RelaxationMethod::continuous, 0.05), 1e-3);
  EXPECT_LT(lag(RelaxationMethod::continuous, 0.025), 0.5 * lag(RelaxationMethod::continuous, 0.05));
}

}  // namespace
}  // namespace sensory_growth::simulation
