#include "sensory_growth/ros/pacer.h"

#include <gtest/gtest.h>

namespace sensory_growth::node {
namespace {

using namespace std::chrono_literals;

const Pacer::Clock::time_point kStart{100s};

TEST(Pacer, StepsAreDueOnePeriodApart) {
  Pacer pacer(1.0, 4.0);  // a second of ROS time in a quarter of a second
  pacer.start(kStart);
  EXPECT_EQ(pacer.due(), kStart + 250ms);
  pacer.stepBegins(kStart + 260ms);  // a little late does not shift the next
  EXPECT_EQ(pacer.due(), kStart + 500ms);
  EXPECT_EQ(pacer.overruns(), 0u);
}

TEST(Pacer, LostTimeIsCountedAndNotMadeUp) {
  Pacer pacer(1.0, 4.0);
  pacer.start(kStart);
  pacer.stepBegins(kStart + 2s);
  EXPECT_EQ(pacer.overruns(), 1u);
  EXPECT_EQ(pacer.due(), kStart + 2250ms);
}

TEST(Pacer, WithoutAFactorStepsAreDueAtOnce) {
  Pacer pacer(1.0, 0.0);
  pacer.start(kStart);
  EXPECT_FALSE(pacer.due());
  pacer.stepBegins(kStart + 1h);
  EXPECT_EQ(pacer.overruns(), 0u);
}

TEST(Pacer, MeasuresTheLastSecond) {
  Pacer pacer(0.5, 0.0);
  pacer.start(kStart);
  for (int i = 1; i <= 10; ++i) pacer.stepEnded(kStart + i * 100ms);
  EXPECT_NEAR(pacer.achievedFactor(), 5.0, 1e-12);  // 10 steps of half a second in one second
  pacer.stepEnded(kStart + 1200ms);
  EXPECT_NEAR(pacer.achievedFactor(), 5.0, 1e-12);
  pacer.stop(kStart + 1500ms);
  EXPECT_NEAR(pacer.achievedFactor(), 1.0, 1e-12);  // one step in the half second that is left
}

}  // namespace
}  // namespace sensory_growth::node
