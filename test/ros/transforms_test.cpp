#include "sensory_growth/ros/transforms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros/snapshots.h"
#include "sensory_growth/ros/clock.h"

namespace sensory_growth::node {
namespace {

using ::testing::SizeIs;

TEST(Transforms, BaseIsStaticAndTipAndStationsMove) {
  const auto snapshot = testing::snapshotOf("stem");
  const tf2_msgs::TFMessage fixed = staticTransforms(*snapshot, {"map", "left_", 3});
  ASSERT_THAT(fixed.transforms, SizeIs(1));
  EXPECT_EQ(fixed.transforms[0].header.frame_id, "map");
  EXPECT_EQ(fixed.transforms[0].child_frame_id, "left_stem/base");

  const tf2_msgs::TFMessage moving = movingTransforms(*snapshot, {"map", "left_", 3});
  ASSERT_THAT(moving.transforms, SizeIs(4));
  EXPECT_EQ(moving.transforms[0].child_frame_id, "left_stem/tip");
  EXPECT_NEAR(moving.transforms[0].transform.translation.z, 3.04, 1e-15);
  for (int k = 1; k <= 3; ++k) {
    EXPECT_EQ(moving.transforms[k].child_frame_id, "left_stem/station_" + std::to_string(k));
    EXPECT_NEAR(moving.transforms[k].transform.translation.z, 3.0 + 0.01 * k, 1e-15);
  }
  for (const auto& transform : moving.transforms) EXPECT_EQ(transform.header.stamp, ros::Time(7, 500000000));
}

TEST(Transforms, RotationsAreNormalised) {
  auto snapshot = testing::snapshotOf("stem");
  snapshot->organs[0].rod.base.frame.coeffs() *= 1.001;
  const auto q = staticTransforms(*snapshot, {}).transforms.at(0).transform.rotation;
  EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-12);
}

TEST(Transforms, LeaveOutWhatIsNotFinite) {
  auto snapshot = testing::snapshotOf("stem");
  snapshot->organs[0].rod.base.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(staticTransforms(*snapshot, {}).transforms, SizeIs(0));
}

TEST(Stamps, CountStepsWithoutAccumulating) {
  EXPECT_EQ(stampOf(1, 1.0), ros::Time(1, 0));
  EXPECT_EQ(stampOf(3, 0.1), ros::Time(0, 300000000));
  EXPECT_EQ(stampOf(10000000, 0.1), ros::Time(1000000, 0));
  EXPECT_EQ(stampOf(3, 1.0 / 3.0), ros::Time(1, 0));
}

}  // namespace
}  // namespace sensory_growth::node
