#include "sensory_growth/ros/followed_time.h"

#include <gtest/gtest.h>

#include <vector>

namespace sensory_growth::node {
namespace {

/// The stamps of all steps that are due.
std::vector<double> takeDue(FollowedTime& time) {
  std::vector<double> stamps;
  while (time.isDue()) stamps.push_back(time.tick().toSec());
  return stamps;
}

TEST(FollowedTime, AStepIsDueWheneverTimeHasGoneOnByOne) {
  FollowedTime time(0.25, ros::Time(100.0));
  EXPECT_FALSE(time.isDue());
  time.start();
  time.hear(ros::Time(100.2));
  EXPECT_FALSE(time.isDue());
  time.hear(ros::Time(100.8));  // three at once, stamped when they fell due
  EXPECT_EQ(takeDue(time), (std::vector<double>{100.25, 100.5, 100.75}));
  time.hear(ros::Time(101.0));
  EXPECT_EQ(takeDue(time), std::vector<double>{101.0});
  EXPECT_EQ(time.overruns(), 0u);
}

TEST(FollowedTime, StepsMoreThanASecondLateAreGivenUp) {
  FollowedTime time(0.25, ros::Time(100.0));
  time.start();
  time.hear(ros::Time(160.0));
  EXPECT_EQ(takeDue(time), (std::vector<double>{159.25, 159.5, 159.75, 160.0}));
  EXPECT_EQ(time.overruns(), 1u);
}

TEST(FollowedTime, WithoutRunningStampsAreTheTimeAndNeverTheSame) {
  FollowedTime time(0.25, ros::Time(100, 0));
  EXPECT_EQ(time.tick(), ros::Time(100, 0));
  EXPECT_EQ(time.tick(), ros::Time(100, 1));  // the clock stands still
  time.hear(ros::Time(200, 0));
  EXPECT_EQ(time.tick(), ros::Time(200, 0));
  time.start();
  time.stop();
  time.hear(ros::Time(300, 0));
  EXPECT_FALSE(time.isDue());
}

TEST(FollowedTime, GoesBackWithTheClock) {
  for (const bool is_reset : {false, true}) {
    FollowedTime time(0.25, ros::Time(100.0));
    time.start();
    time.hear(ros::Time(100.25));
    time.tick();
    EXPECT_FALSE(time.takeBackwardJump());
    time.hear(ros::Time(50.0));
    time.hear(ros::Time(50.5));  // heard before anybody has asked
    EXPECT_TRUE(time.takeBackwardJump());
    EXPECT_FALSE(time.takeBackwardJump());
    if (is_reset) {
      time.reset();
      EXPECT_EQ(time.tick().toSec(), 50.0);
    }
    EXPECT_EQ(takeDue(time), (std::vector<double>{50.25, 50.5}));
  }
}

TEST(FollowedTime, AfterAResetStepsCountFromTheFirstState) {
  FollowedTime time(0.25, ros::Time(100.0));
  time.start();
  time.hear(ros::Time(100.25));
  time.tick();
  time.hear(ros::Time(100.375));
  time.reset();
  EXPECT_EQ(time.tick().toSec(), 100.375);
  time.hear(ros::Time(100.625));
  EXPECT_EQ(takeDue(time), std::vector<double>{100.625});
}

TEST(FollowedTime, NothingAccumulates) {
  FollowedTime time(0.1, ros::Time(1.0));
  time.start();
  ros::Time last;
  for (int i = 1; i <= 100000; ++i) {
    time.hear(ros::Time(1.0) + ros::Duration(i / 10, i % 10 * 100000000));
    ASSERT_TRUE(time.isDue()) << i;
    last = time.tick();
  }
  EXPECT_EQ(last, ros::Time(10001, 0));
}

}  // namespace
}  // namespace sensory_growth::node
