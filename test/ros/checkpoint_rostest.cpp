/// The node goes on from a checkpoint as if it had never stopped, or takes another way from there; what it refuses
/// leaves it untouched.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <map>

#include "ros/batch_process.h"
#include "ros/node_under_test.h"
#include "sensory_growth/Checkpoint.h"
#include "sensory_growth/LoadCheckpoint.h"
#include "sensory_growth/SaveCheckpoint.h"
#include "sensory_growth/ros/checkpoint_file.h"
#include "sensory_growth/simulation/checksum.h"

namespace sensory_growth::node::testing {
namespace {

using ::testing::HasSubstr;

using Checksums = std::map<std::uint64_t, std::uint64_t>;  // by step

class Checkpointing : public ::testing::Test {
 protected:
  /// Each test begins paused at step 0.
  Checkpointing() : lamps_(node_.handle().advertise<PointSource>("point_source", 10)) {
    EXPECT_TRUE(node_.command("pause").success);
    const auto reset = node_.command("reset");
    EXPECT_TRUE(reset.success);
    epoch_ = node_.waitForStatus("step 0", [&](const Status& s) { return s.header.stamp == reset.stamp; }).epoch;
  }
  ~Checkpointing() override {
    for (const std::filesystem::path& file : files_) std::filesystem::remove(file);
  }

  static std::string name(const std::string& what) { return what + "_" + std::to_string(getpid()) + ".checkpoint"; }

  /// Path of the file.
  std::filesystem::path save(const std::string& what) {
    SaveCheckpoint::Request request;
    request.file = name(what);
    const auto saved = node_.call<SaveCheckpoint>("save_checkpoint", request);
    EXPECT_TRUE(saved.success) << saved.message;
    files_.push_back(saved.message);
    return saved.message;
  }

  LoadCheckpoint::Response load(const std::string& file, bool keep_stimuli = false) {
    LoadCheckpoint::Request request;
    request.file = file;
    request.keep_stimuli = keep_stimuli;
    const auto loaded = node_.call<LoadCheckpoint>("load_checkpoint", request);
    if (loaded.success) ++epoch_;
    return loaded;
  }

  Status statusAt(std::uint64_t step) {
    return node_.waitForStatus("step " + std::to_string(step) + " of epoch " + std::to_string(epoch_),
                               [&](const Status& s) { return s.step_index == step && s.epoch == epoch_; });
  }

  /// Steps from one step to another, one at a time.
  Checksums stepAlong(std::uint64_t from, std::uint64_t to) {
    Checksums sums;
    for (std::uint64_t step = from + 1; step <= to; ++step) {
      const auto taken = node_.step(1);
      EXPECT_TRUE(taken.success) << taken.message;
      EXPECT_EQ(taken.step_index, step);
      sums[step] = statusAt(step).checksum;
    }
    return sums;
  }

  void disturb(double strength) {
    node_.send(lamps_, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.1}, strength));
    EXPECT_TRUE(node_.setParameter("shoot", "sensitivities.gravity", strength).success);
    EXPECT_TRUE(node_.setGravity({strength, 0.0, -9.0}).success);
  }

  NodeUnderTest node_;
  ros::Publisher lamps_;
  std::uint32_t epoch_ = 0;
  std::vector<std::filesystem::path> files_;
};

TEST_F(Checkpointing, GoesOnAsIfItHadNeverStopped) {
  stepAlong(0, 5);
  disturb(0.7);
  stepAlong(5, 10);
  disturb(0.3);  // the organ has not yet relaxed under its new weight
  const simulation::SimulationState saved = readCheckpoint(save("ten")).state;
  const simulation::Simulation alone(simulation::loadScenario(scenarioFile()), saved);
  const auto go_on = [&] {
    Checksums sums = stepAlong(10, 15);
    disturb(0.5);
    sums.merge(stepAlong(15, 20));
    return sums;
  };
  const Checksums first = go_on();
  const ros::Time before = statusAt(20).header.stamp;

  const auto loaded = load(name("ten"));
  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_EQ(loaded.step_index, 10u);
  EXPECT_GT(loaded.stamp, before);  // ROS time goes on
  const Status status = statusAt(10);
  EXPECT_EQ(status.checksum, simulation::checksum(alone));
  EXPECT_EQ(status.growth_time, 600.0);
  EXPECT_EQ(status.mode, Status::PAUSED);
  EXPECT_EQ(status.header.stamp, loaded.stamp);
  node_.waitForStimuli("those of step 10", [&](const Stimuli& s) {
    return s.epoch == epoch_ && s.step_index == 10 && s.point_sources.size() == 1 && s.point_sources[0].strength == 0.3;
  });
  EXPECT_EQ(go_on(), first);
}

TEST_F(Checkpointing, GoesOnInAnotherProcessWithoutAMaster) {
  stepAlong(0, 4);
  disturb(0.6);
  const std::filesystem::path file = save("four");
  stepAlong(4, 12);
  const std::filesystem::path last = std::filesystem::temp_directory_path() / name("twelve");
  files_.push_back(last);
  const BatchOutcome outcome = batch({"run", "--from", file, "--duration", "12 min", "--save-checkpoint", last});
  ASSERT_EQ(outcome.code, 0) << outcome.printed;
  save("also_twelve");
  EXPECT_EQ(simulation::encode(readCheckpoint(last)), simulation::encode(readCheckpoint(files_.back())));
}

TEST_F(Checkpointing, BranchesWithTheStimuliInForce) {
  stepAlong(0, 5);
  disturb(0.7);
  save("five");
  const Checksums with_lamp = stepAlong(5, 8);
  node_.send(lamps_, lamp(PointSource::ADD, "other", {-0.1, 0.0, 0.1}));

  ASSERT_TRUE(load(name("five"), true).success);
  const Stimuli kept = node_.waitForStimuli("both lamps", [&](const Stimuli& s) { return s.epoch == epoch_; });
  EXPECT_EQ(kept.step_index, 5u);
  EXPECT_EQ(kept.point_sources.size(), 2u);
  for (const auto& [step, sum] : stepAlong(5, 8)) EXPECT_NE(sum, with_lamp.at(step)) << step;

  ASSERT_TRUE(load(name("five"), false).success);
  EXPECT_EQ(stepAlong(5, 8), with_lamp);
}

TEST_F(Checkpointing, RefusalLeavesTheRunUntouched) {
  stepAlong(0, 3);
  const std::filesystem::path file = save("three");
  const Checksums first = stepAlong(3, 6);
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto write = [&](const std::string& what, const std::string& content) {
    files_.push_back(file.parent_path() / name(what));
    std::ofstream(files_.back(), std::ios::binary) << content;
    return name(what);
  };
  std::string altered = bytes, newer = bytes;
  altered[bytes.size() / 2] ^= 1;
  newer[9] = 2;
  simulation::Checkpoint renamed = readCheckpoint(file), finer = renamed, bent = renamed;
  renamed.scenario.replace(renamed.scenario.find("id: shoot"), 9, "id: other");
  finer.scenario.replace(finer.scenario.find("step: 1 min"), 11, "step: 30 s");
  bent.state.organs[0].moment.rod.bends[0].curvature.x() = NAN;

  ASSERT_TRUE(load(name("three")).success);  // in the middle of what follows, as good as at its beginning
  const Status before = statusAt(3);
  const struct {
    std::string file;
    std::string message;
  } cases[] = {
      {write("altered", altered), "was altered: its checksum is another"},
      {write("cut", bytes.substr(0, bytes.size() - 100)), "is cut off"},
      {write("newer", newer), "has format 2; this version of sensory_growth reads 1, a newer one is needed"},
      {write("text", "# a text"), "is no checkpoint"},
      {write("renamed", simulation::encode(renamed)), "organ 'shoot': comes from nowhere, or twice"},
      {write("finer", simulation::encode(finer)), "has steps of 30.000000 s of growth; this run has 60.000000 s"},
      {write("bent", simulation::encode(bent)), "bend 0 is none"},
      {name("absent"), "does not exist"},
      {"../" + name("three"), "without a directory"},
      {file, "without a directory"},
      {"three.bag", "must end in .checkpoint"},
  };
  for (const auto& wrong : cases) {
    const auto loaded = load(wrong.file);
    EXPECT_FALSE(loaded.success) << wrong.file;
    EXPECT_THAT(loaded.message, HasSubstr(wrong.message));
    EXPECT_EQ(loaded.step_index, 3u);
    EXPECT_EQ(loaded.stamp, before.header.stamp);
  }
  EXPECT_EQ(stepAlong(3, 6), first);

  SaveCheckpoint::Request again;
  again.file = name("three");
  const auto saved = node_.call<SaveCheckpoint>("save_checkpoint", again);
  EXPECT_FALSE(saved.success);
  EXPECT_THAT(saved.message, HasSubstr("exists already"));
}

TEST_F(Checkpointing, RecoversFromAFault) {
  stepAlong(0, 3);
  save("good");
  const Checksums first = stepAlong(3, 5);
  ASSERT_TRUE(node_.setParameter("shoot", "growth.rate", 1e6).success);
  EXPECT_FALSE(node_.step(1).success);
  node_.waitForStatus("the fault", [](const Status& s) { return s.mode == Status::FAULT; });
  ASSERT_TRUE(load(name("good")).success);
  EXPECT_EQ(statusAt(3).mode, Status::PAUSED);
  EXPECT_EQ(stepAlong(3, 5), first);
}

TEST_F(Checkpointing, AbortsALongStep) {
  save("start");
  auto long_step = std::async(std::launch::async, [this] { return node_.step(1000000); });
  node_.waitForStatus("a step", [&](const Status& s) { return s.step_index >= 1 && s.epoch == epoch_; });
  ASSERT_TRUE(load(name("start")).success);
  const Step::Response aborted = long_step.get();
  EXPECT_FALSE(aborted.success);
  EXPECT_THAT(aborted.message, HasSubstr("aborted by load_checkpoint"));
  statusAt(0);
}

TEST_F(Checkpointing, TellsWhatTheEpochBeganWith) {
  stepAlong(0, 2);
  const std::filesystem::path file = save("two");
  stepAlong(2, 4);
  ASSERT_TRUE(load(name("two")).success);
  const auto message = ros::topic::waitForMessage<Checkpoint>(node_.handle().resolveName("checkpoint"), node_.handle(),
                                                              ros::Duration(kPatience.count()));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->step_index, 2u);
  EXPECT_EQ(message->epoch, epoch_);
  EXPECT_EQ(std::string(message->data.begin(), message->data.end()), simulation::encode(readCheckpoint(file)));
}

class RecordedLoads : public Checkpointing {
 protected:
  void startRecording(const std::string& what) {
    StartRecording::Request start;
    start.file = what + "_" + std::to_string(getpid()) + ".bag";
    const auto started = node_.call<StartRecording>("start_recording", start);
    ASSERT_TRUE(started.success) << started.message;
    files_.push_back(started.path);
  }

  void expectReplay(const std::string& compared) {
    ASSERT_TRUE(node_.call<StopRecording>("stop_recording").success);
    const BatchOutcome outcome = batch({"replay", files_.back()});
    EXPECT_EQ(outcome.code, 0) << outcome.printed;
    EXPECT_THAT(outcome.printed, HasSubstr(compared));
  }

  void reset() {
    ASSERT_TRUE(node_.command("reset").success);
    ++epoch_;
  }
};

TEST_F(RecordedLoads, AreInABagThatWasOpenBefore) {
  startRecording("across");
  stepAlong(0, 4);
  disturb(0.7);
  ASSERT_TRUE(node_.setParameter("shoot", "growth.rate", 1e-4).success);
  const std::filesystem::path bag = files_.back();
  save("branch");
  stepAlong(4, 6);
  node_.send(lamps_, lamp(PointSource::ADD, "late", {-0.1, 0.0, 0.1}, 2.0));
  ASSERT_TRUE(load(name("branch"), true).success);
  stepAlong(4, 7);
  disturb(0.4);
  stepAlong(7, 9);
  reset();
  stepAlong(0, 3);
  files_.push_back(bag);
  expectReplay("all 17 states compared are equal");  // 0 to 6, 4 to 9, 0 to 3
}

TEST_F(RecordedLoads, AreInABagThatWasOpenedAfterwards) {
  stepAlong(0, 4);
  save("early");
  ASSERT_TRUE(load(name("early")).success);
  stepAlong(4, 6);
  disturb(0.4);  // before the recording
  stepAlong(6, 8);
  startRecording("late");
  stepAlong(8, 11);
  expectReplay("all 4 states compared are equal");
}

}  // namespace
}  // namespace sensory_growth::node::testing
