// Stimuli and what changes while a simulation runs, in scenarios and in files of their own.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::expectNear;
using support::good;
using support::list;
using support::problemsOf;

void expectStimulus(const TimedCommand& actual, double time, StimulusOperation operation, StimulusKind kind,
                    const std::string& id, const Vector3& vector, double strength) {
  SCOPED_TRACE(id);
  EXPECT_DOUBLE_EQ(actual.time, time);
  const auto& command = std::get<StimulusCommand>(actual.command);
  EXPECT_EQ(command.operation, operation);
  EXPECT_EQ(command.kind, kind);
  EXPECT_EQ(command.id, id);
  if (operation == StimulusOperation::remove) return;
  expectNear(command.vector, vector);
  EXPECT_EQ(command.strength, strength);
}

void expectTiming(const TimedCommand& actual, double start, double duration, double period) {
  const StimulusTiming& timing = std::get<StimulusCommand>(actual.command).timing;
  EXPECT_DOUBLE_EQ(timing.start, start);
  EXPECT_DOUBLE_EQ(timing.duration, duration);
  EXPECT_DOUBLE_EQ(timing.period, period);
}

void expectSetting(const TimedCommand& actual, double time, const std::string& organ, const std::string& name,
                   double value) {
  SCOPED_TRACE(name);
  EXPECT_DOUBLE_EQ(actual.time, time);
  const auto& command = std::get<ParameterCommand>(actual.command);
  EXPECT_EQ(command.organ, organ);
  EXPECT_EQ(command.name, name);
  EXPECT_DOUBLE_EQ(command.value, value);
}

TEST(ScenarioYaml, StimuliAndProtocolBecomeTimedCommands) {
  const std::vector<TimedCommand> p = loadScenario(good + "all_keys.yaml").protocol;
  using Operation = StimulusOperation;
  using Kind = StimulusKind;
  ASSERT_EQ(p.size(), 11u);
  expectStimulus(p[0], 0, Operation::add, Kind::point_source, "lamp", {0.1, 0, 0.2}, 0.5);
  expectStimulus(p[1], 0, Operation::add, Kind::light_direction, "sun", {0, 0.6, 0.8}, -1);
  expectTiming(p[0], 120, 240, 600);
  expectTiming(p[1], 240, 360, 900);
  expectTiming(p[2], 0, 0, 0);
  expectStimulus(p[2], 1800, Operation::change, Kind::point_source, "lamp", {0, 1, 0}, 2);
  expectStimulus(p[3], 1800, Operation::change, Kind::light_direction, "sun", {1, 0, 0}, 1);
  expectStimulus(p[4], 7200, Operation::add, Kind::point_source, "second_lamp", {1, 1, 1}, 1);
  expectStimulus(p[5], 10800, Operation::add, Kind::light_direction, "moon", {0, 0, 1}, 0.1);
  expectStimulus(p[6], 86400, Operation::remove, Kind::point_source, "second_lamp", {}, 0);
  expectStimulus(p[7], 86400, Operation::remove, Kind::light_direction, "moon", {}, 0);
  expectSetting(p[8], 90000, "flat_organ", "sensitivities.gravity", -0.25);
  expectSetting(p[9], 90000, "all", "growth.rate", 1e-5);
  EXPECT_DOUBLE_EQ(p[10].time, 93600);
  expectNear(std::get<GravityCommand>(p[10].command).acceleration, {1.2, 0.0, -1.6});
}

TEST(ProtocolYaml, IsReadOnItsOwn) {
  const std::vector<TimedCommand> p = loadProtocol(good + "protocol.yaml");
  ASSERT_EQ(p.size(), 3u);
  expectStimulus(p[0], 0, StimulusOperation::add, StimulusKind::light_direction, "left", {-1, 0, 0}, 1);
  expectStimulus(p[1], 0, StimulusOperation::remove, StimulusKind::light_direction, "sun", {}, 0);
  expectStimulus(p[2], 5400, StimulusOperation::remove, StimulusKind::light_direction, "left", {}, 0);
}

TEST(ProtocolYaml, RefusesTheOtherKeysOfAScenario) {
  const auto problems = [](const std::string& yaml) { return list(problemsOf([&] { parseProtocol(yaml, "test"); })); };
  EXPECT_EQ(problems("name: a\nprotocol: []\nduration: 1 h\n"),
            "test:3: duration: is an unknown key; known here are 'name', 'description', 'stimuli' and 'protocol'");
  EXPECT_EQ(problems("name: a\n"), "test:1: protocol: is missing; give a sequence of mappings");
  EXPECT_EQ(problems("name: a\nprotocol:\n  - {at: 1 h, remove: {point_source: {id: b}}}\n  - {at: 59 min, remove: "
                     "{point_source: {id: b}}}\n"),
            "test:4: protocol[1].at: '59 min' is earlier than the entry before it, on line 3; entries are in order of "
            "time");
}

}  // namespace
}  // namespace sensory_growth::simulation
