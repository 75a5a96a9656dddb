/// 20 000 stimuli a second do not make the simulation late, nor the node large.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <thread>
#include <utility>

#include "ros/message_log.h"
#include "ros/process_fixture.h"
#include "support/sanitizer.h"

namespace sensory_growth::node::testing {
namespace {

using namespace std::chrono_literals;
using support::kHasSanitizer;

constexpr int kLamps = 8;
constexpr double kPromisedRate = 1e4;             // stimuli that do no harm [1/s]
constexpr std::size_t kSlack = 64 * 1024 * 1024;  // by which memory in use may grow [byte]

/// Memory in use by a process [byte].
std::size_t residentMemory(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return 1024 * std::stoul(line.substr(6));
  }
  return 0;
}

/// Stimuli, numbered from 0.
using Make = std::function<PointSource(std::uint64_t number)>;

std::string idOf(std::uint64_t number) { return "lamp_" + std::to_string(number % kLamps); }

/// Adds lamps and moves them in turn.
PointSource movingLamp(std::uint64_t number) {
  return lamp(PointSource::ADD, idOf(number), {0.1 + 1e-9 * static_cast<double>(number), 0.0, 0.1});
}

PointSource malformed(std::uint64_t number) { return lamp(PointSource::ADD, idOf(number), {NAN, 0.0, 0.1}); }

PointSource removalOfNothing(std::uint64_t number) {
  return lamp(PointSource::REMOVE, "no_" + idOf(number), rod::Vector3::Zero());
}

PointSource inAnUnknownFrame(std::uint64_t number) {
  PointSource lost = lamp(PointSource::ADD, "lost_" + std::to_string(number), {0.1, 0.0, 0.1});
  lost.header.frame_id = "nowhere";
  return lost;
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Sends stimuli at twice the rate that is promised to do no harm, on a thread of its own, until it is destroyed.
class Flood {
 public:
  Flood(NodeUnderTest& node, Make make)
      : publisher_(node.handle().advertise<PointSource>("point_source", 1000)), make_(std::move(make)) {
    node.publish(publisher_, make_(0));  // waits for the connection
    thread_ = std::thread([this] {
      while (!ends_) {
        if (rate() < kSentRate) {
          publisher_.publish(make_(sent_++));
        } else {
          std::this_thread::sleep_for(1ms);
        }
      }
    });
  }
  ~Flood() {
    ends_ = true;
    thread_.join();
  }

  std::uint64_t sent() const { return sent_; }
  double rate() const { return static_cast<double>(sent_) / secondsSince(begin_); }

 private:
  static constexpr double kSentRate = 2.0 * kPromisedRate;

  ros::Publisher publisher_;
  const Make make_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Wall time that a paced run takes to a step [s]; it begins and ends paused.
double secondsTo(std::uint64_t step, NodeUnderTest& node) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(node.command("resume").success);
  node.waitForStatus("steps", [&](const Status& s) { return s.mode == Status::RUNNING && s.step_index >= step; });
  const double seconds = secondsSince(begin);
  EXPECT_TRUE(node.command("pause").success);
  return seconds;
}

std::uint64_t received(const Status& status) { return status.stimuli_accepted + status.stimuli_refused; }

std::size_t countOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(Process, AFloodWhileSteppingLeavesOneChangeOfEachLampInAStep) {
  constexpr std::uint64_t kSteps = kHasSanitizer ? 200 : 3000, kWarm = kSteps / 10;
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
    Flood flood(node, movingLamp);
    ASSERT_TRUE(node.step(kWarm).success);
    before = residentMemory(child.pid());
    const Step::Response stepped = node.step(kSteps);
    EXPECT_TRUE(stepped.success) << stepped.message;
    EXPECT_EQ(stepped.step_index, kWarm + kSteps);
    sent = flood.sent();
    if (!kHasSanitizer) {
      EXPECT_GT(flood.rate(), kPromisedRate);
    }
  }
  const std::size_t after = residentMemory(child.pid());
  EXPECT_GT(before, 0u);
  if (!kHasSanitizer) {
    EXPECT_LT(after, before + kSlack);
  }

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

TEST_F(Process, AFloodOfAnyKindLeavesPaceMemoryLogAndServices) {
  constexpr std::uint64_t kSteps = 30;
  constexpr double kStepsPerSecond = 20.0;    // what the factor makes of steps of 1 s
  constexpr double kRefreshesPerSecond = 20;  // of ~status because stimuli were refused
  constexpr double kManyTimes = 4.0;          // a run that is not bounded would never get there
  set("real_time_factor", kStepsPerSecond);
  set("start_paused", true);
  ChildProcess child = start();
  NodeUnderTest node(name_);
  MessageLog<Status> statuses(name_ + "/status");
  const auto begin = std::chrono::steady_clock::now();
  const double alone = secondsTo(kSteps, node);

  const struct {
    const char* name;
    Make make;
    bool is_seen_by_simulation;
  } kinds[] = {{"lamps that move", movingLamp, true},
               {"malformed", malformed, false},
               {"removals of nothing", removalOfNothing, true},
               {"in an unknown frame", inAnUnknownFrame, false}};
  std::size_t before = 0;
  for (const auto& kind : kinds) {
    SCOPED_TRACE(kind.name);
    ASSERT_TRUE(node.command("reset").success);
    node.waitForStatus("step 0", [](const Status& s) { return s.mode == Status::PAUSED && s.step_index == 0; });
    const Flood flood(node, kind.make);

    statuses.forget();
    const auto running = std::chrono::steady_clock::now();
    const double flooded = secondsTo(kSteps, node);
    if (!kHasSanitizer) {
      EXPECT_LT(flooded, kManyTimes * alone);
    }
    if (!kind.is_seen_by_simulation) {
      EXPECT_LT(statuses.all().size(), 2 * kSteps + 2 * kRefreshesPerSecond * secondsSince(running));
    }

    const Status paused = node.waitForStatus("paused", [](const Status& s) { return s.mode == Status::PAUSED; });
    node.waitForStatus("stimuli", [&](const Status& s) { return received(s) > received(paused) + 100; });
    const Step::Response stepped = node.step(5);
    EXPECT_EQ(stepped.step_index, paused.step_index + 5) << stepped.message;
    if (!kHasSanitizer) {
      EXPECT_GT(flood.rate(), kPromisedRate);
    }
    if (before == 0) before = residentMemory(child.pid());
  }
  EXPECT_GT(before, 0u);
  if (!kHasSanitizer) {
    EXPECT_LT(residentMemory(child.pid()), before + kSlack);
  }

  child.signal(SIGINT);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
  for (const char* warning : {"stimulus refused (", "command refused ("}) {
    const std::size_t lines = countOf(warning, child.printed());
    EXPECT_GE(lines, 1u) << warning;
    EXPECT_LE(static_cast<double>(lines), secondsSince(begin) + 1.0) << warning;  // one a second
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
