// What tissue does to growth and growth to tissue, through the public step: stress coupling (V21, V22, C11), aging
// (V24), kinematics of growth (C5) and the orders of convergence.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;
using support::kUnlimited;
using support::order;

const rod::Rod& onlyRod(const Simulation& simulation) { return simulation.organs().front().rod(); }

void take(Simulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

rod::Rod grown(const Scenario& scenario, long steps) {
  Simulation simulation(scenario);
  take(simulation, steps);
  return onlyRod(simulation);
}

Vector3 tip(const rod::Rod& rod) { return rod.vertices.back().position; }

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
    take(simulation, 1);
    const double now = push(onlyRod(simulation));
    EXPECT_GT(now, before - 1e-9);
    EXPECT_LT(now, 1.0 + 1e-6);  // C11: A sigma_max, from below
    before = now;
  }
  EXPECT_NEAR(before, 1.0, 1e-6);
  for (const double rate : simulation.organs().front().growthRates()) EXPECT_LT(rate, 1e-6);
  const double length = onlyRod(simulation).restLength();
  take(simulation, 5);
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
  take(simulation, 1);
  EXPECT_GT(simulation.organs().front().report().substeps, 1);
  scenario.organs.front().stress_coupling.reset();
  Simulation uncoupled(scenario);
  take(uncoupled, 1);
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
    take(simulation, 1);
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

// --- V23: a column that outgrows Greenhill's length
// -------------------------------------------------------------------

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
  take(simulation, 549);
  const double before = *simulation.organs().front().lowestEigenvalue();
  take(simulation, 2);
  const double now = *simulation.organs().front().lowestEigenvalue();
  EXPECT_GT(now, 0.0);
  EXPECT_NEAR(simulation.time() + 0.005 * now / (before - now), 1.379447, 1e-4);
}

// --- Aging
// ------------------------------------------------------------------------------------------------------------

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
  take(simulation, 10);  // V24
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
  take(simulation, 60);
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
Vector3 agingTip(int steps, bool coupled, const growth::Proprioception& proprioception) {
  Scenario scenario = agingScenario(0.8 / steps, true, true);
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, 1.0, 1.5);
  organ.profile = growth::UniformProfile{1.0};
  organ.senses.gravity = 0.15;
  organ.bending.proprioception = proprioception;
  organ.aging->young_modulus->mature = 3.0 * organ.section.young_modulus;
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

void expectSecondOrder(bool coupled, const growth::Proprioception& proprioception) {
  const auto tipAfter = [&](int steps) { return agingTip(steps, coupled, proprioception); };
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

// --- C5: kinematics of growth
// -----------------------------------------------------------------------------------------

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
  take(simulation, std::lround(40.0 * hour / scenario.stepping.step));
  EXPECT_NEAR(onlyRod(simulation).restLength() / (1e-3 * std::exp(2.0)), 1.0, 1e-12);
  take(simulation, std::lround(80.0 * hour / scenario.stepping.step));
  const double full_at = tau * std::log(60.0);
  const double length = zone + zone / tau * (120.0 * hour - full_at);
  EXPECT_NEAR(onlyRod(simulation).restLength() / length, 1.0, 1e-6);
  EXPECT_GT(onlyRod(simulation).size(), 64u);  // more than six generations

  const double before = onlyRod(simulation).restLength();
  take(simulation, std::lround(10.0 * hour / scenario.stepping.step));
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
  take(simulation, 900);
  EXPECT_NEAR(distance(), d * std::exp(0.9), 1e-6);
  take(simulation, 16);  // ln(1 / 0.4) = 0.91629
  EXPECT_NEAR(distance(), d * std::exp(0.916), 1e-6);
  EXPECT_LT(distance(), 1.0);
  take(simulation, 1);
  EXPECT_GT(distance(), 1.0);

  take(simulation, 600);
  for (std::size_t e = 0; e < 30; ++e) {
    const double a = 1.0 - 0.02 * static_cast<double>(e + 1);
    const double b = a + 0.02;
    const rod::Element& element = onlyRod(simulation).elements[e];
    EXPECT_NEAR(element.rest_length / element.reference_length, std::log(b / a) / (b - a), 1e-5) << e;
  }
}

/// V18: a cue that is fixed to the tissue bends what is in the zone; the bend is carried out of it and divided.
rod::Rod zoneWithMaterialCue(double step, double longest) {
  Scenario scenario = kinematicScenario(step);
  OrganScenario& organ = scenario.organs.front();
  organ.length = 2.0;
  organ.elements = static_cast<std::size_t>(std::lround(2.0 / longest));
  organ.longest_element = longest * (1.0 + 1e-9);
  organ.section.radius = 0.1;
  organ.profile = growth::ApicalFlatProfile{1.0, 1.0};
  organ.senses.oscillator.amplitude = 0.05;
  organ.senses.oscillator.period = 1e12;
  return grown(scenario, std::lround(3.0 / step));
}

TEST(GrowthZone, LeavesItsBendBehindAndDividesIt) {
  const rod::Rod rod = zoneWithMaterialCue(0.02, 0.05);
  EXPECT_NEAR(rod.restLength(), 5.0, 5e-4);
  EXPECT_GT(rod.size(), 100u);
  double turning = 0.5 * rod.elements.back().rest_length * rod.bends.back().rest_curvature.y();
  double s = 0.0;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double k2 = rod.bends[j].rest_curvature.y();
    turning += rod.voronoiLength(j) * k2;
    const double expected = 0.5 * std::clamp(4.0 - (rod.restLength() - s), 0.0, 3.0);
    EXPECT_NEAR(k2, expected, 0.02) << j;  // of the kinks, which elements round off
    s += rod.elements[j].rest_length;
  }
  EXPECT_NEAR(turning, 3.75, 5e-4);
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
