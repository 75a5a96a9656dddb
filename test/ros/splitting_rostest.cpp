/// A recording begins, is split and ends while the simulation steps freely: no step is lost, and each part replays.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "ros/bag_contents.h"
#include "ros/node_under_test.h"
#include "ros/replays.h"

namespace sensory_growth::node::testing {
namespace {

TEST(Splitting, LosesNoStepWhileTheSimulationRuns) {
  constexpr std::uint64_t kSteps = 20;  // at least, in each part
  NodeUnderTest node;
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 10);
  const auto run_on = [&](std::uint64_t step) {
    node.waitForStatus("steps", [&](const Status& s) { return s.step_index >= step + kSteps; });
  };
  ASSERT_TRUE(node.command("resume").success);
  run_on(0);
  StartRecording::Request start;
  start.file = "split_" + std::to_string(getpid()) + ".bag";
  const StartRecording::Response started = node.call<StartRecording>("start_recording", start);
  ASSERT_TRUE(started.success) << started.message;
  std::vector<std::string> parts{started.path};
  std::vector<std::uint64_t> begins{started.step_index};
  for (const double strength : {0.5, 1.0}) {
    run_on(begins.back());
    node.send(lights, light(LightDirection::ADD, "sun", {strength, 0.0, 1.0}, strength));
    const SplitRecording::Response split = node.call<SplitRecording>("split_recording");
    ASSERT_TRUE(split.success) << split.message;
    parts.push_back(split.path);
    begins.push_back(split.step_index);
  }
  run_on(begins.back());
  const StopRecording::Response stopped = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(stopped.success) << stopped.message;
  ASSERT_TRUE(node.command("pause").success);
  begins.push_back(stopped.step_index);

  for (std::size_t part = 0; part < parts.size(); ++part) {
    {
      const rosbag::Bag bag(parts[part]);  // throws unless closed and indexed
      const auto states = readTopic<OrganState>(bag, "/sensory_growth/organs/shoot/state");
      ASSERT_EQ(states.size(), begins[part + 1] - begins[part] + 1) << parts[part];
      for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(states[i].step_index, begins[part] + i) << parts[part];
    }
    EXPECT_TRUE(replays(parts[part])) << parts[part];
    std::filesystem::remove(parts[part]);
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
