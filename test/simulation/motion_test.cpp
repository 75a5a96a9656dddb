// Organs that relax by moving, and organs that never rest.

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

/// A short, thick shoot laid on its side, of weight and stiffness 1, that lifts itself as it grows.
Scenario shoot(RelaxationMethod method, double step) {
  Scenario scenario = support::kinematicScenario(step, 6);
  scenario.relaxation = method;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.1, 1.0, 1.0);
  organ.senses.gravity = 0.2;
  organ.bending.proprioception.intrinsic_length = 0.02;
  return scenario;
}

double largestDistance(const rod::Rod& a, const rod::Rod& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t v = 0; v <= a.size(); ++v) {
    largest = std::max(largest, (a.vertices[v].position - b.vertices[v].position).norm());
  }
  return largest;
}

rod::Rod grown(const Scenario& scenario, int steps) {
  Simulation simulation(scenario);
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.ok) << report.message;
  }
  return simulation.organs().front().rod();
}

TEST(DynamicOrgan, GrowsIntoTheShapesOfTheStaticOne) {
  Scenario dynamic = shoot(RelaxationMethod::dynamics, 0.05);
  Scenario statics = shoot(RelaxationMethod::statics, 0.05);
  for (Scenario* scenario : {&dynamic, &statics}) scenario->organs.front().longest_element = 0.18;
  const rod::Rod moved = grown(dynamic, 4);
  EXPECT_EQ(moved.size(), 12u);
  EXPECT_LT(largestDistance(moved, grown(statics, 4)), 1e-7);
}

TEST(DynamicOrgan, CountsItsTimeStepsAndRests) {
  Simulation simulation(shoot(RelaxationMethod::dynamics, 0.05));
  ASSERT_TRUE(simulation.step().ok);
  const Organ& organ = simulation.organs().front();
  EXPECT_TRUE(organ.report().relaxation.in_time);
  EXPECT_GT(organ.report().iterations, 1000);
  EXPECT_EQ(mechanics::kineticEnergy(organ.rod()), 0.0);
}

TEST(ContinuousOrgan, FollowsTheStaticOneToFirstOrderInTheRateOfGrowth) {
  // A quarter of a second of motion per step, so that steps shrink with the rate.
  const auto lag = [](double growth_per_second) {
    const double step = 0.25 * growth_per_second;
    const int steps = static_cast<int>(std::lround(0.2 / step));
    Scenario continuous = shoot(RelaxationMethod::continuous, step);
    continuous.growth_per_second = growth_per_second;
    return largestDistance(grown(continuous, steps), grown(shoot(RelaxationMethod::statics, step), steps));
  };
  const double fast = lag(0.02), middle = lag(0.01), slow = lag(0.005);
  EXPECT_NEAR(support::order(fast, middle), 1.0, 0.1);
  EXPECT_NEAR(support::order(middle, slow), 1.0, 0.1);
  EXPECT_LT(slow, 3e-3);
}

TEST(ContinuousOrgan, KeepsMovingThroughStepsAndDivisions) {
  Scenario scenario = shoot(RelaxationMethod::continuous, 0.01);
  scenario.growth_per_second = 0.2;
  scenario.organs.front().longest_element = 0.18;
  Simulation simulation(scenario);
  for (int i = 0; i < 15; ++i) {
    ASSERT_TRUE(simulation.step().ok);
    EXPECT_GT(mechanics::kineticEnergy(simulation.organs().front().rod()), 0.0);
  }
  EXPECT_EQ(simulation.organs().front().rod().size(), 12u);
  EXPECT_NEAR(simulation.organs().front().report().relaxation.time, 0.05, 1e-15);
}

TEST(ContinuousOrgan, TakesItsVelocitiesBackWithTheStep) {
  Scenario scenario = shoot(RelaxationMethod::continuous, 0.01);
  scenario.growth_per_second = 0.2;
  Organ organ(scenario.organs.front(), scenario);
  growth::Environment environment;
  environment.down = -Vector3::UnitZ();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(organ.advance(0.01, environment).ok());
  const rod::Rod before = organ.rod();
  ASSERT_TRUE(organ.advance(0.01, environment).ok());
  const rod::Rod after = organ.rod();
  organ.undo();
  EXPECT_EQ(organ.rod().vertices.back().velocity, before.vertices.back().velocity);
  EXPECT_NE(after.vertices.back().velocity, before.vertices.back().velocity);
  ASSERT_TRUE(organ.advance(0.01, environment).ok());
  EXPECT_EQ(organ.rod().vertices.back().velocity, after.vertices.back().velocity);
  EXPECT_EQ(organ.rod().vertices.back().position, after.vertices.back().position);
}

TEST(ContinuousOrgan, NeedsARate) {
  EXPECT_THROW(Simulation(shoot(RelaxationMethod::continuous, 0.01)), std::invalid_argument);
}

TEST(ShippedMovingOrgans, DroopAsTheirDescriptionSaysAndGrow) {
  for (const char* file : {"../config/herbaceous_stem_dynamic.yaml", "../config/herbaceous_stem_continuous.yaml"}) {
    Simulation simulation(loadScenario(file));
    const rod::Rod start = simulation.organs().front().rod();
    EXPECT_NEAR(start.vertices.back().position.z(), -0.025, 0.001) << file;
    for (int i = 0; i < 2; ++i) {
      const StepReport report = simulation.step();
      ASSERT_TRUE(report.ok) << file << ": " << report.message;
    }
    const rod::Rod& rod = simulation.organs().front().rod();
    EXPECT_GT(rod.vertices.back().position.z(), start.vertices.back().position.z()) << file;
    EXPECT_GT(rod.restLength(), start.restLength()) << file;
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
