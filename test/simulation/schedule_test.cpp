// Stimuli that switch on and off by themselves.

#include "sensory_growth/simulation/schedule.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"
#include "support/scenario_texts.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;
using support::list;
using support::problemsOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

StimulusCommand lamp(StimulusOperation operation, const StimulusTiming& timing = {}, const std::string& id = "lamp") {
  return {StimulusKind::point_source, operation, id, Vector3(0.5, 0.0, 1.0), 1.0, timing};
}

StimulusCommand sun(const StimulusTiming& timing) {
  return {StimulusKind::light_direction, StimulusOperation::add, "sun", Vector3::UnitZ(), 1.0, timing};
}

/// A short organ that senses lamps; a step lasts for `step`.
Simulation simulationOf(double step) {
  Scenario scenario = kinematicScenario(step, 5);
  scenario.organs.front().profile = growth::UniformProfile{1e-3};
  scenario.organs.front().senses.point_source = 0.1;
  scenario.organs.front().senses.light_direction = 0.1;
  return Simulation(scenario);
}

bool isOn(const Simulation& simulation) { return !simulation.environment().point_sources.empty(); }

/// The states, of those up to step `last`, in which there is a lamp.
std::vector<int> statesWithLamp(Simulation& simulation, int last) {
  std::vector<int> states;
  for (int i = static_cast<int>(simulation.stepIndex());; ++i) {
    if (isOn(simulation)) states.push_back(i);
    if (i == last) return states;
    EXPECT_TRUE(simulation.step().ok);
  }
}

TEST(Schedule, SwitchesAtTheFirstBoundaryThatIsNotEarlier) {
  Simulation simulation = simulationOf(1.0);
  EXPECT_EQ(simulation.apply(lamp(StimulusOperation::add, {1.5, 2.0, 5.0})).refusal, "");
  EXPECT_FALSE(isOn(simulation));
  // On from 1.5, 6.5 and 11.5 s, off from 3.5, 8.5 and 13.5 s.
  EXPECT_THAT(statesWithLamp(simulation, 14), ElementsAre(2, 3, 7, 8, 12, 13));
}

TEST(Schedule, CountsFromTheStateInWhichItIsTaken) {
  Simulation simulation = simulationOf(0.5);
  for (int i = 0; i < 3; ++i) simulation.step();
  simulation.apply(lamp(StimulusOperation::add, {1.0, 1.0, 0.0}));
  EXPECT_THAT(statesWithLamp(simulation, 10), ElementsAre(5, 6));
  EXPECT_THAT(simulation.schedule().entries(), IsEmpty());
  simulation.apply(lamp(StimulusOperation::add, {0.0, 1.0, 2.0}));
  EXPECT_THAT(statesWithLamp(simulation, 16), ElementsAre(10, 11, 14, 15));
  simulation.apply(lamp(StimulusOperation::add, {1.0, 0.0, 0.0}));
  EXPECT_THAT(statesWithLamp(simulation, 20), ElementsAre(18, 19, 20));
  EXPECT_THAT(simulation.schedule().entries(), IsEmpty());
}

TEST(Schedule, DoesNotDrift) {
  Simulation simulation = simulationOf(0.1);  // which no double holds exactly
  simulation.apply(lamp(StimulusOperation::add, {0.1, 0.1, 0.3}));
  for (int i = 0; i < 5000; ++i) {
    ASSERT_EQ(isOn(simulation), i % 3 == 1) << i;
    ASSERT_TRUE(simulation.step().ok);
  }
}

TEST(Schedule, IsEchoedAsPlainAdditionsAndRemovals) {
  Simulation simulation = simulationOf(1.0);
  simulation.apply(sun({1.0, 1.0, 2.0}));
  for (int i = 0; i < 4; ++i) simulation.step();
  std::vector<std::pair<std::uint64_t, StimulusOperation>> echoes;
  for (const AppliedCommand& applied : simulation.takeApplied()) {
    const auto& command = std::get<StimulusCommand>(applied.command);
    EXPECT_EQ(command.id, "sun");
    EXPECT_EQ(command.timing.duration, echoes.empty() ? 1.0 : 0.0);
    EXPECT_EQ(applied.refusal, "");
    echoes.emplace_back(applied.step, command.operation);
  }
  using Operation = StimulusOperation;
  EXPECT_THAT(echoes, ElementsAre(std::pair(0u, Operation::add), std::pair(1u, Operation::add),
                                  std::pair(2u, Operation::remove), std::pair(3u, Operation::add),
                                  std::pair(4u, Operation::remove)));
}

TEST(Schedule, EqualsTheSameSwitchesByHand) {
  Simulation scheduled = simulationOf(1.0), by_hand = simulationOf(1.0);
  scheduled.apply(lamp(StimulusOperation::add, {2.0, 3.0, 6.0}));
  for (int i = 0; i < 30; ++i) {
    if (i % 6 == 2) by_hand.apply(lamp(StimulusOperation::add));
    if (i % 6 == 5) by_hand.apply(lamp(StimulusOperation::remove));
    scheduled.step();
    by_hand.step();
    const rod::Rod &a = scheduled.organs()[0].rod(), &b = by_hand.organs()[0].rod();
    EXPECT_EQ(a.vertices.back().position, b.vertices.back().position) << i;
  }
  EXPECT_GT(scheduled.organs()[0].rod().bends.back().curvature.norm(), 1e-6);
}

TEST(Schedule, EndsWhenTheStimulusIsSetAgainOrRemoved) {
  const StimulusTiming flashes{0.0, 1.0, 4.0};
  for (const int step : {0, 2}) {  // in a flash and between two
    Simulation simulation = simulationOf(1.0);
    simulation.apply(lamp(StimulusOperation::add, flashes));
    for (int i = 0; i < step; ++i) simulation.step();
    EXPECT_EQ(isOn(simulation), step == 0);
    EXPECT_EQ(simulation.apply(lamp(StimulusOperation::remove)).refusal, "");
    EXPECT_THAT(statesWithLamp(simulation, 12), IsEmpty());
    EXPECT_EQ(simulation.apply(lamp(StimulusOperation::remove)).refusal, "there is no point_source 'lamp' to remove");

    simulation.apply(lamp(StimulusOperation::add, flashes));
    for (int i = 0; i < step; ++i) simulation.step();
    EXPECT_EQ(simulation.apply(lamp(StimulusOperation::change)).refusal, "");
    EXPECT_TRUE(isOn(simulation));
    EXPECT_THAT(simulation.schedule().entries(), IsEmpty());
  }
}

TEST(Schedule, LeavesWhatIsThereUntilItBegins) {
  Simulation simulation = simulationOf(1.0);
  simulation.apply(lamp(StimulusOperation::add));
  StimulusCommand stronger = lamp(StimulusOperation::change, {2.0, 0.0, 0.0});
  stronger.strength = 5.0;
  EXPECT_EQ(simulation.apply(stronger).refusal, "");
  std::vector<double> strengths;
  for (int i = 0; i < 4; ++i) {
    strengths.push_back(simulation.environment().point_sources.at(0).strength);
    simulation.step();
  }
  EXPECT_THAT(strengths, ElementsAre(1.0, 1.0, 5.0, 5.0));
}

TEST(Schedule, IsForgottenByAReset) {
  Simulation simulation = simulationOf(1.0);
  simulation.apply(lamp(StimulusOperation::add, {1.0, 1.0, 2.0}));
  simulation.step();
  simulation.reset();
  EXPECT_THAT(simulation.schedule().entries(), IsEmpty());
  EXPECT_THAT(statesWithLamp(simulation, 5), IsEmpty());
}

TEST(Schedule, RefusesTimesThatMakeNoSense) {
  Simulation simulation = simulationOf(2.0);
  const auto refusal = [&](const StimulusTiming& timing) {
    return simulation.apply(lamp(StimulusOperation::add, timing)).refusal;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal({-1.0, 0.0, 0.0}), "start -1 s is not in [0, 1e+12] s");
  EXPECT_EQ(refusal({0.0, nan, 0.0}), "duration nan s is not in [0, 1e+12] s");
  EXPECT_EQ(refusal({0.0, 2.0, infinity}), "period inf s is not in [0, 1e+12] s");
  EXPECT_EQ(refusal({0.0, 0.0, 5.0}), "period 5 s needs a duration, for which each flash is on");
  EXPECT_EQ(refusal({0.0, 6.0, 5.0}), "period 5 s is shorter than the duration of 6 s");
  EXPECT_EQ(refusal({0.0, 1.5, 5.0}), "duration 1.5 s is shorter than a step of 2 s");
  EXPECT_EQ(simulation.apply(lamp(StimulusOperation::change, {5.0, 0.0, 0.0})).refusal,
            "there is no point_source 'lamp' to change");
  EXPECT_EQ(refusal({0.0, 5.0, 5.0}), "");
  EXPECT_THAT(simulation.schedule().entries(), SizeIs(1));
}

TEST(Schedule, IsBounded) {
  Simulation simulation = simulationOf(1.0);
  for (std::size_t i = 0; i < kMostScheduled; ++i) {
    const auto command = lamp(StimulusOperation::add, {1.0, 1.0, 0.0}, "lamp_" + std::to_string(i));
    EXPECT_EQ(simulation.apply(command).refusal, "");
  }
  EXPECT_EQ(simulation.apply(sun({1.0, 1.0, 0.0})).refusal,
            "there are 256 stimuli scheduled already; remove one first");
  EXPECT_EQ(simulation.apply(lamp(StimulusOperation::add, {0.0, 1.0, 2.0}, "lamp_7")).refusal, "");
}

/// A scenario without fault, with a protocol and a step of a minute.
std::string withProtocol(const std::string& stimuli, const std::string& protocol) {
  const std::string text = support::contentOf("data/ros/shoot.yaml");
  return text +
         (stimuli.empty()
              ? ""
              : "stimuli: {point_sources: [{id: lamp, position: [0 m, 0 m, 1 m], strength: 1, " + stimuli + "}]}\n") +
         (protocol.empty() ? "" : "protocol:\n" + protocol);
}

TEST(ScenarioYaml, ReadsWhenStimuliAreOn) {
  const Scenario scenario =
      parseScenario(withProtocol("start: 1 min, duration: 2 min, period: 1 h",
                                 "  - {at: 3 h, change: {point_source: {id: lamp, position: [0 m, 0 m, 1 m], strength: "
                                 "1, duration: 90 s}}}\n"),
                    "test");
  const auto& stimulus = std::get<StimulusCommand>(scenario.protocol.at(0).command).timing;
  EXPECT_EQ(stimulus.start, 60.0);
  EXPECT_EQ(stimulus.duration, 120.0);
  EXPECT_EQ(stimulus.period, 3600.0);
  EXPECT_EQ(std::get<StimulusCommand>(scenario.protocol.at(1).command).timing.duration, 90.0);
}

TEST(ScenarioYaml, KnowsWhichTimedStimuliAreThere) {
  const std::string change = "change: {point_source: {id: lamp, position: [0 m, 0 m, 1 m], strength: 1}}}\n";
  const auto problems = [](const std::string& text) { return list(problemsOf(text)); };
  EXPECT_EQ(problems(withProtocol("duration: 2 min", "  - {at: 1 min, " + change)), "no problem");
  EXPECT_THAT(problems(withProtocol("duration: 2 min", "  - {at: 3 min, " + change)),
              HasSubstr("protocol[0].change: there is no point_source 'lamp' to change"));
  EXPECT_EQ(problems(withProtocol("duration: 2 min, period: 10 min", "  - {at: 1e20 h, " + change)), "no problem");
  EXPECT_THAT(problems(withProtocol("duration: 30 s", "")),
              HasSubstr("stimuli.point_sources[0].id: duration 30 s is shorter than a step of 60 s"));
  EXPECT_THAT(problems(withProtocol("period: 30 s", "")),
              HasSubstr("stimuli.point_sources[0].period: period 30 s needs a duration"));
  EXPECT_THAT(problems(withProtocol("start: -1 s", "")), HasSubstr("'-1 s' is out of range"));
}

}  // namespace
}  // namespace sensory_growth::simulation
