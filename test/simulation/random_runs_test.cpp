// Random valid scenarios may end in a fault, but not in numbers that are none (model.md 17). test/slow has long runs.

#include "support/random_runs.h"

#include <gtest/gtest.h>

namespace sensory_growth::simulation {
namespace {

TEST(RandomScenarios, StaySound) {
  EXPECT_GT(support::soundRuns(1, 20, 60, "static"), 10);
  EXPECT_GT(support::soundRuns(1, 20, 60, "kinematic"), 10);
  EXPECT_GT(support::soundRuns(1, 6, 20, "continuous"), 3);
  EXPECT_GT(support::soundRuns(1, 3, 5, "dynamic"), 1);
}

}  // namespace
}  // namespace sensory_growth::simulation
