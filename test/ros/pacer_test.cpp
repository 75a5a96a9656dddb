#include "sensory_growth/ros/pacer.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Pacer, AnotherFactorHoldsFromNowOn) {
  Pacer pacer(1.0, 1e-6);  // the first step is due in eleven days
  pacer.start(kStart);
  pacer.setFactor(4.0, kStart + 1s);
  EXPECT_EQ(pacer.factor(), 4.0);
  EXPECT_EQ(pacer.due(), kStart + 1250ms);
  pacer.setFactor(0.0, kStart + 2s);
  EXPECT_FALSE(pacer.due());
}

TEST(Pacer, AnotherFactorIsMeasuredAnew) {
  Pacer pacer(1.0, 1.0);
  pacer.start(kStart);
  pacer.stepEnded(kStart + 1s);
  ASSERT_EQ(pacer.achievedFactor(), 1.0);
  pacer.setFactor(4.0, kStart + 1s);
  EXPECT_EQ(pacer.achievedFactor(), 0.0);
  for (int i = 1; i <= 4; ++i) pacer.stepEnded(kStart + 1s + i * 250ms);
  EXPECT_EQ(pacer.achievedFactor(), 4.0);
}

TEST(Pacer, AFactorIsZeroOrInRange) {
  for (const double good : {0.0, 1e-6, 1.0, 1e12}) EXPECT_FALSE(findFactorFault(good)) << good;
  for (const double bad :
       {-1.0, 0.9e-6, 1.1e12, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(findFactorFault(bad)) << bad;
  }
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
