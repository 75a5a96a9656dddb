/// `sensory_growth_batch run` from arguments to files.

#include <gmock/gmock.h>
#include <std_msgs/String.h>

#include <iomanip>

#include "batch/bags.h"
#include "batch/command_line.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/batch/batch_run.h"
#include "sensory_growth/simulation/checksum.h"
#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::batch::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

constexpr char kProtocol[] =
    "name: evening\n"
    "protocol:\n"
    "  - {at: 3 min, add: {point_source: {id: lamp, position: [5 cm, 0 cm, 5 cm], strength: 1}}}\n"
    "  - {at: 7 min, set: {gravity: {direction: [1, 0, -1], acceleration: 9.81 m/s^2}}}\n";

class RunTest : public InFolder {};

TEST_F(RunTest, RecordsWhatTheNodeRecords) {
  const Outcome outcome = call({"run", kShoot, "--protocol", write("evening.yaml", kProtocol), "--duration", "10 min",
                                "--bag", path("run.bag"), "--growth-time-scale", "120"});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("test_shoot: 10 steps, 0.167 h of growth in "), HasSubstr("run.bag: ")));
  EXPECT_FALSE(std::filesystem::exists(path("run.bag.active")));

  const auto contents = contentsOf(path("run.bag"));
  EXPECT_THAT(contents, UnorderedElementsAre(Key("/sensory_growth/scenario"), Key("/sensory_growth/protocol"),
                                             Key("/sensory_growth/stimuli"), Key("/sensory_growth/applied_commands"),
                                             Key("/sensory_growth/organs/shoot/state"), Key("/sensory_growth/markers"),
                                             Key("/tf"), Key("/tf_static")));
  EXPECT_EQ(contents.at("/sensory_growth/organs/shoot/state").messages.size(), 11u);
  EXPECT_EQ(contents.at("/sensory_growth/organs/shoot/state").latching, "1");
  EXPECT_EQ(contents.at("/sensory_growth/applied_commands").latching, "0");
  EXPECT_EQ(contents.at("/sensory_growth/markers").messages.size(), 11u);
  EXPECT_EQ(contents.at("/tf").messages.size(), 11u);

  const rosbag::Bag bag(path("run.bag"));
  const auto scenario = readTopic<std_msgs::String>(bag, "/sensory_growth/scenario");
  ASSERT_EQ(scenario.size(), 1u);
  EXPECT_EQ(scenario[0].data, textOf(kShoot));
  const auto statuses = readTopic<Status>(bag, "/sensory_growth/status");
  ASSERT_EQ(statuses.size(), 11u);
  simulation::Scenario alone_scenario = simulation::loadScenario(kShoot);
  alone_scenario.protocol = simulation::parseProtocol(kProtocol, "evening");
  simulation::Simulation alone(alone_scenario);
  const auto states = readTopic<OrganState>(bag, "/sensory_growth/organs/shoot/state");
  for (std::size_t step = 0; step <= 10; ++step) {
    if (step > 0) {
      ASSERT_TRUE(alone.step().ok);
    }
    EXPECT_EQ(statuses[step].step_index, step);
    EXPECT_EQ(statuses[step].checksum, simulation::checksum(alone)) << "step " << step;
    EXPECT_EQ(statuses[step].mode, step < 10 ? Status::RUNNING : Status::FINISHED);
    EXPECT_EQ(states[step].positions.back().x, alone.organs()[0].rod().vertices.back().position.x());
    // A tick of 60 s of growth lasts 0.5 s; the first state is one tick after zero.
    EXPECT_EQ(states[step].header.stamp, ros::Time(0.5 * static_cast<double>(step + 1)));
  }
  const auto applied = readTopic<AppliedCommand>(bag, "/sensory_growth/applied_commands");
  ASSERT_EQ(applied.size(), 2u);
  EXPECT_EQ(applied[0].step_index, 3u);
  EXPECT_EQ(applied[1].step_index, 7u);
  std::ostringstream checksum;
  checksum << "checksum " << std::hex << std::setw(16) << std::setfill('0') << statuses.back().checksum;
  EXPECT_THAT(outcome.out, HasSubstr(checksum.str()));
}

TEST_F(RunTest, GivesTheSameBagTwiceOnAnyNumberOfThreads) {
  const std::string scenario = "../config/dodder_and_host.yaml";
  for (const char* threads : {"1", "3"}) {
    const Outcome outcome = call({"run", scenario, "--duration", "20 min", "--threads", threads, "--bag",
                                  path(std::string("on_") + threads + ".bag")});
    ASSERT_EQ(outcome.code, kOk) << outcome.err;
  }
  EXPECT_EQ(contentsOf(path("on_1.bag")), contentsOf(path("on_3.bag")));
}

TEST_F(RunTest, WritesFramesWithoutABag) {
  const Outcome outcome = call(
      {"run", kShoot, "--duration", "4 min", "--csv", path("csv"), "--vtk", path("vtk"), "--every", "2", "--quiet"});
  ASSERT_EQ(outcome.code, kOk) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  simulation::Simulation alone(simulation::loadScenario(kShoot));
  std::ostringstream table;
  table << std::setprecision(17) << "frame,x,y,z\n";
  std::istringstream written(textOf(path("csv/shoot.csv")));
  std::string line;
  std::getline(written, line);
  EXPECT_EQ(line, "frame,x,y,z");
  for (int step = 0; step <= 4; ++step) {
    if (step > 0) {
      ASSERT_TRUE(alone.step().ok);
    }
    if (step % 2 != 0) continue;
    for (const rod::Vertex& vertex : alone.organs()[0].rod().vertices) {
      ASSERT_TRUE(std::getline(written, line));
      std::istringstream fields(line);
      std::string frame, x, y, z;
      std::getline(std::getline(std::getline(std::getline(fields, frame, ','), x, ','), y, ','), z, ',');
      EXPECT_EQ(frame, std::to_string(step));
      EXPECT_EQ(rod::Vector3(std::stod(x), std::stod(y), std::stod(z)), vertex.position);
    }
  }
  EXPECT_FALSE(std::getline(written, line));
  EXPECT_TRUE(std::filesystem::exists(path("vtk/shoot_000004.vtk")));
  EXPECT_TRUE(std::filesystem::exists(path("vtk/shoot.vtk.series")));
}

TEST_F(RunTest, InterruptedLeavesAClosedBag) {
  const Outcome outcome = call({"run", kShoot, "--bag", path("run.bag")}, 5);
  EXPECT_EQ(outcome.code, kInterrupted);
  EXPECT_THAT(outcome.out, HasSubstr("interrupted after 6 steps"));
  EXPECT_EQ(readTopic<OrganState>(rosbag::Bag(path("run.bag")), "/sensory_growth/organs/shoot/state").size(), 7u);
}

TEST_F(RunTest, SplitsABagIntoPartsThatReplay) {
  constexpr double kSize = 1e6;  // the smallest that a node takes
  node::Parameters parameters;
  parameters.scenario = kShoot;
  parameters.growth_time_scale = 60.0;
  parameters.recording_split_size = kSize;
  parameters.recording_compression = node::Compression::none;
  recordTo(path("run.bag"), parameters);
  std::vector<std::string> problems;
  BatchRun run(parameters, node::loadScenario(parameters, "/sensory_growth", problems), [](const node::Message&) {});
  while (!run.finished()) ASSERT_EQ(run.step(), std::nullopt);
  const std::string last = run.finish()->path;

  std::uint64_t step = 0;
  int parts = 0;
  for (std::string file = path("run.bag"); std::filesystem::exists(file); ++parts) {
    const auto states = readTopic<OrganState>(rosbag::Bag(file), "/sensory_growth/organs/shoot/state");
    const auto statuses = readTopic<Status>(rosbag::Bag(file), "/sensory_growth/status");
    ASSERT_EQ(states.size(), statuses.size());
    for (std::size_t i = 0; i < states.size(); ++i, ++step) {
      EXPECT_EQ(states[i].step_index, step) << file;
      EXPECT_EQ(statuses[i].step_index, step) << file;
    }
    --step;  // the last state is the first of the next part
    EXPECT_EQ(call({"replay", file}).code, kOk) << file;
    if (file == last) {
      EXPECT_EQ(step, 240u);
    } else {
      EXPECT_GE(std::filesystem::file_size(file), static_cast<std::uintmax_t>(kSize));
    }
    file = path("run_" + std::to_string(parts + 1) + ".bag");
  }
  EXPECT_GE(parts, 3);
}

/// Steps may be cut in two, which is not enough for limits as tight as these.
TEST_F(RunTest, FailsWithTheStepAndTheReasonOfTheNode) {
  std::string scenario = textOf(kShoot);
  const std::string limits = "stepping: {step: 1 min, limits: {bend_angle: 1e-12 rad, smallest_part: 0.5}}";
  const std::string stepping = "stepping: {step: 1 min}";
  scenario.replace(scenario.find(stepping), stepping.size(), limits);
  scenario += "stimuli:\n  light_directions:\n    - {id: sun, towards: [1, 0, 0], strength: 1}\n";
  const std::string file = write("shoot.yaml", scenario);
  const Outcome outcome = call({"run", file, "--bag", path("run.bag")});
  EXPECT_EQ(outcome.code, kFault);
  EXPECT_THAT(outcome.err, HasSubstr("organ 'shoot' failed in step 1: the step limits ask for parts smaller"));
  const auto statuses = readTopic<Status>(rosbag::Bag(path("run.bag")), "/sensory_growth/status");
  ASSERT_EQ(statuses.size(), 2u);
  EXPECT_EQ(statuses.back().mode, Status::FAULT);
  EXPECT_EQ(statuses.back().checksum, statuses.front().checksum);  // the last good state
}

TEST_F(RunTest, RefusesBadInputWithWhatIsWrong) {
  std::string no_duration = textOf(kShoot);
  no_duration.replace(no_duration.find("duration: 4 h\n"), 14, "");
  const std::string endless = write("endless.yaml", no_duration);
  write("taken.bag", "precious");
  const struct {
    std::vector<std::string> arguments;
    std::string message;
  } cases[] = {
      {{}, "A subcommand is required"},
      {{"run"}, "scenario,--from] is required"},
      {{"run", "nowhere.yaml"}, "nowhere.yaml"},
      {{"run", kShoot, "--every", "0"}, "--every"},
      {{"run", kShoot, "--threads", "-1"}, "--threads"},
      {{"run", kShoot, "--speed", "1"}, "--speed"},
      {{"run", kShoot, "--duration", "8"}, "--duration '8'"},
      {{"run", kShoot, "--duration", "8 mm"}, "--duration '8 mm'"},
      {{"run", kShoot, "--duration", "0 h"}, "--duration '0 h' is not positive"},
      {{"run", endless}, "no duration"},
      {{"run", kShoot, "--growth-time-scale", "30"}, "--growth-time-scale is 30, so a step of 60 s"},
      {{"run", kShoot, "--bag", path("run.txt")}, "must end in .bag"},
      {{"run", kShoot, "--bag", path("taken.bag"), "--csv", folder_}, "exists already"},
      {{"run", "data/scenarios/bad/many_problems.yaml"}, "many_problems.yaml:"},
      {{"run", kShoot, "--protocol", "data/scenarios/bad/not_yaml.yaml"}, "not_yaml.yaml:"},
      {{"replay", kShoot}, "cannot be read as a bag"},
      {{"export", kShoot}, "give --csv or --vtk"},
      {{"export", kShoot, "--csv", path("csv")}, "cannot be read as a bag"},
  };
  for (const auto& wrong : cases) {
    const Outcome outcome = call(wrong.arguments);
    EXPECT_EQ(outcome.code, kBadInput) << wrong.message;
    EXPECT_THAT(outcome.err, HasSubstr(wrong.message));
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(textOf(path("taken.bag")), "precious");
  EXPECT_FALSE(std::filesystem::exists(path("shoot.csv")));
}

TEST_F(RunTest, ExplainsItself) {
  for (const std::string command : {"run", "replay", "export"}) {
    const Outcome outcome = call({command, "--help"});
    EXPECT_EQ(outcome.code, kOk);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("--csv"), HasSubstr("--vtk"), HasSubstr("--every")));
  }
  EXPECT_THAT(call({"--help"}).out, HasSubstr("Exit codes: 0"));
  EXPECT_EQ(call({"--version"}).code, kOk);
}

TEST(StepsIn, FillTheDuration) {
  EXPECT_EQ(stepsIn(3600.0, 60.0), 60u);
  EXPECT_EQ(stepsIn(3601.0, 60.0), 61u);
  EXPECT_EQ(stepsIn(0.3, 0.1), 3u);  // though 0.3 / 0.1 is more than 3 in binary or less
}

TEST(DefaultScale, LetsEveryShippedScenarioRun) {
  for (const auto& entry : std::filesystem::directory_iterator("../config")) {
    if (entry.path().extension() != ".yaml") continue;
    const double step = simulation::loadScenario(entry.path()).stepping.step;
    EXPECT_LE(step / defaultScale(entry.path()), 1.0) << entry.path();
  }
}

TEST(AsOption, SpeaksOfTheCommandLine) {
  EXPECT_EQ(asOption("~growth_time_scale is 30_"), "--growth-time-scale is 30_");
  EXPECT_EQ(asOption("a_file: is bad"), "a_file: is bad");
  EXPECT_EQ(BadInput(std::vector<std::string>{"one", "~two_a is"}).what(), std::string("one\n--two-a is"));
}

}  // namespace
}  // namespace sensory_growth::batch::testing
