// Stress coupling through the public step: growth under a force (V21), against a spring (V22), a wall and between two
// clamps (C11).

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::grown;
using support::kinematicScenario;
using support::kUnlimited;
using support::onlyRod;
using support::order;
using support::takeSteps;

/// A straight organ along +x in equilibrium, of axial stiffness E A, whose growth stops under a force of one.
Scenario lockhartScenario(double step, double axial_stiffness, std::size_t elements = 20) {
  Scenario scenario = kinematicScenario(step, elements);
  scenario.relaxation = RelaxationMethod::statics;
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, axial_stiffness * 0.05 * 0.05 / 4.0, 0.0);
  organ.stress_coupling = growth::StressCoupling{};
  organ.stress_coupling->yield_margin = 1.0 / organ.section.area();
  return scenario;
}

// --- V21: a force along the organ
// -------------------------------------------------------------------------------------

double lengthUnderForce(double force, double sign, bool second_order = true) {
  Scenario scenario = lockhartScenario(0.1, 1e5);
  scenario.stepping.second_order = second_order;
  scenario.organs.front().stress_coupling->sign = sign;
  scenario.organs.front().loads.tip_force = {force, 0.0, 0.0};
  return grown(scenario, 6).restLength();
}

TEST(ForcedOrgan, GrowsByLockhartsFactor) {
  for (const double force : {-1.5, -1.0, -0.4, 0.0, 0.5, 1.5}) {
    const double expected = std::exp(0.6 * std::max(0.0, 1.0 + force));
    EXPECT_NEAR(lengthUnderForce(force, 1.0), expected, 1e-10 * expected) << force;
    EXPECT_NEAR(lengthUnderForce(force, 1.0, false), expected, 1e-10 * expected) << force;
    EXPECT_NEAR(lengthUnderForce(-force, -1.0), expected, 1e-10 * expected) << force;
  }
}

TEST(ForcedOrgan, GrowsByNoMoreThanTheLargestFactor) {
  Scenario scenario = lockhartScenario(0.1, 1e5);
  scenario.organs.front().stress_coupling->largest_factor = 1.2;
  scenario.organs.front().loads.tip_force = {3.0, 0.0, 0.0};
  EXPECT_NEAR(grown(scenario, 6).restLength(), std::exp(0.72), 1e-10);
}

TEST(ForcedOrgan, BendsLessWhereItGrowsLess) {
  // V18 without elongation: turning is (delta / R) times the growth strain.
  Scenario scenario = lockhartScenario(0.05, 1e6);
  OrganScenario& organ = scenario.organs.front();
  organ.elongation = false;
  organ.loads.tip_force = {-0.6, 0.0, 0.0};
  organ.senses.light_direction = 1e-6;
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sky", Vector3::UnitZ(), 1.0}}};
  const rod::Rod rod = grown(scenario, 10);
  EXPECT_DOUBLE_EQ(rod.restLength(), 1.0);
  EXPECT_NEAR(rod.bends[10].rest_curvature.y(), 0.4 * 0.5 * 1e-6 / 0.05, 1e-11);
}

// --- V22: a spring wall, and C11: the plateau of the force
// ------------------------------------------------------------

/// A spring pulls the apex back to where it was, as a soft wall does that it grows against.
rod::Rod againstSpring(double step, double time, bool second_order = true) {
  Scenario scenario = lockhartScenario(step, 1e8);
  scenario.stepping.second_order = second_order;
  scenario.organs.front().loads.surroundings.springs = {{1.0, {1.0, 0.0, 0.0}, 2.0}};
  return grown(scenario, std::lround(time / step));
}

double springError(double step, bool second_order) {
  const double exact = 1.5 / (1.0 + 0.5 * std::exp(-3.0));
  return againstSpring(step, 1.0, second_order).restLength() - exact;
}

TEST(OrganAgainstASpring, GrowsAsTheLogisticEquation) {
  EXPECT_NEAR(againstSpring(0.01, 1.0).restLength(), 1.463566, 2e-5);
  EXPECT_NEAR(againstSpring(0.1, 8.0).restLength(), 1.5, 1e-6);
}

TEST(OrganAgainstASpring, IsSecondOrderInTimeUnlessToldOtherwise) {
  EXPECT_NEAR(order(springError(0.05, true), springError(0.025, true)), 2.0, 0.15);
  EXPECT_NEAR(order(springError(0.025, true), springError(0.0125, true)), 2.0, 0.1);
  EXPECT_NEAR(order(springError(0.05, false), springError(0.025, false)), 1.0, 0.1);
}

/// An organ of unit length that a rigid wall stops. Its rest length obeys dL/dt = K - (K - 1) L, K = E A.
Scenario againstWall(double step) {
  Scenario scenario = lockhartScenario(step, 1600.0);
  scenario.organs.front().loads.surroundings.walls = {{{1.0, 0.0, 0.0}, -Vector3::UnitX(), kUnlimited}};
  return scenario;
}

/// What the organ presses on the wall with.
double push(const rod::Rod& rod) { return -1600.0 * rod.elements.back().strain.z(); }

double wallError(double step) {
  const double K = 1600.0;
  const double exact = K / (K - 1.0) - 1.0 / (K - 1.0) * std::exp(-(K - 1.0) * 2e-3);
  return grown(againstWall(step), std::lround(2e-3 / step)).restLength() - exact;
}

TEST(OrganAgainstAWall, ApproachesThePlateauOfItsForceAndStops) {
  Scenario scenario = againstWall(1e-3);
  scenario.stepping.limits.growth_stress = 0.5;
  Simulation simulation(scenario);
  double before = 0.0;
  for (int i = 0; i < 15; ++i) {
    takeSteps(simulation, 1);
    const double now = push(onlyRod(simulation));
    EXPECT_GT(now, before - 1e-9);
    EXPECT_LT(now, 1.0 + 1e-6);  // C11: A sigma_max, from below
    before = now;
  }
  EXPECT_NEAR(before, 1.0, 1e-6);
  for (const double rate : simulation.organs().front().growthRates()) EXPECT_LT(rate, 1e-6);
  const double length = onlyRod(simulation).restLength();
  takeSteps(simulation, 5);
  EXPECT_NEAR(onlyRod(simulation).restLength(), length, 1e-9);
}

TEST(OrganAgainstAWall, IsSecondOrderInTime) {
  EXPECT_NEAR(order(wallError(1e-4), wallError(5e-5)), 2.0, 0.15);
  EXPECT_NEAR(order(wallError(5e-5), wallError(2.5e-5)), 2.0, 0.1);
}

TEST(OrganAgainstAWall, TakesStepsThatStressCannotOutrun) {
  Scenario scenario = againstWall(1e-3);
  scenario.stepping.limits.growth_stress = 0.5;
  Simulation simulation(scenario);
  takeSteps(simulation, 1);
  EXPECT_GT(simulation.organs().front().report().substeps, 1);
  scenario.organs.front().stress_coupling.reset();
  Simulation uncoupled(scenario);
  takeSteps(uncoupled, 1);
  EXPECT_EQ(uncoupled.organs().front().report().substeps, 1);
}

// --- C11: a column clamped between two walls
// --------------------------------------------------------------------------

/// Radius 0.02, so that it buckles at a growth stretch of 1 + 4 pi^2 I / (A L^2) = 1 + pi^2 R^2.
Scenario clampedColumn() {
  Scenario scenario = kinematicScenario(1e-4, 60);
  scenario.relaxation = RelaxationMethod::statics;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::Quaternion::Identity();
  organ.section = support::section(0.02, 1.0, 0.0);
  organ.loads.surroundings.held_apex = mechanics::HeldApex{{0.0, 0.0, 1.0}, rod::Quaternion::Identity()};
  return scenario;
}

double bulge(const rod::Rod& rod) { return rod.vertices[rod.size() / 2].position.head<2>().norm(); }

TEST(ColumnBetweenWalls, BucklesAtTheGrowthStretchOfEuler) {
  Simulation simulation(clampedColumn());
  double stretch = 1.0;
  while (bulge(onlyRod(simulation)) < 1e-3 && stretch < 1.01) {
    takeSteps(simulation, 1);
    stretch = onlyRod(simulation).restLength();
  }
  const double expected = M_PI * M_PI * 0.02 * 0.02;
  EXPECT_NEAR(stretch - 1.0, expected, 0.03 * expected);
}

TEST(ColumnBetweenWalls, StopsBeforeItBucklesWhereTissueYieldsToLess) {
  Scenario scenario = clampedColumn();
  OrganScenario& organ = scenario.organs.front();
  organ.stress_coupling = growth::StressCoupling{};
  organ.stress_coupling->yield_margin = 0.8 * M_PI * M_PI * 0.02 * 0.02 * organ.section.young_modulus;
  scenario.stepping.step = 1e-3;
  scenario.stepping.limits.growth_stress = 0.5;
  const rod::Rod rod = grown(scenario, 40);
  EXPECT_LT(bulge(rod), 1e-9);
  EXPECT_NEAR(1.0 - 1.0 / rod.restLength(), 0.8 * M_PI * M_PI * 0.02 * 0.02, 1e-6);
}

}  // namespace
}  // namespace sensory_growth::simulation
