/// However many commands are taken before a bag begins, it begins with few, and replays alone.

#include <gmock/gmock.h>

#include "batch/bags.h"
#include "batch/command_line.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/ros/loaded_scenario.h"
#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/ros/run.h"

namespace sensory_growth::batch::testing {
namespace {

using ::testing::HasSubstr;

using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;

constexpr std::size_t kMostBytes = 4500 * 1000;  // of commands that a bag begins with

/// Says nothing but to bags.
class Silent : public node::Reporter {
 public:
  using Reporter::Reporter;

 private:
  void open(const Topic&) override {}
  void close(const Topic&) override {}
  void publish(const Topic&, const node::Message&) override {}
  void warn(const node::RecordingSummary&) override {}
  void warnOfSize(const std::string&) override {}
};

class LongHistory : public InFolder {
 protected:
  LongHistory() : reporter_(parameters_, loaded_.sources, counters_, [](const auto& name) { return "/n/" + name; }) {
    EXPECT_TRUE(problems_.empty());
  }

  void takeSteps(int steps) {
    for (int i = 0; i < steps; ++i) {
      EXPECT_TRUE(run_.step().ok);
      showStatus();
    }
  }

  /// Puts the lamp `x` away from the organ, or refuses to.
  void moveLamp(StimulusOperation operation, const std::string& id, double x) {
    run_.apply(StimulusCommand{StimulusKind::point_source, operation, id, {x, 0.0, 0.05}, 0.75});
    showStatus();
  }

  /// Records some steps with a command among them; returns how many bytes of commands the bag holds.
  std::size_t record(const std::string& file) {
    EXPECT_EQ(reporter_.startRecording(file, *run_.snapshot()), std::nullopt);
    showStatus();
    takeSteps(2);
    moveLamp(StimulusOperation::change, "lamp", -0.07);
    takeSteps(3);
    EXPECT_EQ(reporter_.takeRecording()->finish().error, "");
    std::size_t bytes = 0;
    for (const AppliedCommand& command : readTopic<AppliedCommand>(rosbag::Bag(path(file)), "/n/applied_commands")) {
      bytes += ros::serialization::serializationLength(command);
    }
    return bytes;
  }

  node::Parameters parameters() const {
    node::Parameters parameters;
    parameters.scenario = kShoot;
    parameters.growth_time_scale = 60.0;
    parameters.recording_directory = folder_;
    parameters.recording_minimum_free_space = 0.0;
    return parameters;
  }

  void showStatus() { reporter_.onStatus({}, *run_.snapshot()); }

  std::vector<std::string> problems_;
  const node::Parameters parameters_ = parameters();
  node::LoadedScenario loaded_ = node::loadScenario(parameters_, "/n", problems_);
  node::StimulusCounters counters_;
  Silent reporter_;
  std::int32_t ticks_ = 0;
  node::Run run_{simulation::Simulation(loaded_.scenario), [this] { return ros::Time(++ticks_, 0); }, counters_,
                 reporter_};
};

TEST_F(LongHistory, OfStimuliIsReplacedByACheckpoint) {
  moveLamp(StimulusOperation::add, "lamp", 0.05);
  takeSteps(2);
  for (int i = 0; i < 50000; ++i) {
    moveLamp(StimulusOperation::change, i % 2 == 0 ? "lamp" : "nobody", 0.04 + 1e-7 * i);
    if (i % 5000 == 0) takeSteps(1);
  }
  EXPECT_LT(record("run.bag"), kMostBytes);
  const Outcome outcome = call({"replay", path("run.bag")});
  EXPECT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(": all 6 states compared are equal"));  // from step 12 to 17
}

TEST_F(LongHistory, OfLongCommandsIsReplacedToo) {
  moveLamp(StimulusOperation::add, "lamp", 0.05);
  for (int i = 0; i < 50; ++i) run_.apply(simulation::SpawnCommand{std::string(100000, 'x')});  // refused
  takeSteps(1);
  EXPECT_LT(record("run.bag"), kMostBytes);
  EXPECT_EQ(call({"replay", path("run.bag")}).code, kOk);
}

TEST_F(LongHistory, OfThatLengthIsForgottenByAReset) {
  for (int i = 0; i < 50; ++i) run_.apply(simulation::SpawnCommand{std::string(100000, 'x')});
  run_.reset();
  moveLamp(StimulusOperation::add, "lamp", 0.05);
  takeSteps(1);
  EXPECT_LT(record("run.bag"), 1000u);  // the two of the lamp
  const Outcome outcome = call({"replay", path("run.bag")});
  EXPECT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("equal; 6 steps"));  // from step 0
}

}  // namespace
}  // namespace sensory_growth::batch::testing
