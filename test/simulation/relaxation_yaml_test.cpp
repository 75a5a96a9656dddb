// Each way of relaxing knows its own keys and refuses what it would ignore.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using support::changed;
using support::list;
using support::problemsOf;
using support::valid;
using testing::HasSubstr;

TEST(RelaxationYaml, KinematicRelaxationRefusesWhatItWouldIgnore) {
  const std::string no_effect = "has no effect with kinematic relaxation; leave it out\n";
  EXPECT_EQ(
      list(problemsOf(changed({{"method: static", "method: kinematic"},
                               {"roll: 0 deg", "support: hinged"},
                               {"keep_strain", "keep_positions"},
                               {"[0 N, 0 N, 0 N]", "[1 N, 0 N, 0 N]"},
                               {"[0 N/m,", "[1 N/m,"},
                               {"[0 N m,", "[1 N m,"}}))) +
          "\n",
      "test:3: weight: 'true' has no effect with kinematic relaxation; give false\n"
      "test:8: relaxation.max_iterations: is an unknown key; known here are 'method'\n"
      "test:11: organs[0].base.support: 'hinged' needs forces that turn the organ, and kinematic relaxation knows "
      "none; give 'clamped'\n"
      "test:20: organs[0].division.mode: 'keep_positions' leaves a strain defect that kinematic relaxation never "
      "removes; give 'keep_strain'\n"
      "test:21: organs[0].tip_force: " +
          no_effect + "test:22: organs[0].line_force: " + no_effect +  //
          "test:23: organs[0].tip_couple: " + no_effect + "test:25: organs[0].springs: " + no_effect +
          "test:27: organs[0].walls: " + no_effect + "test:28: organs[0].held_apex: " + no_effect);
}

TEST(RelaxationYaml, MotionInTimeRefusesWhatIsInfinitelyStiff) {
  for (const std::string method : {"method: dynamic", "method: continuous, growth_per_second: 1 h"}) {
    EXPECT_EQ(
        list(problemsOf(changed({{"method: static, max_iterations: 100", method}}))),
        "test:27: organs[0].walls[0].stiffness: 'rigid' needs static relaxation: no time step is short enough for "
        "it; give a stiffness\n"
        "test:28: organs[0].held_apex: needs static relaxation: no time step is short enough for it; tie the apex "
        "with a spring");
  }
}

const std::string held_apex = "    held_apex: {position: [0 m, 0 m, 29 mm], direction: [0, 0, 1], roll: 10 deg}\n";

/// Problems of the valid scenario with another relaxation section, on line 8, and without rigid surroundings.
std::string problemsWithRelaxation(const std::string& keys, const std::string& material = "") {
  const std::string density = "density: 1000 kg/m^3";
  return list(problemsOf(changed({{"method: static, max_iterations: 100", keys},
                                  {density, density + material},
                                  {"stiffness: rigid", "stiffness: 6 N/m"},
                                  {held_apex, ""}})));
}

TEST(RelaxationYaml, EachRelaxationMethodKnowsItsOwnKeys) {
  const std::string at = "test:8: relaxation.";
  EXPECT_EQ(problemsWithRelaxation("method: dynamic"), "no problem");  // springs and a wall that gives way included
  EXPECT_EQ(problemsWithRelaxation("method: continuous, growth_per_second: 10 min"), "no problem");
  EXPECT_EQ(problemsWithRelaxation("method: continuous"),
            at + "growth_per_second: is missing; give a time such as '10 min'");
  EXPECT_THAT(problemsWithRelaxation("method: dynamic, growth_per_second: 10 min"),
              HasSubstr(at + "growth_per_second: is an unknown key"));
  EXPECT_THAT(problemsWithRelaxation("method: dynamic, max_iterations: 5"),
              HasSubstr(at + "max_iterations: is an unknown key"));
  EXPECT_THAT(problemsWithRelaxation("method: static, damping: 5 1/s"), HasSubstr(at + "damping: is an unknown key"));
  EXPECT_THAT(problemsWithRelaxation("method: dynamic, rest_steps: 5"),
              HasSubstr(at + "rest_steps: is an unknown key"));
  EXPECT_THAT(problemsWithRelaxation("method: dynamic, stopping: rotational_energy, tolerance: 1e-9"),
              HasSubstr(at + "tolerance: is an unknown key"));
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, stopping: energy"),
            at + "stopping: 'energy' is not known; give 'residual' or 'rotational_energy'");
}

TEST(RelaxationYaml, DynamicSettingsHaveUnitsAndRanges) {
  const std::string at = "test:8: relaxation.";
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, damping: 5"),
            at + "damping: '5' has no unit; give a rate such as '0.05 1/h'");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, damping: -5 1/s"),
            at + "damping: '-5 1/s' is out of range; must be >= 0 1/s");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, time_step: 1.5"),
            at + "time_step: '1.5' is out of range; must be > 0 and <= 1");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, ramp_periods: -1"),
            at + "ramp_periods: '-1' is out of range; must be >= 0");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, max_periods: 0"),
            at + "max_periods: '0' is out of range; must be > 0 and <= 10000");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, max_bend_angle: 120 deg"),
            at + "max_bend_angle: '120 deg' is out of range; must be > 0 rad and <= 2 rad");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, stopping: rotational_energy, rest_energy: 1 W"),
            at + "rest_energy: '1 W' is in units of m2.kg.s-3; give an energy such as '1e-12 J'");
  EXPECT_EQ(problemsWithRelaxation("method: dynamic, stopping: rotational_energy, rest_steps: 0"),
            at + "rest_steps: '0' is out of range; must be >= 1 and <= 1000000000");
  EXPECT_EQ(problemsWithRelaxation("method: continuous, growth_per_second: 0 s"),
            at + "growth_per_second: '0 s' is out of range; must be > 0 s");
  EXPECT_EQ(
      problemsWithRelaxation("method: dynamic", ", inextensible: true"),
      "test:15: organs[0].material.inextensible: 'true' needs static relaxation: no time step is short enough for "
      "it; give false");
}

}  // namespace
}  // namespace sensory_growth::simulation
