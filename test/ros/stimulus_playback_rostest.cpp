/// Stimuli that somebody recorded with `rosbag record` are played into a live node.

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <vector>

#include "ros/child_process.h"
#include "ros/player.h"

namespace sensory_growth::node::testing {
namespace {

/// A lamp that comes, moves and goes, and a light, as they were sent by hand a year ago.
void record(const std::string& file) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  const ros::Time begin(1000.0);
  const auto at = [&](double seconds) { return begin + ros::Duration(seconds); };
  const std::string lamps = "/sensory_growth/point_source", lights = "/sensory_growth/light_direction";
  bag.write(lamps, at(0.0), lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.05}, 2.0));
  bag.write(lamps, at(0.2), lamp(PointSource::CHANGE, "lamp", {0.2, 0.0, 0.05}, 2.0));
  bag.write(lights, at(0.4), light(LightDirection::ADD, "sun", {0.0, 1.0, 0.0}));
  bag.write(lamps, at(0.6), lamp(PointSource::REMOVE, "lamp", rod::Vector3::Zero()));
}

TEST(StimulusPlayback, EntersALiveNode) {
  const TemporaryBag bag;
  record(bag.path());
  NodeUnderTest node;
  node.stepTo(3, 0);
  ChildProcess player(
      {"/usr/bin/env", "rosbag", "play", "--quiet", "--wait-for-subscribers", bag.path(), "__name:=hand"},
      bag.path() + ".txt");
  const AppliedCommand added = node.applied(0);
  EXPECT_EQ(added.operation, AppliedCommand::ADD);
  EXPECT_EQ(added.id, "lamp");
  EXPECT_EQ(added.step_index, 3u);
  EXPECT_EQ(added.strength, 2.0);
  EXPECT_EQ(node.applied(1).operation, AppliedCommand::CHANGE);
  EXPECT_EQ(node.applied(1).vector.x, 0.2);
  EXPECT_EQ(node.applied(2).kind, AppliedCommand::LIGHT_DIRECTION);
  EXPECT_EQ(node.applied(3).operation, AppliedCommand::REMOVE);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(node.applied(i).accepted) << node.applied(i).refusal;
  EXPECT_EQ(player.waitForExit(kPatience), 0) << player.printed();
}

}  // namespace
}  // namespace sensory_growth::node::testing
