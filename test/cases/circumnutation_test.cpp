// Circumnutation by an oscillator (V15 of model.md 18) and by rotation of the rest curvature (model.md 5).

#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>

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

using Complex = std::complex<double>;

constexpr double kTurn = 2.0 * M_PI;

Complex restBending(const rod::Rod& rod, std::size_t bend) {
  return {rod.bends[bend].rest_curvature.x(), rod.bends[bend].rest_curvature.y()};
}

/// V15: an upright organ of fixed length with a period of 1.
Scenario nutating(double step, std::size_t elements = 20) {
  Scenario scenario = kinematicScenario(step, elements);
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.elongation = false;
  organ.senses.oscillator = {0.05, 1.0, 0.0, 0.0};
  organ.bending.proprioception.intrinsic_length = 0.05;
  return scenario;
}

/// Once it has forgotten that it began straight, with amplitude / R = gamma / R = 1.
Complex steadyBending(double time) {
  const Complex i(0.0, 1.0);
  return i * std::exp(i * kTurn * time) / (1.0 + i * kTurn);
}

constexpr double kLongTime = 16.0;  // e^-16 of the start is left

TEST(Oscillator, CirclesWithTheAmplitudeAndPhaseOfTheClosedForm) {
  Simulation simulation(nutating(0.0125));
  takeSteps(simulation, std::lround(kLongTime / 0.0125));
  for (int quarter = 0; quarter < 4; ++quarter) {
    takeSteps(simulation, 20);
    const Complex bending = restBending(onlyRod(simulation), 7);
    EXPECT_NEAR(std::abs(bending), 0.157176725, 1e-3 * 0.157176725);
    EXPECT_LT(std::abs(bending - steadyBending(simulation.time())), 1e-3 * 0.157);
  }
}

TEST(Oscillator, IsSecondOrderInTime) {
  const auto error = [](double step) {
    const rod::Rod rod = grown(nutating(step, 2), std::lround(kLongTime / step));
    return std::abs(restBending(rod, 1) - steadyBending(kLongTime));
  };
  EXPECT_NEAR(order(error(0.05), error(0.025)), 2.0, 0.1);
  EXPECT_NEAR(order(error(0.025), error(0.0125)), 2.0, 0.05);
}

TEST(Oscillator, SweepsTheTipOnceRoundItsOrbitInAPeriod) {
  Simulation simulation(nutating(0.0125, 100));
  takeSteps(simulation, std::lround(kLongTime / 0.0125));
  double swept = 0.0;
  Vector3 before = tip(onlyRod(simulation));
  for (int i = 0; i < 80; ++i) {
    takeSteps(simulation, 1);
    const Vector3 now = tip(onlyRod(simulation));
    EXPECT_NEAR(now.head<2>().norm(), 0.078427, 1e-4);  // (1 - cos k) / k
    swept += std::atan2(before.x() * now.y() - before.y() * now.x(), before.head<2>().dot(now.head<2>()));
    before = now;
  }
  EXPECT_NEAR(swept, kTurn, 1e-6);  // from d1 to d2: counter-clockwise from above
}

TEST(Oscillator, TurnsTheOtherWayWithANegativePeriod) {
  Scenario scenario = nutating(0.0125);
  scenario.organs.front().senses.oscillator.period = -1.0;
  const Complex bending = restBending(grown(scenario, 1300), 7);
  // The mirror image: k1 and the direction of time change sign.
  EXPECT_LT(std::abs(bending + std::conj(steadyBending(1300 * 0.0125))), 2e-4);
}

TEST(Oscillator, RunsOnAcrossTheStepsOfTheSimulation) {
  // Parts of a step and steps make the same motion: the clock is that of the simulation, not of the step.
  Scenario in_parts = nutating(0.5, 2);
  in_parts.stepping.limits.oscillation = 0.025;
  Simulation simulation(in_parts);
  takeSteps(simulation, 3);
  EXPECT_EQ(simulation.organs().front().report().substeps, 20);
  const Complex in_steps = restBending(grown(nutating(0.025, 2), 60), 1);
  EXPECT_LT(std::abs(restBending(onlyRod(simulation), 1) - in_steps), 1e-12);
}

TEST(Oscillator, LimitsAStepToATenthOfItsPeriod) {
  Scenario scenario = nutating(0.35);
  scenario.stepping.limits.oscillation = StepLimits{}.oscillation;
  Simulation simulation(scenario);
  takeSteps(simulation, 1);
  EXPECT_EQ(simulation.organs().front().report().substeps, 4);
  scenario.organs.front().senses.oscillator = {};
  scenario.organs.front().bending.rotation = growth::RestRotation{-1.0, 1e-3};
  Simulation rotating(scenario);
  takeSteps(rotating, 1);
  EXPECT_EQ(rotating.organs().front().report().substeps, 4);
}

/// An organ of fixed length, bent at the start, whose rest curvature turns once per unit of time.
Scenario rotating(double step) {
  Scenario scenario = kinematicScenario(step, 20);
  OrganScenario& organ = scenario.organs.front();
  organ.elongation = false;
  organ.rest_curvature = {0.3, -0.1, 0.2};
  organ.bending.rotation = growth::RestRotation{1.0, 1e-3};
  return scenario;
}

TEST(RestRotation, IsExactForAnyStep) {
  for (const double step : {0.01, 0.3, 5.0}) {
    const rod::Rod rod = grown(rotating(step), 3);
    const Complex expected = Complex(0.3, -0.1) * std::polar(1.0, kTurn * 3.0 * step);
    for (std::size_t j = 0; j < rod.size(); ++j) {
      EXPECT_LT(std::abs(restBending(rod, j) - expected), 1e-13);
      EXPECT_EQ(rod.bends[j].rest_curvature.z(), 0.2);
    }
  }
}

TEST(RestRotation, StopsWhenTissueComesToTheGate) {
  // When growth at bends 3 to 12 falls to a thousandth of the fastest: the same lengths integrated independently, RK4
  // with steps of 0.00025 and linear interpolation of the crossing. Errors are of second order in the step.
  const double gone[] = {0.016707, 0.066715, 0.116728, 0.166748, 0.216779,
                         0.266826, 0.316896, 0.367001, 0.417158, 0.467392};
  for (const double step : {0.04, 0.02, 0.01}) {
    Scenario scenario = kinematicScenario(step, 40);
    OrganScenario& organ = scenario.organs.front();
    organ.profile = growth::LogisticProfile{1.0, 0.5, 8.0};
    organ.rest_curvature = {0.5, 0.3, 0.2};
    organ.bending.rotation = growth::RestRotation{0.7, 1e-3};
    const rod::Rod rod = grown(scenario, std::lround(0.8 / step));
    for (std::size_t i = 0; i < std::size(gone); ++i) {
      const Complex expected = Complex(0.5, 0.3) * std::polar(1.0, kTurn * gone[i] / 0.7);
      EXPECT_LT(std::abs(restBending(rod, i + 3) - expected), 6.0 * step * step) << step << ", bend " << i + 3;
    }
  }
}
TEST(RestRotation, NeverMovesAStraightOrgan) {
  Scenario scenario = rotating(0.01);
  scenario.organs.front().rest_curvature.setZero();
  for (const rod::Bend& bend : grown(scenario, 50).bends) EXPECT_EQ(bend.curvature, Vector3::Zero());
}

TEST(RestRotation, LeavesTissueAloneThatNoLongerGrows) {
  Scenario scenario = rotating(0.01);
  scenario.organs.front().profile = growth::ApicalFlatProfile{1.0, 0.5};
  const rod::Rod rod = grown(scenario, 25);
  for (std::size_t j = 0; j < 10; ++j) EXPECT_EQ(restBending(rod, j), Complex(0.3, -0.1)) << j;
  for (std::size_t j = 10; j < 20; ++j) {
    EXPECT_LT(std::abs(restBending(rod, j) - Complex(0.1, 0.3)), 1e-14) << j;  // a quarter turn
  }
}

TEST(RestRotation, OpensItsGateAboveAFractionOfTheFastestGrowth) {
  // A steep logistic zone: rate over the fastest is 1 / (1 + e^-u), below the gate of 0.5 where u < 0.
  Scenario scenario = rotating(0.25);
  scenario.organs.front().profile = growth::LogisticProfile{1.0, 0.5, 30.0};
  scenario.organs.front().bending.rotation->gate = 0.5;
  const rod::Rod rod = grown(scenario, 1);
  for (std::size_t j = 0; j < 10; ++j) EXPECT_EQ(restBending(rod, j), Complex(0.3, -0.1)) << j;
  for (std::size_t j = 11; j < 20; ++j) EXPECT_LT(std::abs(restBending(rod, j) - Complex(0.1, 0.3)), 1e-14) << j;
}

TEST(RestRotation, WithAConstantDriveAndProprioceptionFollowsItsClosedForm) {
  // db/dt = (i omega - gamma / R) b + f has a steady state f / (gamma / R - i omega); second order in time.
  const auto error = [](double step) {
    Scenario scenario = rotating(step);
    OrganScenario& organ = scenario.organs.front();
    organ.bending.proprioception.intrinsic_length = 0.05;
    organ.senses.oscillator = {0.05, support::kUnlimited, 0.0, 0.0};  // stands still: always towards d1
    const Complex rate(-1.0, kTurn), drive(0.0, 1.0), start(0.3, -0.1);
    const Complex expected = std::exp(rate) * (start + drive / rate) - drive / rate;
    return std::abs(restBending(grown(scenario, std::lround(1.0 / step)), 5) - expected);
  };
  EXPECT_LT(error(0.01), 1e-3);
  EXPECT_NEAR(order(error(0.02), error(0.01)), 2.0, 0.05);
}

}  // namespace
}  // namespace sensory_growth::simulation
