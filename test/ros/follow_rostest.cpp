/// A clock that somebody else owns, here the test: steps are taken as it goes on, and it may jump.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "ros/bag_contents.h"
#include "ros/diagnostics_listener.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

/// Half a second of ROS time to a step.
class Follow : public ::testing::Test {
 protected:
  Follow() : publisher_(handle_.advertise<rosgraph_msgs::Clock>("/clock", 10, true)) {}

  void say(double seconds) {
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time(seconds);
    publisher_.publish(clock);
  }

  ros::NodeHandle handle_;
  ros::Publisher publisher_;  // latched: the nodes wait for the first time
};

TEST_F(Follow, StepsAreTakenAsTheClockGoesOn) {
  say(100.0);
  NodeUnderTest node("/resetting/sensory_growth"), ignoring("/ignoring/sensory_growth");
  EXPECT_EQ(node.state(0).header.stamp.toSec(), 100.0);
  say(100.4);
  say(101.2);  // two steps were due in between
  EXPECT_EQ(node.state(1).header.stamp.toSec(), 100.5);
  EXPECT_EQ(node.state(2).header.stamp.toSec(), 101.0);
  say(101.5);
  EXPECT_EQ(node.state(3).header.stamp.toSec(), 101.5);

  // Far ahead: what is more than a second late is given up.
  say(1000.0);
  EXPECT_EQ(node.state(4).header.stamp.toSec(), 999.5);
  EXPECT_EQ(node.state(5).header.stamp.toSec(), 1000.0);
  EXPECT_EQ(node.waitForStatus("step 5", [](const Status& s) { return s.step_index == 5; }).overruns, 1u);

  // Paused, the clock means nothing, and steps by hand need none.
  const auto paused = node.command("pause");
  ASSERT_TRUE(paused.success);
  say(1010.0);
  EXPECT_EQ(node.stepTo(6, 5).header.stamp.toSec(), 1010.0);
  EXPECT_EQ(node.stepTo(7, 6).header.stamp, ros::Time(1010.0) + ros::Duration(0, 1));
  ASSERT_TRUE(node.command("resume").success);
  say(1010.5);
  EXPECT_EQ(node.state(8).header.stamp.toSec(), 1010.5);

  const SetRealTimeFactor::Response factor = node.setRealTimeFactor(2.0);
  EXPECT_FALSE(factor.success);
  EXPECT_NE(factor.message.find("~clock_mode is follow"), std::string::npos) << factor.message;

  dynamic_reconfigure::Reconfigure::Request looks;
  looks.config.strs.resize(1);
  looks.config.strs[0].name = "marker_style";
  looks.config.strs[0].value = "line";
  const auto changed = node.call<dynamic_reconfigure::Reconfigure>("set_parameters", looks).config;
  EXPECT_TRUE(std::any_of(changed.strs.begin(), changed.strs.end(), [](const auto& parameter) {
    return parameter.name == "marker_style" && parameter.value == "line";
  }));

  // Back in time: one node begins anew, with another bag; the other goes on from where it is.
  StartRecording::Request start;
  start.file = "follow_" + std::to_string(getpid()) + ".bag";
  const StartRecording::Response first = node.call<StartRecording>("start_recording", start);
  ASSERT_TRUE(first.success) << first.message;
  const std::uint64_t reached =
      ignoring.waitForStatus("the time", [](const Status& s) { return s.header.stamp.toSec() == 1010.5; }).step_index;
  node.countReset();
  say(50.0);
  EXPECT_EQ(node.state(0).header.stamp.toSec(), 50.0);
  say(50.5);
  EXPECT_EQ(node.state(1).header.stamp.toSec(), 50.5);
  EXPECT_EQ(node.waitForStatus("step 1", [](const Status& s) { return s.step_index == 1; }).epoch, 1u);
  EXPECT_EQ(ignoring.state(reached + 1).header.stamp.toSec(), 50.5);
  EXPECT_EQ(ignoring.waitForStatus("a step", [&](const Status& s) { return s.step_index == reached + 1; }).epoch, 0u);

  const StopRecording::Response second = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(second.success) << second.message;
  EXPECT_NE(second.path, first.path);
  for (const std::string& path : {first.path, second.path}) {
    const rosbag::Bag bag(path);
    ros::Time last;
    for (const OrganState& state : readTopic<OrganState>(bag, "/resetting/sensory_growth/organs/shoot/state")) {
      EXPECT_GT(state.header.stamp, last);
      EXPECT_EQ(state.epoch, path == first.path ? 0u : 1u);
      last = state.header.stamp;
    }
    EXPECT_FALSE(last.isZero());
    std::filesystem::remove(path);
  }
}

TEST_F(Follow, DiagnosticsNameTheOwnerOfTheClock) {
  DiagnosticsListener diagnostics;
  EXPECT_EQ(diagnostics.waitFor("clock", "following"), "following the /clock of " + ros::this_node::getName());
}

}  // namespace
}  // namespace sensory_growth::node::testing
