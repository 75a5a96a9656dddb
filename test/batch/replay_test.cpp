/// `sensory_growth_batch replay` and `export` of bags that were recorded with commands.

#include <gmock/gmock.h>
#include <std_msgs/String.h>

#include "batch/bags.h"
#include "batch/command_line.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/batch/batch_run.h"
#include "support/spawned_organ.h"

namespace sensory_growth::batch::testing {
namespace {

using ::testing::HasSubstr;

using simulation::GravityCommand;
using simulation::ParameterCommand;
using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;

class ReplayTest : public InFolder {
 protected:
  /// What somebody might do to a node while it runs.
  void SetUp() override {
    node::Parameters parameters;
    parameters.scenario = kShoot;
    parameters.protocol = write("protocol.yaml",
                                "name: light\n"
                                "protocol:\n"
                                "  - {at: 0 min, add: {light_direction: {id: sun, towards: [0, 1, 1], strength: 1}}}\n"
                                "  - {at: 5 min, remove: {light_direction: {id: sun}}}\n");
    parameters.growth_time_scale = 60.0;
    recordTo(path("run.bag"), parameters);
    std::vector<std::string> problems;
    node::LoadedScenario loaded = node::loadScenario(parameters, "/sensory_growth", problems);
    ASSERT_TRUE(problems.empty());
    BatchRun run(parameters, loaded, [](const node::Message&) {});
    takeSteps(run, 2);  // forgotten by the reset
    run.reset();
    takeSteps(run, 4);
    run.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.05, 0.0, 0.05}, 0.75});
    run.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::change, "nobody", {1.0, 0.0, 0.0}, 1.0});
    takeSteps(run, 1);  // the sun goes, too
    run.apply(ParameterCommand{"shoot", "sensitivities.gravity", 0.1});
    run.apply(GravityCommand{{0.0, 3.0, -9.0}});
    takeSteps(run, 2);
    run.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::remove, "lamp", {}, 0.0});
    takeSteps(run, 5);
    EXPECT_EQ(run.finish()->error, "");
  }

  static void takeSteps(BatchRun& run, int steps) {
    for (int i = 0; i < steps; ++i) EXPECT_EQ(run.step(), std::nullopt);
  }

  Outcome replayChanged(const std::function<void(AppliedCommand&, std::size_t)>& change) const {
    const std::string changed = path("changed.bag");
    std::filesystem::remove(changed);
    copyChanged(path("run.bag"), changed, change);
    return call({"replay", changed});
  }
};

const std::string kOrgan = support::organText("late");

// In epoch 0 the sun; in epoch 1 the sun, the lamp, nobody, the sun's end, the parameter, gravity and the lamp's end.
constexpr std::size_t kCommands = 8;
constexpr std::size_t kLamp = 2, kNobody = 3, kSunEnds = 4, kParameter = 5, kGravity = 6;

TEST_F(ReplayTest, IsEqualOnEveryStep) {
  const Outcome outcome = call({"replay", path("run.bag"), "--bag", path("again.bag"), "--threads", "2"});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(": all 16 states compared are equal; 14 steps"));  // 0 to 2 and 0 to 12
  const auto original = contentsOf(path("run.bag")), again = contentsOf(path("again.bag"));
  for (const auto& [topic, content] : original) EXPECT_TRUE(again.count(topic) && again.at(topic) == content) << topic;
  EXPECT_EQ(again.size(), original.size());
}

TEST_F(ReplayTest, IsEqualAlsoIfOrgansComeAndGoAndLampsFlash) {
  node::Parameters parameters;
  parameters.scenario = kShoot;
  parameters.growth_time_scale = 60.0;
  recordTo(path("organs.bag"), parameters);
  std::vector<std::string> problems;
  BatchRun run(parameters, node::loadScenario(parameters, "/sensory_growth", problems), [](const node::Message&) {});
  const auto set = [&](StimulusOperation operation, double start, double duration, double period) {
    run.apply(StimulusCommand{
        StimulusKind::point_source, operation, "flash", {0.05, 0.0, 0.05}, 0.75, {start, duration, period}});
  };
  set(StimulusOperation::add, 0.0, 60.0, 120.0);  // on at once
  takeSteps(run, 3);
  run.apply(simulation::SpawnCommand{kOrgan});
  takeSteps(run, 3);
  run.apply(simulation::SpawnCommand{kOrgan});  // refused
  set(StimulusOperation::change, 90.0, 60.0, 0.0);
  takeSteps(run, 5);
  run.apply(simulation::RemoveCommand{"shoot"});
  run.apply(simulation::RemoveCommand{"late"});
  run.apply(simulation::SpawnCommand{kOrgan});  // with frames that moved at the same stamp before
  takeSteps(run, 3);
  run.reset();
  takeSteps(run, 2);
  EXPECT_EQ(run.finish()->error, "");

  const Outcome outcome = call({"replay", path("organs.bag"), "--bag", path("again.bag"), "--csv", path("csv")});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(": all 18 states compared are equal"));  // 0 to 14 and 0 to 2
  EXPECT_EQ(contentsOf(path("organs.bag")), contentsOf(path("again.bag")));
}

TEST_F(ReplayTest, CanBeReplayed) {
  ASSERT_EQ(call({"replay", path("run.bag"), "--bag", path("again.bag")}).code, kOk);
  EXPECT_EQ(call({"replay", path("again.bag")}).code, kOk);
}

TEST_F(ReplayTest, FindsOneBitInAnyCommand) {
  EXPECT_EQ(readTopic<AppliedCommand>(rosbag::Bag(path("run.bag")), "/sensory_growth/applied_commands").size(),
            kCommands);
  const struct {
    std::size_t index;
    std::uint64_t step;
    std::function<void(AppliedCommand&)> change;
  } cases[] = {
      {kLamp, 4, [](AppliedCommand& c) { flipLastBit(c.strength); }},
      {kLamp, 4, [](AppliedCommand& c) { flipLastBit(c.vector.x); }},
      {kLamp, 4, [](AppliedCommand& c) { flipLastBit(c.vector.y); }},  // from 0 to the smallest number there is
      {kLamp, 4, [](AppliedCommand& c) { c.id[0] ^= 1; }},
      {kNobody, 4, [](AppliedCommand& c) { c.id[0] ^= 1; }},  // refused all the same, but in other words
      {kNobody, 4, [](AppliedCommand& c) { c.accepted = true; }},
      {kSunEnds, 5, [](AppliedCommand& c) { c.id[0] ^= 1; }},  // of the protocol
      {kParameter, 5, [](AppliedCommand& c) { flipLastBit(c.value); }},
      {kParameter, 5, [](AppliedCommand& c) { c.kind ^= 1; }},
      {kParameter, 5, [](AppliedCommand& c) { c.step_index ^= 1; }},  // a step too early, which shows in the next
      {kGravity, 5, [](AppliedCommand& c) { flipLastBit(c.vector.z); }},
      {kGravity, 5, [](AppliedCommand& c) { c.kind ^= 64; }},
  };
  for (std::size_t i = 0; i < std::size(cases); ++i) {
    const Outcome outcome = replayChanged([&](AppliedCommand& command, std::size_t index) {
      if (index == cases[i].index) cases[i].change(command);
    });
    EXPECT_EQ(outcome.code, kFault) << "case " << i;
    EXPECT_THAT(outcome.err, HasSubstr("differs first at step " + std::to_string(cases[i].step) + " of epoch 1: "))
        << "case " << i;
  }
}

TEST_F(ReplayTest, IgnoresTheWallTimeAtWhichCommandsCame) {
  EXPECT_EQ(replayChanged([](AppliedCommand& command, std::size_t) { command.header.stamp.nsec ^= 1; }).code, kOk);
}

TEST_F(ReplayTest, RefusesCommandsOfAStateThatIsNotThere) {
  const Outcome outcome = replayChanged([](AppliedCommand& command, std::size_t index) {
    if (index == kLamp) command.step_index ^= 1024;
  });
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("a command at step 1028 of epoch 1, but not that state"));
}

TEST_F(ReplayTest, FindsAnotherStateOrNone) {
  for (const bool is_removed : {false, true}) {
    const std::string changed = path(is_removed ? "removed.bag" : "altered.bag");
    {
      const rosbag::Bag original(path("run.bag"));
      rosbag::Bag copy(changed, rosbag::bagmode::Write);
      rosbag::View view(original);
      for (const rosbag::MessageInstance& message : view) {
        const auto status = message.instantiate<Status>();
        const bool is_meant = status && status->epoch == 1 && status->step_index == 9;
        if (is_meant && is_removed) continue;
        if (is_meant) {
          status->checksum ^= 1;
          copy.write(message.getTopic(), message.getTime(), *status, message.getConnectionHeader());
        } else {
          copy.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
        }
      }
    }
    const Outcome outcome = call({"replay", changed});
    EXPECT_EQ(outcome.code, kFault);
    EXPECT_THAT(outcome.err, HasSubstr("differs first at step 9 of epoch 1: "));
  }
}

TEST_F(ReplayTest, CanBeInterrupted) {
  const Outcome outcome = call({"replay", path("run.bag"), "--bag", path("part.bag")}, 6);
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_EQ(call({"replay", path("part.bag")}).code, kOk);
}

TEST_F(ReplayTest, WantsToKnowWhichNode) {
  EXPECT_EQ(call({"replay", path("run.bag"), "--node", "/sensory_growth"}).code, kOk);
  const Outcome outcome = call({"replay", path("run.bag"), "--node", "/other"});
  EXPECT_EQ(outcome.code, kBadInput);
  EXPECT_THAT(outcome.err, HasSubstr("no run of '/other', but of /sensory_growth"));
}

TEST_F(ReplayTest, RefusesBagsWithoutARun) {
  {
    rosbag::Bag bag(path("texts.bag"), rosbag::bagmode::Write);
    bag.write("/sensory_growth/scenario", ros::Time(1.0), std_msgs::String());
  }
  EXPECT_THAT(call({"replay", path("texts.bag")}).err, HasSubstr("holds no run"));
  {
    rosbag::Bag bag(path("status.bag"), rosbag::bagmode::Write);
    bag.write("/sensory_growth/status", ros::Time(1.0), Status());
  }
  EXPECT_THAT(call({"replay", path("status.bag")}).err, HasSubstr("holds no /sensory_growth/scenario"));
  const std::string whole = textOf(path("run.bag"));
  write("half.bag", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(call({"replay", path("half.bag")}).code, kBadInput);
}

TEST_F(ReplayTest, WritesTheFramesThatExportWrites) {
  ASSERT_EQ(call({"replay", path("run.bag"), "--csv", path("a"), "--vtk", path("a"), "--every", "3"}).code, kOk);
  const Outcome outcome = call({"export", path("run.bag"), "--csv", path("b"), "--vtk", path("b"), "--every", "3"});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("13 states"));  // those after the reset
  for (const char* file : {"shoot.csv", "shoot.vtk.series", "shoot_000000.vtk", "shoot_000012.vtk"}) {
    EXPECT_EQ(textOf(path("a") + "/" + file), textOf(path("b") + "/" + file)) << file;
    EXPECT_NE(textOf(path("b") + "/" + file), "") << file;
  }
}

}  // namespace
}  // namespace sensory_growth::batch::testing
