// Random valid scenarios for 1000 steps (model.md 17).

#include "support/random_runs.h"

#include <gtest/gtest.h>

namespace sensory_growth::simulation {
namespace {

constexpr int kSteps = 1000;

TEST(RandomScenarios, StaySoundInEquilibrium) { EXPECT_GT(support::soundRuns(100, 60, kSteps, "static"), 45); }

TEST(RandomScenarios, StaySoundWithoutElasticity) { EXPECT_GT(support::soundRuns(100, 60, kSteps, "kinematic"), 45); }

TEST(RandomScenarios, StaySoundInMotion) { EXPECT_GT(support::soundRuns(100, 10, kSteps, "continuous"), 7); }

TEST(RandomScenarios, StaySoundRelaxedByMotion) { EXPECT_GT(support::soundRuns(100, 5, kSteps, "dynamic"), 3); }

}  // namespace
}  // namespace sensory_growth::simulation
