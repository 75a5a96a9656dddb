// Tropisms without elasticity against published and derived figures: C1 (Bastien, Bohr, Moulia & Douady 2013), C4
// (Porat et al. 2020), C7 (Bastien, Douady & Moulia 2015), C8 (Meroz 2026) and V18 of model.md 18.

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::degrees;
using support::grown;
using support::kinematicScenario;
using support::onlyRod;
using support::order;
using support::takeSteps;
using support::tip;
using support::tipAngle;
using support::tipDirection;

TimedCommand light(const std::string& id, const Vector3& towards, double strength) {
  return {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, id, towards, strength}};
}

// --- C1: righting with proprioception
// ---------------------------------------------------------------------------------

constexpr double kTilt = 0.001;

/// A tilted shoot of fixed length with balance number B; time in units of its straightening.
Scenario tilted(double B, double step, std::size_t elements = 200) {
  Scenario scenario = kinematicScenario(step, elements);
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::exp({0.0, kTilt, 0.0});
  organ.elongation = false;
  organ.senses.gravity = 0.05 * B;
  organ.bending.proprioception.intrinsic_length = 0.05;
  return scenario;
}

struct Righting {
  double B;
  std::vector<double> tip_angles;  ///< over the tilt, at times 0.25, 0.5, 1, 2, 4
};

void PrintTo(const Righting& righting, std::ostream* out) { *out << "B " << righting.B; }

class RightingShoot : public testing::TestWithParam<Righting> {};

TEST_P(RightingShoot, FollowsTheExactTransient) {
  Simulation simulation(tilted(GetParam().B, 0.0125));
  long steps = 0;
  const double times[] = {0.25, 0.5, 1.0, 2.0, 4.0};
  for (int i = 0; i < 5; ++i) {
    const long due = std::lround(times[i] / 0.0125);
    takeSteps(simulation, due - steps);
    steps = due;
    EXPECT_NEAR(tipAngle(onlyRod(simulation)) / kTilt, GetParam().tip_angles[i], 2e-3) << "at " << times[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Bastien2013, RightingShoot,
                         testing::Values(Righting{2.0, {0.60780, 0.37541, 0.16891, 0.11013, 0.13291}},
                                         Righting{5.0, {0.18352, -0.09811, -0.11966, 0.01390, 0.00833}}));

TEST(RightingShoot, IsSecondOrderInTime) {
  const auto angle = [](int steps) { return tipAngle(grown(tilted(5.0, 1.0 / steps), steps)) / kTilt; };
  const double a20 = angle(20), a40 = angle(40), a80 = angle(80), a160 = angle(160);
  EXPECT_NEAR(order(a20 - a40, a40 - a80), 2.0, 0.15);
  EXPECT_NEAR(order(a40 - a80, a80 - a160), 2.0, 0.1);
}

TEST(RightingShoot, PassesTheVerticalAboveABalanceNumberOf2Point8) {
  const auto leastAngle = [](double B) {
    Simulation simulation(tilted(B, 0.02));
    double least = 1.0;
    for (int i = 0; i < 100; ++i) {
      takeSteps(simulation, 1);
      least = std::min(least, tipAngle(onlyRod(simulation)) / kTilt);
    }
    return least;
  };
  double below = 2.0, above = 4.0;
  ASSERT_GT(leastAngle(below), 0.0);
  ASSERT_LT(leastAngle(above), 0.0);
  while (above - below > 2e-3) {
    const double middle = 0.5 * (below + above);
    (leastAngle(middle) > 0.0 ? below : above) = middle;
  }
  EXPECT_NEAR(0.5 * (below + above), 2.79648, 0.005 * 2.79648);
}

// --- V18: a cue that is carried along
// ---------------------------------------------------------------------------------

TEST(MaterialCue, BendsTissueForAsLongAsItStaysInTheZone) {
  Scenario scenario = kinematicScenario(0.02, 40);
  OrganScenario& organ = scenario.organs.front();
  organ.length = 2.0;
  organ.section.radius = 0.1;
  organ.longest_element = 0.05 * (1.0 + 1e-9);
  organ.profile = growth::ApicalFlatProfile{1.0, 1.0};
  organ.senses.oscillator = {0.05, support::kUnlimited, 0.0, 0.0};  // stands still: always towards d1
  const rod::Rod rod = grown(scenario, 150);
  const double length = rod.restLength();
  EXPECT_NEAR(length, 5.0, 5e-4);
  double turning = 0.0;
  double s = 0.0;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double k2 = rod.bends[j].rest_curvature.y();
    turning += rod.voronoiLength(j) * k2;
    const double expected = 0.05 / 0.1 * std::clamp(3.0 - (length - s - 1.0), 0.0, 3.0);
    // Tissue in the cells at the two kinks of the law has only partly grown.
    const double from_tip = length - s;
    if (std::abs(from_tip - 1.0) > 0.1 && std::abs(from_tip - 4.0) > 0.1) {
      EXPECT_NEAR(k2, expected, 0.02) << "at " << from_tip << " from the tip";
    }
    s += rod.elements[j].rest_length;
  }
  turning += 0.5 * rod.elements.back().rest_length * rod.bends.back().rest_curvature.y();
  EXPECT_NEAR(turning, 3.75, 5e-4 * 3.75);
}

// --- C4: the kinematic model of Porat et al. 2020
// ---------------------------------------------------------------------

/// Their parameters: an upright organ of unit length, growing at 0.1 per unit length and time in its upper unit length.
Scenario porat() {
  Scenario scenario = kinematicScenario(0.025, 100);
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.section.radius = 0.1;
  organ.longest_element = 0.01 * (1.0 + 1e-9);
  organ.profile = growth::ApicalFlatProfile{0.1, 1.0};
  organ.bending.proprioception.intrinsic_length = 0.1;
  return scenario;
}

void expectTips(const Scenario& scenario, const std::vector<Vector3>& expected) {
  Simulation simulation(scenario);
  for (const Vector3& position : expected) {
    takeSteps(simulation, std::lround(10.0 / scenario.stepping.step));
    EXPECT_LT((tip(onlyRod(simulation)) - position).norm(), 2e-3)
        << tip(onlyRod(simulation)).transpose() << " at " << simulation.time();
  }
}

TEST(KinematicOrgan, TurnsIntoParallelLight) {
  Scenario scenario = porat();
  scenario.organs.front().senses.light_direction = 1.0;
  scenario.protocol = {light("sun", Vector3::UnitX(), 1.0)};
  expectTips(scenario, {{1.64366, 0.0, 0.50690}, {2.64718, 0.0, 0.46041}, {3.64728, 0.0, 0.47061}});
}

TEST(KinematicOrgan, CirclesRoundALamp) {
  Scenario scenario = porat();
  scenario.organs.front().senses.point_source = 1.0;
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, -1.0, 1.0}, 1.0}}};
  expectTips(scenario, {{1.03842, -1.03842, 1.11393}, {1.25863, -1.25863, 0.44381}, {0.94995, -0.94995, 1.61932}});
}

TEST(KinematicOrgan, Circumnutates) {
  Scenario scenario = porat();
  scenario.organs.front().senses.oscillator = {0.5, M_PI, 0.0, 0.0};
  expectTips(scenario, {{0.12070, 0.23753, 1.97516}, {0.10677, 0.58720, 2.92014}, {-0.02198, 0.86392, 3.88105}});
}

// --- C7 and C8: several stimuli at once
// -------------------------------------------------------------------------------

/// Long and upright, with a balance number of 10 with respect to gravity or to a light of strength 1.
Scenario longOrgan() {
  Scenario scenario = kinematicScenario(0.05, 200);
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.elongation = false;
  organ.bending.proprioception.intrinsic_length = 0.02;
  return scenario;
}

TEST(PhotoGravitropism, BalancesLightAndGravityAtTheTip) {
  for (const double towards : {60.0, 90.0, 120.0}) {
    const double P = towards * M_PI / 180.0;
    Scenario scenario = longOrgan();
    scenario.organs.front().senses.gravity = 0.2;
    scenario.organs.front().senses.light_direction = 0.1;
    scenario.protocol = {light("sun", {std::sin(P), 0.0, std::cos(P)}, 1.0)};
    const double expected = std::atan2(0.1 * std::sin(P), 0.2 + 0.1 * std::cos(P));
    EXPECT_NEAR(degrees(tipAngle(grown(scenario, 800))), degrees(expected), 0.2) << towards;
  }
}

double azimuthBetween(double east, double north, double exponent) {
  Scenario scenario = longOrgan();
  scenario.organs.front().senses.light_direction = 0.2;
  scenario.organs.front().senses.intensity_exponent = exponent;
  scenario.protocol = {light("east", Vector3::UnitX(), east), light("north", Vector3::UnitY(), north)};
  const Vector3 direction = tipDirection(grown(scenario, 100));
  return degrees(std::atan2(direction.y(), direction.x()));
}

TEST(TwoLights, SteerTheTipByAPowerOfTheirIntensities) {
  EXPECT_NEAR(azimuthBetween(1.0, 4.0, 1.0), 75.964, 0.5);        // atan 4
  EXPECT_NEAR(azimuthBetween(1.0, 4.0, 0.5), 63.435, 0.5);        // atan 2
  EXPECT_NEAR(azimuthBetween(8.0, 1.0, 1.0 / 3.0), 26.565, 0.5);  // atan 1/2
}

TEST(TwoLights, CancelWhenTheyAreOppositeAndAlike) {
  Scenario scenario = longOrgan();
  scenario.organs.front().senses.light_direction = 0.2;
  scenario.organs.front().senses.intensity_exponent = 0.5;
  scenario.protocol = {light("east", Vector3::UnitX(), 3.0), light("west", -Vector3::UnitX(), 3.0)};
  EXPECT_NEAR(degrees(tipAngle(grown(scenario, 100))), 0.0, 1e-9);
}

}  // namespace
}  // namespace sensory_growth::simulation
