/// A reset that sends ROS time back: everything is said again, because listeners forget when time runs backwards.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>
#include <visualization_msgs/MarkerArray.h>

#include <filesystem>

#include "ros/bag_contents.h"
#include "ros/marker_lint.h"
#include "ros/message_log.h"
#include "ros/node_under_test.h"
#include "ros/replays.h"

namespace sensory_growth::node::testing {
namespace {

const ros::Time kFirstTick(1.0);  // a step of 60 s at a scale of 60

bool isFirst(const std_msgs::Header& header) { return header.stamp == kFirstTick; }

TEST(Rewind, EverythingIsSaidAgain) {
  NodeUnderTest node;
  MessageLog<rosgraph_msgs::Clock> clock("/clock");
  MessageLog<tf2_msgs::TFMessage> moving("/tf"), fixed("/tf_static");
  MessageLog<std_msgs::String> scenario("/sensory_growth/scenario"), protocol("/sensory_growth/protocol"),
      parameters("/sensory_growth/parameters");
  MessageLog<Stimuli> stimuli("/sensory_growth/stimuli");
  MessageLog<Status> status("/sensory_growth/status");
  MessageLog<OrganState> states("/sensory_growth/organs/shoot/state");
  MessageLog<visualization_msgs::MarkerArray> markers("/sensory_growth/markers");
  std::uint64_t step = 0;
  const auto take_a_step = [&] {
    node.stepTo(step + 1, step);
    ++step;
  };
  take_a_step();
  moving.connect(take_a_step);
  for (MessageLog<std_msgs::String>* text : {&scenario, &protocol, &parameters}) text->waitForCount(1);
  fixed.waitForCount(1);
  stimuli.waitForCount(1);
  states.waitForCount(1);
  markers.waitForCount(1);
  clock.waitFor("now",
                [step](const auto& message) { return message.clock.toSec() == 1.0 + static_cast<double>(step); });

  moving.forget();
  const auto reset = node.command("reset");
  ASSERT_TRUE(reset.success) << reset.message;
  EXPECT_EQ(reset.stamp, kFirstTick);
  node.countReset();

  clock.waitFor("the first tick", [](const auto& message) { return message.clock == kFirstTick; });
  moving.waitFor("the tip", [](const auto& message) { return isFirst(message.transforms.at(0).header); });
  fixed.waitForCount(2);
  scenario.waitForCount(2);
  protocol.waitForCount(2);
  parameters.waitForCount(2);
  stimuli.waitFor("stimuli", [](const auto& message) { return isFirst(message.header) && message.epoch == 1; });
  states.waitFor("the state", [](const auto& message) { return isFirst(message.header) && message.epoch == 1; });
  status.waitFor("the status", [](const auto& message) { return isFirst(message.header) && message.epoch == 1; });
  const auto drawn =
      markers.waitFor("markers", [](const auto& message) { return isFirst(message.markers.back().header); });
  EXPECT_EQ(lint(drawn), std::vector<std::string>());
  EXPECT_EQ(drawn.markers.front().action, visualization_msgs::Marker::DELETEALL);
  EXPECT_EQ(drawn.markers.back().action, visualization_msgs::Marker::ADD);

  // Time goes on from there, and the transforms with it.
  EXPECT_EQ(node.stepTo(1, 0).header.stamp.toSec(), 2.0);
  moving.waitFor("the tip", [](const auto& message) { return message.transforms.at(0).header.stamp.toSec() == 2.0; });
}

TEST(Rewind, EachTimeHasABagOfItsOwn) {
  NodeUnderTest node;
  ASSERT_TRUE(node.command("reset").success);
  node.countReset();
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);
  StartRecording::Request start;
  start.file = "rewound_" + std::to_string(getpid()) + ".bag";
  const StartRecording::Response before = node.call<StartRecording>("start_recording", start);
  ASSERT_TRUE(before.success) << before.message;
  node.stepTo(4, 0);
  ASSERT_TRUE(node.command("reset").success);
  node.countReset();
  node.stepTo(2, 0);
  node.send(lamps, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.1}));
  node.stepTo(6, 2);
  const SplitRecording::Response split = node.call<SplitRecording>("split_recording");  // and one by hand
  ASSERT_TRUE(split.success) << split.message;
  EXPECT_EQ(split.step_index, 6u);
  node.stepTo(9, 6);
  const StopRecording::Response stopped = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(stopped.success) << stopped.message;
  EXPECT_EQ(stopped.path, split.path);

  const std::string stem = before.path.substr(0, before.path.size() - std::string(".bag").size());
  const struct {
    std::string path;
    std::vector<std::uint64_t> steps;
  } parts[] = {
      {stem + ".bag", {0, 1, 2, 3, 4}}, {stem + "_1.bag", {0, 1, 2, 3, 4, 5, 6}}, {stem + "_2.bag", {6, 7, 8, 9}}};
  EXPECT_EQ(stopped.path, parts[2].path);
  for (const auto& part : parts) {
    {
      const rosbag::Bag bag(part.path);  // throws unless closed and indexed
      std::vector<std::uint64_t> steps;
      for (const auto& state : readTopic<OrganState>(bag, "/sensory_growth/organs/shoot/state")) {
        steps.push_back(state.step_index);
      }
      EXPECT_EQ(steps, part.steps) << part.path;
    }
    EXPECT_TRUE(replays(part.path)) << part.path;
    std::filesystem::remove(part.path);
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
