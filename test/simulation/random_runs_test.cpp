// Random valid scenarios may end in a fault, but not in numbers that are none (model.md 17). test/slow has long runs.

#include "support/random_runs.h"

#include <string>

#include <gtest/gtest.h>

namespace sensory_growth::simulation {
namespace {

TEST(RandomScenarios, HoldEveryMechanism) {
  std::string all;
  for (unsigned seed = 1; seed <= 160; ++seed) all += support::randomScenario(seed, 60, "static");
  for (const char* piece : {"profile: uniform",
                            "profile: apical_flat",
                            "profile: apical_gaussian",
                            "profile: logistic",
                            "profile: sampled",
                            "elongation: false",
                            "twist_transport: rate",
                            "stress_coupling:",
                            "lockhart_sign: -1",
                            "largest_factor: 1.5",
                            "clock: maturation",
                            "clock: time",
                            "stiffening:",
                            "thickening:",
                            "law: inverse_power",
                            "law: exponential",
                            "law: gaussian",
                            "law: sampled",
                            "saturation: true",
                            "form: oscillator",
                            "form: rotation",
                            "set_point:",
                            "at: local",
                            "at: apex",
                            "at: distance_from_apex",
                            "at: distance_from_base",
                            "at: label",
                            "kernel: delay",
                            "kernel: exponential, time_constant",
                            "kernel: linear_ode",
                            "kernel: sampled, times",
                            "kernel: exponential, direction: basipetal",
                            "direction: acropetal",
                            "direction: both",
                            "kernel: sampled, labels",
                            "coordinate: distance_from_apex",
                            "coordinate: distance_from_base",
                            "coordinate: label",
                            "before_start: zero",
                            "source: {",
                            "organ_2",
                            "mode: keep_positions",
                            "set: {gravity",
                            "set: {parameter",
                            "add: {point_source",
                            "change: {light_direction",
                            "springs:",
                            "walls:"}) {
    EXPECT_NE(all.find(piece), std::string::npos) << piece;
  }
}

TEST(RandomScenarios, StaySound) {
  EXPECT_GT(support::soundRuns(1, 20, 60, "static"), 10);
  EXPECT_GT(support::soundRuns(1, 20, 60, "kinematic"), 10);
  EXPECT_GT(support::soundRuns(1, 6, 20, "continuous"), 3);
  EXPECT_GT(support::soundRuns(1, 3, 5, "dynamic"), 1);
}

}  // namespace
}  // namespace sensory_growth::simulation
