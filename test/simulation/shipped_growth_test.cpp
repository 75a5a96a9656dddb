// The shipped scenarios of circumnutation, distance and growth laws do what their descriptions say.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/growing.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::degrees;
using support::onlyRod;
using support::takeSteps;
using support::tip;
using support::tipAngle;
using support::tipDirection;

Scenario shipped(const std::string& name) { return loadScenario("../config/" + name + ".yaml"); }

/// Takes steps until the growth time is reached.
void growUntil(Simulation& simulation, double hours) {
  takeSteps(simulation, std::lround(hours * 3600.0 / simulation.scenario().stepping.step) -
                            static_cast<long>(simulation.stepIndex()));
}

// --- circumnutating_shoot.yaml
// ----------------------------------------------------------------------------------------

/// Tips over the period from 10.5 h to 12 h, every minute.
std::vector<Vector3> lastOrbit(bool weight) {
  Scenario scenario = shipped("circumnutating_shoot");
  scenario.weight = weight;
  Simulation simulation(scenario);
  growUntil(simulation, 10.5);
  std::vector<Vector3> tips;
  for (int i = 0; i < 90; ++i) {
    takeSteps(simulation, 1);
    tips.push_back(tip(onlyRod(simulation)));
  }
  return tips;
}

Vector3 middleOf(const std::vector<Vector3>& tips) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& tip : tips) sum += tip;
  return sum / static_cast<double>(tips.size());
}

double meanRadius(const std::vector<Vector3>& tips) {
  const Vector3 middle = middleOf(tips);
  double sum = 0.0;
  for (const Vector3& tip : tips) sum += (tip - middle).head<2>().norm();
  return sum / static_cast<double>(tips.size());
}

TEST(CircumnutatingShoot, SweepsTheOrbitOfAnIndependentIntegration) {
  // Radius and middle by the explicit midpoint rule in steps of 18 s, 240 elements without division.
  const std::vector<Vector3> tips = lastOrbit(false);
  EXPECT_NEAR(meanRadius(tips), 4.264e-3, 0.02e-3);
  EXPECT_LT((middleOf(tips).head<2>() - Eigen::Vector2d(0.0, 2.72e-3)).norm(), 0.03e-3);
}

TEST(CircumnutatingShoot, SweepsLittleWiderUnderItsWeightOnceInAPeriod) {
  const std::vector<Vector3> tips = lastOrbit(true);
  EXPECT_GT(meanRadius(tips), 4.264e-3);
  EXPECT_LT(meanRadius(tips), 1.1 * 4.264e-3);
  const Vector3 middle = middleOf(tips);
  double swept = 0.0;
  for (std::size_t i = 1; i < tips.size(); ++i) {
    const Eigen::Vector2d a = (tips[i - 1] - middle).head<2>(), b = (tips[i] - middle).head<2>();
    swept += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  EXPECT_NEAR(degrees(swept), 356.0, 2.0);  // 89 of 90 minutes, counter-clockwise from above
}

// --- revolving_shoot.yaml
// ---------------------------------------------------------------------------------------------

TEST(RevolvingShoot, TurnsItsBendUntilTissueLeavesTheZone) {
  Simulation simulation(shipped("revolving_shoot"));
  growUntil(simulation, 20.0);
  const rod::Rod& rod = onlyRod(simulation);
  EXPECT_NEAR(rod.restLength(), 0.08, 1e-6);
  double from_tip = rod.restLength();
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const Eigen::Vector2d bend = rod.bends[j].rest_curvature.head<2>();
    EXPECT_NEAR(bend.norm(), 10.0, 0.2) << j;  // where an element divides, the mean of bends up to 0.4 rad apart
    // Tissue above the zone leaves it after ln(zone / distance) / rate; now it is as far below as it was late.
    const double hours = 20.0 - std::max(0.0, from_tip - 0.04) / (0.05 * 0.04);
    const Eigen::Vector2d expected(-std::sin(M_PI * hours), std::cos(M_PI * hours));
    // The gate closes on whole elements of up to 0.25 mm, which pass at 2 mm/h: too early or late by 4 minutes at most.
    const double missed = std::acos(std::min(1.0, bend.dot(expected) / bend.norm()));
    if (std::abs(from_tip - 0.04) > 0.5e-3) {
      EXPECT_LT(missed, from_tip < 0.04 ? 1e-6 : 0.21) << j;
    }
    from_tip -= rod.elements[j].rest_length;
  }
}

// --- lamp_between_shoots.yaml
// -----------------------------------------------------------------------------------------

TEST(LampBetweenShoots, BendsTheNearShootToTheDirectionOfBalance) {
  Simulation simulation(shipped("lamp_between_shoots"));
  growUntil(simulation, 48.0);
  const Vector3 lamp(0.0, 0.0, 0.06);
  for (const Organ& organ : simulation.organs()) {
    // At the tip the pull is 0.3 sqrt(16) (5 cm / d)^2 towards the lamp, against 0.8 upwards.
    const Vector3 towards = lamp - tip(organ.rod());
    const Vector3 balance = 0.8 * Vector3::UnitZ() + 1.2 * 0.0025 / towards.squaredNorm() * towards.normalized();
    const double angle = degrees(std::acos(tipDirection(organ.rod()).dot(balance.normalized())));
    EXPECT_LT(angle, 2.0) << organ.scenario().id;
  }
  EXPECT_GT(degrees(tipAngle(simulation.organs()[0].rod())), 50.0);
  EXPECT_GT(degrees(tipAngle(simulation.organs()[1].rod())), -7.0);
  EXPECT_LT(degrees(tipAngle(simulation.organs()[1].rod())), -4.0);
}

TEST(LampBetweenShoots, SaturatesTheNearShootAlone) {
  Simulation simulation(shipped("lamp_between_shoots"));
  takeSteps(simulation, 1);
  EXPECT_GT(simulation.organs()[0].report().largest_differential_growth, 1.0);
  EXPECT_LT(simulation.organs()[1].report().largest_differential_growth, 0.1);
}

// --- three_growth_laws.yaml
// -------------------------------------------------------------------------------------------

TEST(ThreeGrowthLaws, SagHoldAndCurl) {
  Simulation simulation(shipped("three_growth_laws"));
  growUntil(simulation, 24.0);
  std::vector<Vector3> after_a_day;
  for (const Organ& organ : simulation.organs()) after_a_day.push_back(tip(organ.rod()));
  growUntil(simulation, 36.0);
  const auto angle = [&](std::size_t organ) { return degrees(tipAngle(simulation.organs()[organ].rod())); };
  const auto moved = [&](std::size_t organ) {
    return (tip(simulation.organs()[organ].rod()) - after_a_day[organ]).norm();
  };
  // The plane elastica with kappa0 = -G sin(theta), G = 2, weight 4.018, by collocation (solve_bvp of SciPy).
  EXPECT_NEAR(angle(0), 27.557, 0.2);
  EXPECT_LT((tip(simulation.organs()[0].rod()) - 0.16 * Vector3(0.83085, 0.0, 0.43849)).norm(), 2e-3 * 0.16);
  EXPECT_NEAR(angle(1), 15.415, 0.2);
  EXPECT_LT(moved(0), 1e-5);
  EXPECT_LT(moved(1), 1e-5);
  EXPECT_GT(moved(2), 1e-3);
}

// --- coiling_tendril.yaml
// ---------------------------------------------------------------------------------------------

TEST(CoilingTendril, WindsItselfIntoAHelixOfTheGivenCurvatureAndTwist) {
  Simulation simulation(shipped("coiling_tendril"));
  growUntil(simulation, 16.0);
  const rod::Rod& rod = onlyRod(simulation);
  EXPECT_NEAR(rod.restLength(), 0.04 * std::exp(1.6), 1e-9);
  // Axis and radius of the helix of curvature 100 and twist 150: the axis is along 100 d2 + 150 d3.
  const Vector3 u(0.0, 100.0, 150.0);
  const double rise = 150.0 / u.norm(), radius = 100.0 / u.squaredNorm();
  const Vector3 axis = rod.base.frame * u.normalized();
  const Vector3 centre = radius * (rod.base.frame * Vector3::UnitX());
  for (const rod::Bend& bend : rod.bends) EXPECT_LT((bend.rest_curvature - u).norm(), 0.02);
  for (const rod::Vertex& vertex : rod.vertices) {
    const Vector3 from_centre = vertex.position - centre;
    EXPECT_NEAR((from_centre - from_centre.dot(axis) * axis).norm(), radius, 5e-3 * radius);
  }
  EXPECT_NEAR((tip(rod) - centre).dot(axis), rise * rod.restLength(), 5e-3 * rod.restLength());
}

}  // namespace
}  // namespace sensory_growth::simulation
