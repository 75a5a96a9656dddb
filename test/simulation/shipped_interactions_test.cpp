// The shipped scenarios in which organs meet or the world turns do what their descriptions say. Figures are those of an
// independent planar integration (Python: Heun's method for lengths and rest curvatures, Newton's for the equilibrium
// of inextensible rods; 120 elements, steps of 1 min), converged to about 0.1 degrees and 0.1 mm.

#include <cmath>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

/// Takes steps until the growth time is reached.
void growUntil(Simulation& simulation, double hours) {
  while (simulation.time() < hours * 3600.0 - 1.0) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

const rod::Rod& rodOf(const Simulation& simulation, std::size_t organ) { return simulation.organs()[organ].rod(); }

/// Of the apex from the vertical, positive to +x [degrees].
double tilt(const rod::Rod& rod) {
  const Vector3 direction = rod.apex().frame * Vector3::UnitZ();
  return std::atan2(direction.x(), direction.z()) * 180.0 / M_PI;
}

TEST(DodderAndHost, TheSeedlingBendsTowardsTheHostAndMeetsIt) {
  Simulation simulation(loadScenario("../config/dodder_and_host.yaml"));
  growUntil(simulation, 3.0);
  EXPECT_NEAR(tilt(rodOf(simulation, 0)), 42.7, 0.5);
  growUntil(simulation, 18.0);
  const Vector3 tip = rodOf(simulation, 0).vertices.back().position;
  EXPECT_NEAR(tip.x(), 30.4e-3, 0.2e-3);
  EXPECT_NEAR(tip.z(), 44.7e-3, 0.2e-3);
  EXPECT_NEAR(tip.y(), 0.0, 1e-9);
  EXPECT_NEAR(tilt(rodOf(simulation, 1)), 0.0, 1e-6);
  growUntil(simulation, 23.0);
  EXPECT_TRUE(simulation.finished());
  const double touch = 40e-3 - 1.5e-3 - 0.4e-3;
  EXPECT_NEAR(rodOf(simulation, 0).vertices.back().position.x(), touch, 0.5e-3);
}

TEST(DodderAndHost, WithoutItsScentTheHostIsNotFound) {
  Scenario scenario = loadScenario("../config/dodder_and_host.yaml");
  scenario.organs[1].source.reset();
  Simulation simulation(scenario);
  growUntil(simulation, 10.0);
  EXPECT_NEAR(rodOf(simulation, 0).vertices.back().position.x(), 0.0, 1e-6);
}

TEST(TurnedPot, BendsAwayFromGravityAndStraightensWithoutItsSense) {
  Simulation simulation(loadScenario("../config/turned_pot.yaml"));
  growUntil(simulation, 1.0);
  EXPECT_NEAR(tilt(rodOf(simulation, 0)), 0.0, 1e-6);
  EXPECT_NEAR(simulation.gravity().x(), 9.81, 1e-12);
  growUntil(simulation, 2.0);
  EXPECT_NEAR(tilt(rodOf(simulation, 0)), -42.8, 0.5);
  growUntil(simulation, 5.0);
  EXPECT_NEAR(tilt(rodOf(simulation, 0)), -80.1, 0.5);
  growUntil(simulation, 9.0);
  EXPECT_NEAR(tilt(rodOf(simulation, 0)), -26.5, 0.5);
  EXPECT_EQ(simulation.takeApplied().size(), 2u);
}

}  // namespace
}  // namespace sensory_growth::simulation
