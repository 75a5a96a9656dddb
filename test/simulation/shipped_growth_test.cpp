// The shipped scenarios of growth profiles, circumnutation, distance and growth laws do what their descriptions say.

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

// --- three_distance_laws.yaml
// ---------------------------------------------------------------------------------------------

TEST(ThreeDistanceLaws, SettleInTheShapesOfTheirLaws) {
  // The steady shape obeys theta' = (cues across the organ) / intrinsic_length from the base on; solve_ivp of SciPy.
  const struct {
    double towards, z, angle;
  } expected[] = {{25.5976e-3, 53.2828e-3, 43.532}, {31.1816e-3, 50.0845e-3, 48.416}, {27.3726e-3, 51.1752e-3, 52.080}};
  Simulation simulation(shipped("three_distance_laws"));
  growUntil(simulation, 96.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const rod::Rod& rod = simulation.organs()[i].rod();
    EXPECT_NEAR(0.06 - tip(rod).head<2>().norm(), expected[i].towards, 0.02e-3) << i;
    EXPECT_NEAR(tip(rod).z(), expected[i].z, 0.02e-3) << i;
    EXPECT_NEAR(degrees(std::acos(tipDirection(rod).z())), expected[i].angle, 0.05) << i;
  }
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

// --- weeping_branch.yaml
// ----------------------------------------------------------------------------------------------

TEST(WeepingBranch, RestsWhereAllLawsTogetherWantIt) {
  // The plane elastica with gamma_a (theta' - b*) = gamma_r m / B - lambda sin(theta) by collocation (solve_bvp of
  // SciPy), inextensible; and the sag at the start.
  Simulation simulation(shipped("weeping_branch"));
  EXPECT_LT((tip(onlyRod(simulation)) - Vector3(142.293e-3, 0.0, -68.251e-3)).norm(), 0.1e-3);
  growUntil(simulation, 24.0);
  const Vector3 resting = tip(onlyRod(simulation));
  EXPECT_LT((resting - Vector3(155.015e-3, 0.0, -37.003e-3)).norm(), 0.1e-3);
  EXPECT_NEAR(degrees(tipAngle(onlyRod(simulation))), 108.045, 0.02);
  growUntil(simulation, 36.0);
  EXPECT_LT((tip(onlyRod(simulation)) - resting).norm(), 1e-9);
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

TEST(CoilingTendril, FlattensIntoARingIfGrowthThinsItsTwist) {
  Scenario scenario = shipped("coiling_tendril");
  scenario.organs.front().twist_transport = growth::TwistTransport::angle;
  Simulation simulation(scenario);
  growUntil(simulation, 16.0);
  for (const rod::Bend& bend : onlyRod(simulation).bends) {
    EXPECT_NEAR(bend.rest_curvature.z(), 150.0 * std::exp(-1.6), 1e-6);
  }
}

// --- wheat_coleoptile.yaml with config/stimuli/darwin_1880_light_reversed.yaml
// --------------------------------------------------------------------------------------------------------------

TEST(WheatColeoptile, FollowsTheLightFromSideToSide) {
  // Curvature of 900 pieces of tissue that flow out of the zone, in Python with numpy, midpoint rule in steps of 6 s,
  // without weight, which adds up to 0.5 degrees. The balance of light and gravity is at atan(0.5 / 0.8), 32.0 degrees.
  const struct {
    double hours, lean;
  } expected[] = {{1, -22.53}, {2, -29.71}, {3, -31.33}, {4, -31.33}, {5, 12.47}, {6, 27.73}, {8, 31.64}};
  for (const bool weight : {false, true}) {
    Scenario scenario = shipped("wheat_coleoptile");
    scenario.weight = weight;
    scenario.protocol = loadProtocol("../config/stimuli/darwin_1880_light_reversed.yaml");
    Simulation simulation(scenario);
    for (const auto& [hours, lean] : expected) {
      growUntil(simulation, hours);
      EXPECT_NEAR(degrees(tipAngle(onlyRod(simulation))), lean, weight ? 0.5 : 0.05) << hours;
    }
    EXPECT_NEAR(onlyRod(simulation).restLength(), 38e-3, 1e-6);  // 1 mm an hour
  }
}

// --- arabidopsis_root.yaml and arabidopsis_root_gaussian.yaml
// ----------------------------------------------------------------------

/// Angle of the tip below the horizontal, towards the base beyond 90 [deg].
double dip(const Simulation& simulation) {
  const Vector3 direction = tipDirection(onlyRod(simulation));
  return degrees(std::atan2(-direction.z(), direction.x()));
}

TEST(ArabidopsisRoot, TurnsDownAndOvershootsAsAnIndependentIntegration) {
  // As above with 3000 pieces and steps of 18 s.
  const struct {
    const char* name;
    double dips[5];  ///< after 2, 5, 8, 12 and 16 h
  } roots[] = {{"arabidopsis_root", {49.19, 86.22, 93.09, 91.18, 90.08}},
               {"arabidopsis_root_gaussian", {50.25, 89.40, 96.08, 91.63, 89.64}}};
  for (const auto& root : roots) {
    Simulation simulation(shipped(root.name));
    const double hours[] = {2, 5, 8, 12, 16};
    for (int i = 0; i < 5; ++i) {
      growUntil(simulation, hours[i]);
      EXPECT_NEAR(dip(simulation), root.dips[i], 0.2) << root.name << " at " << hours[i];
    }
    EXPECT_NEAR(onlyRod(simulation).restLength(), 3e-3 + 16.0 * 0.13002e-3, 1e-7) << root.name;
  }
}

TEST(ArabidopsisRoot, AdvancesItsTipByLessThanHalfAnElementAtOnce) {
  Scenario scenario = shipped("arabidopsis_root");
  scenario.organs.front().senses.gravity = 0.0;
  scenario.stepping.step = 2.0 * 3600.0;
  scenario.stepping.limits.growth_strain = 1.0;
  Simulation simulation(scenario);
  takeSteps(simulation, 1);
  EXPECT_EQ(simulation.organs().front().report().substeps, 11);  // 260.04 um in parts of at most 25 um
}

}  // namespace
}  // namespace sensory_growth::simulation
