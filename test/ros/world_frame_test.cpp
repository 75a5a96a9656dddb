#include "sensory_growth/ros/world_frame.h"

#include <gtest/gtest.h>

namespace sensory_growth::node {
namespace {

TEST(TransformMemory, IsLongForSlowClocksAndBoundedForShortSteps) {
  EXPECT_EQ(transformMemory(1.0), 600.0);
  EXPECT_EQ(transformMemory(60.0), 600.0);
  for (const double step : {1e-1, 1e-3, 1e-6}) EXPECT_LE(transformMemory(step) / step, 10001.0) << step;
  EXPECT_NEAR(transformMemory(1e-3), 10.0, 1e-9);
}

}  // namespace
}  // namespace sensory_growth::node
