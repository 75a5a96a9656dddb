/// As many stimuli as the machine can send, while the simulation runs as fast as it can.

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "ros/process_fixture.h"

namespace sensory_growth::node::testing {
namespace {

using namespace std::chrono_literals;

constexpr int kLamps = 8;

/// Memory in use by a process [byte].
std::size_t residentMemory(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return 1024 * std::stoul(line.substr(6));
  }
  return 0;
}

/// Moves the lamps in turn, on a thread of its own, until it is destroyed.
class Flood {
 public:
  explicit Flood(NodeUnderTest& node) : publisher_(node.handle().advertise<PointSource>("point_source", 1000)) {
    for (int i = 0; i < kLamps; ++i) node.send(publisher_, next());  // also waits for the connection
    thread_ = std::thread([this] {
      while (!ends_) publisher_.publish(next());
    });
  }
  ~Flood() {
    ends_ = true;
    thread_.join();
  }

  std::uint64_t sent() const { return sent_; }

 private:
  PointSource next() {
    const std::uint64_t number = sent_++;
    const double x = 0.1 + 1e-9 * static_cast<double>(number);
    return lamp(PointSource::ADD, "lamp_" + std::to_string(number % kLamps), {x, 0.0, 0.1});
  }

  ros::Publisher publisher_;
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

TEST_F(Process, AFloodOfStimuliLeavesStepsAndMemoryBounded) {
  constexpr std::uint64_t kWarm = 300, kSteps = 3000;
  set("real_time_factor", 0.0);
  set("start_paused", true);
  set("recording_marker_every", 0);
  ChildProcess child = start();
  NodeUnderTest node(name_);
  StartRecording::Request start;
  start.file = "flood.bag";
  ASSERT_TRUE(node.call<StartRecording>("start_recording", start).success);

  std::uint64_t sent = 0;
  std::size_t before = 0;
  {
    Flood flood(node);
    ASSERT_TRUE(node.step(kWarm).success);
    before = residentMemory(child.pid());
    const Step::Response stepped = node.step(kSteps);
    EXPECT_TRUE(stepped.success) << stepped.message;
    EXPECT_EQ(stepped.step_index, kWarm + kSteps);
    sent = flood.sent();
  }
  const std::size_t after = residentMemory(child.pid());
  EXPECT_GT(before, 0u);
  EXPECT_LT(after, before + 64 * 1024 * 1024);

  const StopRecording::Response stopped = node.call<StopRecording>("stop_recording");
  ASSERT_TRUE(stopped.success) << stopped.message;
  const rosbag::Bag bag(stopped.path);
  std::map<std::uint64_t, std::map<std::string, int>> applied;  // by step and lamp
  std::uint64_t taken = 0;
  for (const AppliedCommand& command : readTopic<AppliedCommand>(bag, name_ + "/applied_commands")) {
    EXPECT_TRUE(command.accepted) << command.refusal;
    if (command.step_index == 0 || command.step_index == kWarm || command.step_index == kWarm + kSteps) continue;
    ++applied[command.step_index][command.id];  // between the calls of ~step what comes is applied at once
    ++taken;
  }
  for (const auto& [step, lamps] : applied) {
    for (const auto& [lamp, times] : lamps) EXPECT_EQ(times, 1) << lamp << " in step " << step;
  }
  EXPECT_GT(taken, kSteps / 10);  // it was a flood
  EXPECT_LE(taken, kLamps * (kWarm + kSteps));
  EXPECT_GT(sent, taken);
  EXPECT_EQ(readTopic<OrganState>(bag, name_ + "/organs/shoot/state").size(), kWarm + kSteps + 1);
  RecordProperty("messages_sent", static_cast<int>(sent));

  child.signal(SIGINT);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
}

}  // namespace
}  // namespace sensory_growth::node::testing
