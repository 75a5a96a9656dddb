// The shipped scenarios with walls and springs do what their descriptions say.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

const rod::Rod& onlyRod(const Simulation& simulation) { return simulation.organs().front().rod(); }

Vector3 tipDirection(const rod::Rod& rod) { return rod.apex().frame * Vector3::UnitZ(); }

double degrees(double radians) { return radians * 180.0 / M_PI; }

double tiltFromVertical(const rod::Rod& rod) { return degrees(std::acos(tipDirection(rod).z())); }

/// Takes steps until the growth time is reached.
void growUntil(Simulation& simulation, double hours) {
  while (simulation.time() < hours * 3600.0 - 1.0) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

class RootOnBarrier : public testing::Test {
 protected:
  static Scenario inLongSteps() {
    Scenario scenario = loadScenario("../config/root_on_barrier.yaml");
    scenario.stepping.step = 600.0;
    return scenario;
  }

  Simulation simulation_{inLongSteps()};
  const double barrier_ = -1e-3;
  const double plate_ = 5e-5;
  const double tolerance_ = 1e-12;  // 1e-10 of the length is a few tenths of it
};

TEST_F(RootOnBarrier, MeetsTheBarrierWithinThreeHoursAndNeverPassesAWall) {
  growUntil(simulation_, 2.0);
  EXPECT_GT(onlyRod(simulation_).vertices.back().position.z(), barrier_ + 1e-6);
  for (int i = 0; i < 30; ++i) {
    growUntil(simulation_, 3.0 + i / 6.0);
    const rod::Rod& rod = onlyRod(simulation_);
    EXPECT_NEAR(rod.vertices.back().position.z(), barrier_, tolerance_);
    for (const rod::Vertex& vertex : rod.vertices) {
      EXPECT_GE(vertex.position.z(), barrier_ - tolerance_);
      EXPECT_LE(std::abs(vertex.position.y()), plate_ + tolerance_);
    }
  }
}

TEST_F(RootOnBarrier, TakesTheShapeOfAStep) {
  growUntil(simulation_, 3.0);
  const double x_at_contact = onlyRod(simulation_).vertices.back().position.x();
  growUntil(simulation_, 8.0);
  const rod::Rod& rod = onlyRod(simulation_);
  EXPECT_GT(rod.vertices.back().position.x() - x_at_contact, 0.7e-3);  // of 0.65 mm that it grew, and the bend

  const auto slope = [&](std::size_t e) { return degrees(std::asin(-(rod.elements[e].frame * Vector3::UnitZ()).z())); };
  double least_slope = 90.0;
  for (std::size_t e = 0; e < rod.size(); ++e) least_slope = std::min(least_slope, slope(e));
  EXPECT_GT(slope(0), 40.0);
  EXPECT_LT(least_slope, 25.0);
  EXPECT_NEAR(slope(rod.size() - 1), 48.0, 4.0);
  EXPECT_GT(rod.vertices[rod.size() - 1].position.z(), barrier_ + 1e-6);  // the tip alone touches
}

TEST_F(RootOnBarrier, BendsAsItsOwnPushOnTheBarrierMust) {
  growUntil(simulation_, 8.0);
  const rod::Rod& rod = onlyRod(simulation_);
  // A frictionless barrier pushes straight up on the tip, so that moment over lever arm is the same everywhere.
  const auto push = [&](std::size_t bend) {
    const rod::Section& section = rod.elements[bend].section;
    const double stiffness = section.young_modulus * M_PI * std::pow(section.radius, 4) / 4.0;
    const double moment = stiffness * (rod.bends[bend].curvature - rod.bends[bend].rest_curvature).head<2>().norm();
    return moment / (rod.vertices.back().position.x() - rod.vertices[bend].position.x());
  };
  EXPECT_NEAR(push(1), 0.2e-3, 0.03e-3);
  for (const std::size_t bend : {rod.size() / 4, rod.size() / 2, 3 * rod.size() / 4}) {
    EXPECT_NEAR(push(bend) / push(1), 1.0, 1e-6) << bend;
  }
}

class StakedStem : public testing::Test {
 protected:
  static Scenario inLongSteps(bool tied) {
    Scenario scenario = loadScenario("../config/staked_stem.yaml");
    scenario.stepping.step = 1800.0;
    if (!tied) scenario.organs.front().loads.surroundings = {};
    return scenario;
  }
};

TEST_F(StakedStem, GrowsUpAlongItsStakeUntilItOutgrowsIt) {
  Simulation simulation(inLongSteps(true));
  const double height = onlyRod(simulation).vertices.back().position.z();
  for (int hours = 0; hours <= 20; ++hours) {
    growUntil(simulation, hours);
    const rod::Rod& rod = onlyRod(simulation);
    EXPECT_LT(tiltFromVertical(rod), 2.0) << hours;
    EXPECT_NEAR(rod.vertices.back().position.x(), 0.01, 0.003) << hours;
    EXPECT_NEAR(rod.vertices.back().position.z(), height + 0.003 * hours, 5e-4) << hours;
  }
  growUntil(simulation, 24.0);
  EXPECT_GT(tiltFromVertical(onlyRod(simulation)), 15.0);
}

TEST_F(StakedStem, TiesPullWithTwoToThreeTimesItsWeight) {
  const Scenario scenario = inLongSteps(true);
  const Simulation simulation(scenario);
  const double weight = 1000.0 * 9.81 * M_PI * 1.5e-3 * 1.5e-3 * 0.16;
  for (const mechanics::Spring& tie : scenario.organs.front().loads.surroundings.springs) {
    const Vector3& tied = onlyRod(simulation).vertices[static_cast<std::size_t>(std::lround(60 * tie.label))].position;
    const double pull = 20.0 * (tied - tie.anchor).norm();
    EXPECT_GT(pull, 2.0 * weight);
    EXPECT_LT(pull, 3.0 * weight);
  }
}

TEST_F(StakedStem, BendsOverAndSinksWithoutTies) {
  Simulation simulation(inLongSteps(false));
  EXPECT_GT(tiltFromVertical(onlyRod(simulation)), 60.0);
  growUntil(simulation, 18.0);
  EXPECT_LT(onlyRod(simulation).vertices.back().position.z(), 0.0);
}

}  // namespace
}  // namespace sensory_growth::simulation
