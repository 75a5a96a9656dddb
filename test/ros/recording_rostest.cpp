/// A recorded bag is complete: what started the run, what was done to it, and every state.

#include <gtest/gtest.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "ros/bag_contents.h"
#include "ros/marker_lint.h"
#include "ros/node_under_test.h"
#include "sensory_growth/ros/conversions.h"

namespace sensory_growth::node::testing {
namespace {

std::string textOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(Recording, HoldsEverythingThatIsNeededToRunTheSameAgain) {
  constexpr std::uint64_t kSteps = 30;
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);

  // Before recording starts: it must be in the bag all the same.
  node.send(lamps, lamp(PointSource::ADD, "early", {0.1, 0.0, 0.1}));
  ASSERT_TRUE(node.setParameter("shoot", "sensitivities.light_direction", 0.6).success);

  StartRecording::Request start;
  start.file = "complete_" + std::to_string(getpid()) + ".bag";
  const StartRecording::Response started = node.call<StartRecording>("start_recording", start);
  ASSERT_TRUE(started.success) << started.message;
  EXPECT_TRUE(std::filesystem::exists(started.path + ".active"));
  EXPECT_EQ(node.waitForStatus("recording", [](const Status& s) { return !s.recording.empty(); }).recording,
            started.path);

  node.stepTo(10, 0);
  node.send(lamps, lamp(PointSource::ADD, "late", {-0.1, 0.0, 0.1}, 2.0));
  node.send(lamps, lamp(PointSource::CHANGE, "nobody", {-0.1, 0.0, 0.1}));
  node.stepTo(kSteps, 10);

  const StopRecording::Response stopped = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(stopped.success) << stopped.message;
  EXPECT_EQ(stopped.path, started.path);
  EXPECT_FALSE(std::filesystem::exists(stopped.path + ".active"));

  const rosbag::Bag bag(stopped.path);  // throws unless closed and indexed
  rosbag::View all(bag);
  EXPECT_EQ(all.size(), stopped.messages);
  EXPECT_GT(all.getBeginTime(), ros::TIME_MIN);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    EXPECT_NE(connection->topic, "/clock");
    // Topics are numbered in the order of their first message; a view does not keep that order within equal stamps.
    EXPECT_EQ(connection->id == 0, connection->topic == "/sensory_growth/parameters") << connection->topic;
  }

  const auto states = readTopic<OrganState>(bag, "/sensory_growth/organs/shoot/state");
  ASSERT_EQ(states.size(), kSteps + 1);
  for (std::uint64_t step = 0; step <= kSteps; ++step) {
    EXPECT_EQ(states[step].step_index, step);
    EXPECT_EQ(states[step].positions, node.state(step).positions);
  }

  const auto scenarios = readTopic<std_msgs::String>(bag, "/sensory_growth/scenario");
  ASSERT_EQ(scenarios.size(), 1u);
  EXPECT_EQ(scenarios[0].data, textOf(scenarioFile()));
  const auto parameters = readTopic<std_msgs::String>(bag, "/sensory_growth/parameters");
  ASSERT_EQ(parameters.size(), 1u);
  EXPECT_NE(parameters[0].data.find("growth_time_scale: 60\n"), std::string::npos);
  EXPECT_NE(parameters[0].data.find("version: "), std::string::npos);

  const auto applied = readTopic<AppliedCommand>(bag, "/sensory_growth/applied_commands");
  ASSERT_EQ(applied.size(), 4u);
  EXPECT_EQ(applied[0].id, "early");
  EXPECT_EQ(applied[0].step_index, 0u);
  EXPECT_EQ(applied[1].kind, AppliedCommand::PARAMETER);
  EXPECT_EQ(applied[1].id, "shoot");
  EXPECT_EQ(applied[1].parameter, "sensitivities.light_direction");
  EXPECT_EQ(applied[1].value, 0.6);
  EXPECT_EQ(applied[2].id, "late");
  EXPECT_EQ(applied[2].step_index, 10u);
  EXPECT_EQ(applied[2].strength, 2.0);
  EXPECT_EQ(applied[3].id, "nobody");
  EXPECT_FALSE(applied[3].accepted);
  const auto stimuli = readTopic<Stimuli>(bag, "/sensory_growth/stimuli");
  ASSERT_FALSE(stimuli.empty());
  EXPECT_EQ(stimuli.front().point_sources.size(), 1u);  // in force when recording began
  EXPECT_EQ(stimuli.back().point_sources.size(), 2u);

  const auto transforms = readTopic<tf2_msgs::TFMessage>(bag, "/tf");
  ASSERT_EQ(transforms.size(), kSteps + 1);
  EXPECT_EQ(transforms[0].transforms[0].child_frame_id, "shoot/tip");
  const auto fixed = readTopic<tf2_msgs::TFMessage>(bag, "/tf_static");
  ASSERT_EQ(fixed.size(), 1u);
  EXPECT_EQ(fixed[0].transforms[0].child_frame_id, "shoot/base");

  const auto markers = readTopic<visualization_msgs::MarkerArray>(bag, "/sensory_growth/markers");
  ASSERT_EQ(markers.size(), kSteps + 1);
  for (const auto& array : markers) EXPECT_EQ(lint(array), std::vector<std::string>());
  EXPECT_GE(readTopic<Status>(bag, "/sensory_growth/status").size(), kSteps);

  std::filesystem::remove(stopped.path);
}

TEST(Recording, ReplaysToTheSameNumbers) {
  NodeUnderTest node;
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 10);
  ASSERT_TRUE(node.command("reset").success);
  node.countReset();

  StartRecording::Request start;
  start.file = "replay_" + std::to_string(getpid()) + ".bag";
  ASSERT_TRUE(node.call<StartRecording>("start_recording", start).success);
  node.stepTo(7, 0);
  node.send(lights, light(LightDirection::ADD, "sun", {1.0, 2.0, 0.5}, 0.9));
  ASSERT_TRUE(node.setGravity({0.0, 5.0, -5.0}).success);
  ASSERT_TRUE(node.setParameter("all", "growth.rate", 2e-5).success);
  node.stepTo(25, 7);
  const StopRecording::Response stopped = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(stopped.success) << stopped.message;

  // From the bag alone.
  const rosbag::Bag bag(stopped.path);
  const auto scenario = readTopic<std_msgs::String>(bag, "/sensory_growth/scenario");
  const auto applied = readTopic<AppliedCommand>(bag, "/sensory_growth/applied_commands");
  ASSERT_EQ(scenario.size(), 1u);
  ASSERT_EQ(applied.size(), 3u);
  simulation::Simulation replay(simulation::parseScenario(scenario[0].data, "bag"));
  const auto states = readTopic<OrganState>(bag, "/sensory_growth/organs/shoot/state");
  ASSERT_EQ(states.size(), 26u);
  for (const OrganState& state : states) {
    if (state.step_index > 0) {
      ASSERT_TRUE(replay.step().ok);
    }
    expectSame(state, replay);
    for (const AppliedCommand& command : applied) {
      if (command.step_index == state.step_index) replay.apply(toCommand(command).value());
    }
  }
  std::filesystem::remove(stopped.path);
}

}  // namespace
}  // namespace sensory_growth::node::testing
