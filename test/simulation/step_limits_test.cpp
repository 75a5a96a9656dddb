// Steps are cut into the fewest parts that keep the limits of model.md 11.2.

#include <functional>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;

/// Parts of the first step of a kinematic, uniformly growing organ with one limit in force.
int partsWith(const std::function<void(Scenario&)>& change) {
  Scenario scenario = kinematicScenario(0.1, 20);
  change(scenario);
  Simulation simulation(scenario);
  EXPECT_TRUE(simulation.step().ok);
  return simulation.organs().front().report().substeps;
}

TEST(StepLimits, CutAStepIntoTheFewestPartsThatKeepThem) {
  EXPECT_EQ(partsWith([](Scenario&) {}), 1);
  EXPECT_EQ(partsWith([](Scenario& s) { s.stepping.limits.growth_strain = 0.03; }), 4);
  // The tip moves at speed 1, and faster as the organ grows: 0.5 * 0.06 per part.
  EXPECT_EQ(partsWith([](Scenario& s) {
              s.stepping.limits.tip_advance = 0.5;
              s.organs.front().longest_element = 0.06;
            }),
            4);
  // Light from above, sensitivity 0.2 on radius 0.05: 4 rad per unit length and strain at first, 0.2 per bend.
  const auto lit = [](Scenario& s) {
    s.organs.front().senses.light_direction = 0.2;
    s.protocol = {
        {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sky", Vector3::UnitZ(), 1.0}}};
  };
  EXPECT_EQ(partsWith([&](Scenario& s) {
              lit(s);
              s.stepping.limits.bend_angle = 0.0075;
            }),
            3);
  // 19.5 cells of 0.05: 3.9 rad per unit strain in all, at most.
  EXPECT_EQ(partsWith([&](Scenario& s) {
              lit(s);
              s.stepping.limits.total_angle = 0.21;
            }),
            2);
}

TEST(StepLimits, CountTheRotationOfTheRestCurvatureToo) {
  // 10 per unit length in cells of 0.05 turn by 0.5 times 2 pi / 20 in a unit of time: 0.157 per bend.
  EXPECT_EQ(partsWith([](Scenario& s) {
              s.organs.front().rest_curvature = {0.0, 10.0, 0.0};
              s.organs.front().bending.rotation = growth::RestRotation{20.0, 1e-3};
              s.stepping.limits.bend_angle = 0.0064;
            }),
            3);
}

TEST(StepLimits, CountTheStraighteningToo) {
  // 10 per unit length, gamma / R = 2: 20 per unit length and strain, 1 rad per bend and strain, in a step of 0.1.
  EXPECT_EQ(partsWith([](Scenario& s) {
              s.organs.front().rest_curvature = {0.0, 10.0, 0.0};
              s.organs.front().bending.proprioception.intrinsic_length = 0.1;
              s.stepping.limits.bend_angle = 0.06;
            }),
            2);
}

}  // namespace
}  // namespace sensory_growth::simulation
