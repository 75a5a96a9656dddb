#include "sensory_growth/ros/conversions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ros/snapshots.h"

namespace sensory_growth::node {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(OrganStateMessage, HoldsOneEntryForEachVertexElementAndBend) {
  const auto snapshot = testing::snapshotOf("stem");
  snapshot->organs[0].rod.elements.back().age = 50.0;
  const OrganState message = toMessage(snapshot->organs[0], *snapshot, "world");
  EXPECT_EQ(message.header.stamp, ros::Time(7, 500000000));
  EXPECT_EQ(message.header.frame_id, "world");
  EXPECT_EQ(message.organ, "stem");
  EXPECT_EQ(message.step_index, 6u);
  EXPECT_EQ(message.growth_time, 360.0);
  EXPECT_THAT(message.positions, SizeIs(5));
  EXPECT_THAT(message.rest_arc_length, SizeIs(5));
  EXPECT_THAT(message.frames, SizeIs(4));
  EXPECT_THAT(message.radius, ElementsAre(1e-3, 1e-3, 1e-3, 1e-3));
  EXPECT_THAT(message.strain, SizeIs(4));
  EXPECT_THAT(message.growth_rate, ElementsAre(0.0, 1e-6, 2e-6, 4e-6));
  EXPECT_THAT(message.age, ElementsAre(0.0, 0.0, 0.0, 50.0));
  EXPECT_THAT(message.curvature, SizeIs(4));
  EXPECT_THAT(message.rest_curvature, SizeIs(4));
  EXPECT_NEAR(message.rest_arc_length.back(), 0.04, 1e-15);
  EXPECT_NEAR(message.rest_length, 0.04, 1e-15);
  EXPECT_EQ(message.bending_energy, 1.0);
  EXPECT_EQ(message.stretching_energy, 2.0);
  EXPECT_EQ(message.load_energy, -3.0);
}

TEST(OrganStateMessage, ReportsEachCueAtEveryBend) {
  const auto snapshot = testing::snapshotOf("stem");
  const OrganState message = toMessage(snapshot->organs[0], *snapshot, "world");
  const auto holds = [](const std::vector<geometry_msgs::Vector3>& cue, double d1) {
    EXPECT_THAT(cue, SizeIs(4));
    for (const geometry_msgs::Vector3& section : cue) {
      EXPECT_EQ(section.x, d1);
      EXPECT_EQ(section.y, -0.25);
      EXPECT_EQ(section.z, 0.0);
    }
  };
  holds(message.gravity_cue, 0.125);
  holds(message.light_direction_cue, 0.25);
  holds(message.point_source_cue, 0.375);
  holds(message.oscillator_cue, 0.5);
}

TEST(OrganStateMessage, TipOfAStraightOrganStandsOnItsBaseWithZAlongTheTangent) {
  const auto snapshot = testing::snapshotOf("stem");
  const OrganState message = toMessage(snapshot->organs[0], *snapshot, "world");
  EXPECT_NEAR(message.tip.position.x, 1.0, 1e-15);
  EXPECT_NEAR(message.tip.position.y, 2.0, 1e-15);
  EXPECT_NEAR(message.tip.position.z, 3.04, 1e-15);
  EXPECT_NEAR(std::abs(message.tip.orientation.w), 1.0, 1e-15);  // the identity: z is up, and so is the organ
}

TEST(OrganStateMessage, PositiveFirstCurvatureTurnsTheTangentFromZToMinusY) {
  auto snapshot = testing::snapshotOf("stem");
  rod::Rod& rod = snapshot->organs[0].rod;
  for (rod::Bend& bend : rod.bends) bend.curvature.x() = 1.0;  // 1/m about d1
  rod.rebuild();
  const OrganState message = toMessage(snapshot->organs[0], *snapshot, "world");
  EXPECT_NEAR(message.tip.orientation.x, std::sin(0.02), 1e-12);  // half of 1/m times 0.04 m, about x
  EXPECT_LT(message.tip.position.y, 2.0);
}

TEST(RelaxationMessage, KeepsReasonAndFigures) {
  simulation::OrganReport report;
  report.relaxation.reason = mechanics::RelaxationReason::unresolved_bend;
  report.relaxation.iterations = 5;
  report.iterations = 9;
  report.substeps = 3;
  report.retries = 2;
  report.divisions = 1;
  const Relaxation message = toMessage(report);
  EXPECT_EQ(message.reason, Relaxation::UNRESOLVED_BEND);
  EXPECT_EQ(message.iterations, 5u);
  EXPECT_EQ(message.step_iterations, 9u);
  EXPECT_EQ(message.substeps, 3u);
  EXPECT_EQ(message.retries, 2u);
  EXPECT_EQ(message.divisions, 1u);
}

TEST(Command, OfAPointSource) {
  PointSource message;
  message.operation = PointSource::CHANGE;
  message.id = "lamp";
  message.position.y = 2.0;
  message.strength = -3.0;
  const auto command = toCommand(message);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->kind, simulation::StimulusKind::point_source);
  EXPECT_EQ(command->operation, simulation::StimulusOperation::change);
  EXPECT_EQ(command->id, "lamp");
  EXPECT_EQ(command->vector, rod::Vector3(0.0, 2.0, 0.0));
  EXPECT_EQ(command->strength, -3.0);
}

TEST(Command, NeedsAKnownOperation) {
  PointSource lamp;
  LightDirection light;
  for (const int operation : {0, 4, 255}) {
    lamp.operation = light.operation = static_cast<std::uint8_t>(operation);
    EXPECT_FALSE(toCommand(lamp)) << operation;
    EXPECT_FALSE(toCommand(light)) << operation;
  }
}

TEST(Command, ThatRemovesIgnoresTheNumbers) {
  LightDirection message;
  message.operation = LightDirection::REMOVE;
  message.id = "sun";
  message.towards.x = message.strength = std::nan("");
  const auto command = toCommand(message);
  ASSERT_TRUE(command);
  EXPECT_TRUE(command->vector.allFinite());
  EXPECT_TRUE(std::isfinite(command->strength));
}

TEST(Command, OfStandardTypes) {
  geometry_msgs::PointStamped click;
  click.point.z = 1.0;
  EXPECT_EQ(toCommand(click, 3).id, "clicked_3");
  EXPECT_EQ(toCommand(click, 3).kind, simulation::StimulusKind::point_source);
  EXPECT_EQ(toCommand(click, 3).vector, rod::Vector3(0.0, 0.0, 1.0));
  geometry_msgs::Vector3Stamped sun;
  sun.vector.x = 4.0;
  EXPECT_EQ(toCommand(sun).id, "sun");
  EXPECT_EQ(toCommand(sun).kind, simulation::StimulusKind::light_direction);
  EXPECT_EQ(toCommand(sun).vector, rod::Vector3(4.0, 0.0, 0.0));
}

TEST(StimuliMessage, ListsWhatIsInForce) {
  auto snapshot = testing::snapshotOf("stem");
  snapshot->environment.point_sources.push_back({"lamp", {1.0, 0.0, 0.0}, 2.0});
  snapshot->environment.light_directions.push_back({"sun", {0.0, 0.0, 1.0}, 0.5});
  snapshot->gravity = {0.0, 0.0, -9.81};
  const Stimuli message = toStimuli(*snapshot, "world");
  ASSERT_THAT(message.point_sources, SizeIs(1));
  ASSERT_THAT(message.light_directions, SizeIs(1));
  EXPECT_EQ(message.point_sources[0].id, "lamp");
  EXPECT_EQ(message.point_sources[0].position.x, 1.0);
  EXPECT_EQ(message.point_sources[0].strength, 2.0);
  EXPECT_EQ(message.light_directions[0].towards.z, 1.0);
  EXPECT_EQ(message.gravity.z, -9.81);
}

TEST(AppliedCommandMessage, HoldsEveryKindOfCommand) {
  const auto snapshot = testing::snapshotOf("stem");
  const simulation::StimulusCommand lamp{simulation::StimulusKind::point_source, simulation::StimulusOperation::change,
                                         "lamp", rod::Vector3(1.0, 2.0, 3.0), 4.0};
  const AppliedCommand changed = toMessage(simulation::AppliedCommand{7, lamp, ""}, *snapshot, "world");
  EXPECT_EQ(changed.step_index, 7u);
  EXPECT_EQ(changed.kind, AppliedCommand::POINT_SOURCE);
  EXPECT_EQ(changed.operation, AppliedCommand::CHANGE);
  EXPECT_EQ(changed.id, "lamp");
  EXPECT_EQ(changed.vector.z, 3.0);
  EXPECT_EQ(changed.strength, 4.0);
  EXPECT_TRUE(changed.accepted);

  SetParameter::Request request;
  request.organ = "all";
  request.name = "growth.rate";
  request.value = 0.5;
  const AppliedCommand set = toMessage(simulation::AppliedCommand{8, toCommand(request), "why"}, *snapshot, "world");
  EXPECT_EQ(set.kind, AppliedCommand::PARAMETER);
  EXPECT_EQ(set.id, "all");
  EXPECT_EQ(set.parameter, "growth.rate");
  EXPECT_EQ(set.value, 0.5);
  EXPECT_FALSE(set.accepted);
  EXPECT_EQ(set.refusal, "why");

  SetGravity::Request turn;
  turn.acceleration.y = -1.5;
  const AppliedCommand turned = toMessage(simulation::AppliedCommand{9, toCommand(turn), ""}, *snapshot, "world");
  EXPECT_EQ(turned.kind, AppliedCommand::GRAVITY);
  EXPECT_EQ(turned.vector.y, -1.5);
}

TEST(AppliedCommandMessage, IsTheCommandAgain) {
  const auto snapshot = testing::snapshotOf("stem");
  const auto again = [&](const simulation::Command& command) {
    return toCommand(toMessage(simulation::AppliedCommand{7, command, ""}, *snapshot, "world")).value();
  };
  for (const auto kind : {simulation::StimulusKind::point_source, simulation::StimulusKind::light_direction}) {
    const simulation::StimulusCommand given{kind, simulation::StimulusOperation::change, "one", {1.0, 2.0, 3.0}, 4.0};
    const auto stimulus = std::get<simulation::StimulusCommand>(again(given));
    EXPECT_EQ(stimulus.kind, kind);
    EXPECT_EQ(stimulus.operation, given.operation);
    EXPECT_EQ(stimulus.id, "one");
    EXPECT_EQ(stimulus.vector, given.vector);
    EXPECT_EQ(stimulus.strength, 4.0);
  }
  const auto set =
      std::get<simulation::ParameterCommand>(again(simulation::ParameterCommand{"all", "growth.rate", 0.5}));
  EXPECT_EQ(set.organ, "all");
  EXPECT_EQ(set.name, "growth.rate");
  EXPECT_EQ(set.value, 0.5);
  const rod::Vector3 tilted(1.0, -2.0, 3.0);
  EXPECT_EQ(std::get<simulation::GravityCommand>(again(simulation::GravityCommand{tilted})).acceleration, tilted);
}

TEST(AppliedCommandMessage, NeedsAKnownKindAndOperation) {
  AppliedCommand message;
  EXPECT_FALSE(toCommand(message));
  message.kind = AppliedCommand::POINT_SOURCE;
  EXPECT_FALSE(toCommand(message));
  message.operation = AppliedCommand::ADD;
  EXPECT_TRUE(toCommand(message));
  message.kind = 255;
  EXPECT_FALSE(toCommand(message));
}

/// What becomes of a command that is echoed and read again.
simulation::Command echoed(const simulation::Command& command) {
  const simulation::AppliedCommand applied{3, command, ""};
  const auto again = toCommand(toMessage(applied, *testing::snapshotOf("stem"), "world"));
  EXPECT_TRUE(again);
  return *again;
}

TEST(Command, WithTimesSurvivesItsEcho) {
  LightDirection message;
  message.operation = LightDirection::ADD;
  message.id = "flash";
  message.towards.x = 1.0;
  message.start = 1.0;
  message.duration = 2.0;
  message.period = 3.0;
  const auto again = std::get<simulation::StimulusCommand>(echoed(*toCommand(message)));
  EXPECT_EQ(again.timing.start, 1.0);
  EXPECT_EQ(again.timing.duration, 2.0);
  EXPECT_EQ(again.timing.period, 3.0);
}

TEST(Command, OnAnOrganSurvivesItsEcho) {
  EXPECT_EQ(std::get<simulation::SpawnCommand>(echoed(simulation::SpawnCommand{"id: a\n"})).organ, "id: a\n");
  EXPECT_EQ(std::get<simulation::RemoveCommand>(echoed(simulation::RemoveCommand{"a"})).organ, "a");
}

TEST(StimuliMessage, TellsWhatWillBeSwitched) {
  const auto snapshot = testing::snapshotOf("stem");
  simulation::ScheduledStimulus flash;
  flash.stimulus = {simulation::StimulusKind::point_source,
                    simulation::StimulusOperation::add,
                    "flash",
                    {1, 2, 3},
                    -1.0,
                    {10.0, 20.0, 50.0}};
  flash.begin = 100.0;
  flash.switches = 3;
  snapshot->scheduled = {flash};
  const Stimuli message = toStimuli(*snapshot, "world");
  ASSERT_THAT(message.scheduled, SizeIs(1));
  EXPECT_EQ(message.scheduled[0].kind, ScheduledStimulus::POINT_SOURCE);
  EXPECT_EQ(message.scheduled[0].id, "flash");
  EXPECT_EQ(message.scheduled[0].vector.z, 3.0);
  EXPECT_EQ(message.scheduled[0].strength, -1.0);
  EXPECT_EQ(message.scheduled[0].begin, 100.0);
  EXPECT_EQ(message.scheduled[0].duration, 20.0);
  EXPECT_EQ(message.scheduled[0].period, 50.0);
  EXPECT_TRUE(message.scheduled[0].is_on);
  EXPECT_EQ(message.scheduled[0].next_switch, 170.0);
}

}  // namespace
}  // namespace sensory_growth::node
