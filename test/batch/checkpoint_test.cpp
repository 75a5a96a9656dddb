/// Runs that go on from checkpoints, on the command line and in bags.

#include <gmock/gmock.h>

#include <map>

#include "batch/bags.h"
#include "batch/command_line.h"
#include "sensory_growth/Checkpoint.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/batch/batch_run.h"
#include "sensory_growth/ros/checkpoint_file.h"

namespace sensory_growth::batch::testing {
namespace {

using ::testing::HasSubstr;

using simulation::GravityCommand;
using simulation::ParameterCommand;
using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;

constexpr char kProtocol[] =
    "name: evening\n"
    "protocol:\n"
    "  - {at: 0 min, add: {point_source: {id: lamp, position: [5 cm, 0 cm, 5 cm], strength: 1}}}\n"
    "  - {at: 5 min, set: {parameter: {organ: shoot, name: sensitivities.gravity, value: 0.2}}}\n"
    "  - {at: 7 min, set: {gravity: {direction: [1, 0, -1], acceleration: 9.81 m/s^2}}}\n"
    "  - {at: 9 min, remove: {point_source: {id: lamp}}}\n";

class CheckpointTest : public InFolder {
 protected:
  /// Of every state in a bag, by step.
  std::map<std::uint64_t, std::uint64_t> checksums(const std::string& bag) const {
    std::map<std::uint64_t, std::uint64_t> sums;
    for (const Status& status : readTopic<Status>(rosbag::Bag(path(bag)), "/sensory_growth/status")) {
      sums[status.step_index] = status.checksum;
    }
    return sums;
  }
};

TEST_F(CheckpointTest, GoesOnAsIfItHadNeverStopped) {
  const std::string protocol = write("evening.yaml", kProtocol);
  ASSERT_EQ(call({"run", kShoot, "--protocol", protocol, "--duration", "12 min", "--bag", path("whole.bag")}).code,
            kOk);
  ASSERT_EQ(call({"run", kShoot, "--protocol", protocol, "--duration", "7 min", "--save-checkpoint",
                  path("folder/seven.checkpoint")})
                .code,
            kOk);
  const Outcome rest = call({"run", "--from", path("folder/seven.checkpoint"), "--duration", "12 min", "--bag",
                             path("rest.bag"), "--save-checkpoint", path("twelve.checkpoint")});
  ASSERT_EQ(rest.code, kOk) << rest.err;
  EXPECT_THAT(rest.out, HasSubstr("test_shoot: 5 steps, 0.2 h of growth"));

  auto whole = checksums("whole.bag");
  whole.erase(whole.begin(), whole.find(7));
  EXPECT_EQ(checksums("rest.bag"), whole);
  EXPECT_EQ(node::readCheckpoint(path("twelve.checkpoint")).state.step_index, 12u);
  EXPECT_EQ(node::readCheckpoint(path("twelve.checkpoint")).protocol, kProtocol);
}

TEST_F(CheckpointTest, IsInTheBagOfARunThatBeganWithOneSoThatItReplays) {
  ASSERT_EQ(call({"run", kShoot, "--protocol", write("evening.yaml", kProtocol), "--duration", "6 min",
                  "--save-checkpoint", path("six.checkpoint")})
                .code,
            kOk);
  ASSERT_EQ(call({"run", "--from", path("six.checkpoint"), "--duration", "12 min", "--bag", path("run.bag")}).code,
            kOk);
  std::filesystem::remove(path("six.checkpoint"));
  const Outcome outcome = call({"replay", path("run.bag"), "--bag", path("again.bag")});
  EXPECT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("all 7 states compared are equal; 6 steps"));
  EXPECT_EQ(contentsOf(path("run.bag")), contentsOf(path("again.bag")));
}

/// What somebody might do to a node: it goes on twice from a checkpoint of another scenario, and is reset.
class RunWithLoads : public CheckpointTest {
 protected:
  void record() {
    std::string other = textOf(kShoot);
    other.replace(other.find("gravity: 0.4"), 12, "gravity: 0.9");
    ASSERT_EQ(call({"run", write("other.yaml", other), "--protocol", write("evening.yaml", kProtocol), "--duration",
                    "4 min", "--save-checkpoint", path("four.checkpoint")})
                  .code,
              kOk);
    node::Parameters parameters;
    parameters.scenario = kShoot;
    parameters.growth_time_scale = 60.0;
    recordTo(path("run.bag"), parameters);
    std::vector<std::string> problems;
    BatchRun run(parameters, node::loadScenario(parameters, "/sensory_growth", problems), [](const auto&) {});
    ASSERT_TRUE(problems.empty());
    takeSteps(run, 3);
    run.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "mine", {0.05, 0.0, 0.05}, 0.75});
    takeSteps(run, 2);
    const simulation::Checkpoint checkpoint = node::readCheckpoint(path("four.checkpoint"));
    for (int i = 0; i < 2; ++i) {
      run.load(node::parseScenario(parameters, "/sensory_growth", "", checkpoint, problems).scenario, checkpoint);
      takeSteps(run, 2);
      run.apply(ParameterCommand{"shoot", "growth.rate", 1e-4});
      takeSteps(run, 3);
    }
    run.reset();
    takeSteps(run, 2);
    run.apply(GravityCommand{{0.0, 3.0, -9.0}});
    takeSteps(run, 4);
    EXPECT_EQ(run.finish()->error, "");
  }

  static void takeSteps(BatchRun& run, int steps) {
    for (int i = 0; i < steps; ++i) EXPECT_EQ(run.step(), std::nullopt);
  }
};

TEST_F(RunWithLoads, ReplaysFromItsBagAlone) {
  record();
  std::filesystem::remove(path("four.checkpoint"));
  EXPECT_EQ(readTopic<Checkpoint>(rosbag::Bag(path("run.bag")), "/sensory_growth/checkpoint").size(), 2u);
  const Outcome outcome = call({"replay", path("run.bag"), "--bag", path("again.bag"), "--threads", "2"});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(": all 25 states compared are equal; 21 steps"));  // 0 to 5, 4 to 9 twice, 0 to 6
  EXPECT_EQ(contentsOf(path("run.bag")), contentsOf(path("again.bag")));
}

TEST_F(RunWithLoads, DoesNotReplayIfItsCheckpointWasAltered) {
  record();
  {
    const rosbag::Bag original(path("run.bag"));
    rosbag::Bag copy(path("altered.bag"), rosbag::bagmode::Write);
    rosbag::View view(original);
    for (const rosbag::MessageInstance& message : view) {
      if (const auto checkpoint = message.instantiate<Checkpoint>()) {
        checkpoint->data[checkpoint->data.size() / 2] ^= 1;
        copy.write(message.getTopic(), message.getTime(), *checkpoint, message.getConnectionHeader());
      } else {
        copy.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
      }
    }
  }
  const Outcome outcome = call({"replay", path("altered.bag")});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("the checkpoint of epoch 1 was altered: its checksum is another"));
}

TEST_F(CheckpointTest, IsRefusedWithWhatIsWrong) {
  ASSERT_EQ(call({"run", kShoot, "--duration", "2 min", "--save-checkpoint", path("two.checkpoint")}).code, kOk);
  const std::string bytes = textOf(path("two.checkpoint"));
  const std::string cut = write("cut.checkpoint", bytes.substr(0, bytes.size() / 2));
  const struct {
    std::vector<std::string> arguments;
    std::string message;
  } cases[] = {
      {{"run", kShoot, "--from", path("two.checkpoint")}, "[scenario,--from] is required"},
      {{"run", "--from", path("two.checkpoint"), "--protocol", kShoot}, "--protocol"},
      {{"run", "--from", path("absent.checkpoint")}, "absent.checkpoint"},
      {{"run", "--from", kShoot}, "is no checkpoint"},
      {{"run", "--from", cut}, "is cut off"},
      {{"run", kShoot, "--save-checkpoint", path("two.checkpoint")}, "exists already"},
      {{"run", kShoot, "--save-checkpoint", path("two.bag")}, "must end in .checkpoint"},
  };
  for (const auto& wrong : cases) {
    const Outcome outcome = call(wrong.arguments);
    EXPECT_EQ(outcome.code, kBadInput) << wrong.message;
    EXPECT_THAT(outcome.err, HasSubstr(wrong.message));
  }
  EXPECT_EQ(textOf(path("two.checkpoint")), bytes);
}

}  // namespace
}  // namespace sensory_growth::batch::testing
