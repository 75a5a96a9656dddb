/// Stimuli set by services, which answer; and stimuli that switch themselves.

#include <gmock/gmock.h>

#include <string>

#include "ros/node_under_test.h"
#include "sensory_growth/ListStimuli.h"
#include "sensory_growth/SetLightDirection.h"
#include "sensory_growth/SetPointSource.h"

namespace sensory_growth::node::testing {
namespace {

using ::testing::HasSubstr;

class StimulusServices : public ::testing::Test {
 protected:
  /// Each test begins paused at step 0.
  StimulusServices() {
    EXPECT_TRUE(node_.command("pause").success);
    EXPECT_TRUE(node_.command("reset").success);
    node_.waitForStatus("step 0", [](const Status& s) { return s.mode == Status::PAUSED && s.step_index == 0; });
  }

  SetPointSource::Response set(const PointSource& source) {
    SetPointSource::Request request;
    request.source = source;
    return node_.call<SetPointSource>("set_point_source", request);
  }

  SetLightDirection::Response set(const LightDirection& light) {
    SetLightDirection::Request request;
    request.light = light;
    return node_.call<SetLightDirection>("set_light_direction", request);
  }

  Stimuli list() {
    const ListStimuli::Response response = node_.call<ListStimuli>("list_stimuli");
    EXPECT_TRUE(response.success) << response.message;
    EXPECT_EQ(response.stimuli.step_index, response.step_index);
    EXPECT_EQ(response.stimuli.header.stamp, response.stamp);
    return response.stimuli;
  }

  NodeUnderTest node_;
};

TEST_F(StimulusServices, AnswerWhenTheStimulusIsInForce) {
  const Step::Response step = node_.step(2);
  const SetPointSource::Response added = set(lamp(PointSource::ADD, "lamp", {0.1, 0.2, 0.3}, -2.0));
  ASSERT_TRUE(added.success) << added.message;
  EXPECT_EQ(added.step_index, 2u);
  EXPECT_EQ(added.stamp, step.stamp);
  ASSERT_TRUE(set(light(LightDirection::ADD, "sun", {0.0, 3.0, 4.0})).success);
  const Stimuli stimuli = list();
  ASSERT_EQ(stimuli.point_sources.size(), 1u);
  EXPECT_EQ(stimuli.point_sources[0].position.z, 0.3);
  EXPECT_EQ(stimuli.point_sources[0].strength, -2.0);
  ASSERT_EQ(stimuli.light_directions.size(), 1u);
  EXPECT_EQ(stimuli.light_directions[0].towards.y, 0.6);
  EXPECT_EQ(node_.applied(0).id, "lamp");
  ASSERT_TRUE(set(lamp(PointSource::REMOVE, "lamp", rod::Vector3::Zero())).success);
  EXPECT_TRUE(list().point_sources.empty());
}

TEST_F(StimulusServices, TransformAsTheTopicsDo) {
  PointSource above = lamp(PointSource::ADD, "above", {0.0, 0.0, 0.01});
  above.header.frame_id = "shoot/tip";
  const SetPointSource::Response response = set(above);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(list().point_sources.at(0).position.z, tipPosition(node_.state(0)).z() + 0.01, 1e-9);
}

TEST_F(StimulusServices, RefuseWithAReasonAndCount) {
  const std::uint64_t before = node_.waitForStatus("status", [](const Status&) { return true; }).stimuli_refused;
  EXPECT_THAT(set(lamp(0, "lamp", rod::Vector3::Zero())).message, HasSubstr("operation must be"));
  EXPECT_THAT(set(lamp(PointSource::ADD, "", rod::Vector3::Zero())).message, HasSubstr("id is empty"));
  EXPECT_THAT(set(light(LightDirection::ADD, "sun", rod::Vector3::Zero())).message,
              HasSubstr("direction has zero length"));
  EXPECT_THAT(set(lamp(PointSource::CHANGE, "nobody", rod::Vector3::Zero())).message,
              HasSubstr("there is no point_source 'nobody'"));
  PointSource lost = lamp(PointSource::ADD, "lost", rod::Vector3::Zero());
  lost.header.frame_id = "nowhere";
  const SetPointSource::Response refused = set(lost);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, HasSubstr("nowhere"));
  PointSource brief = lamp(PointSource::ADD, "brief", rod::Vector3::Zero());
  brief.period = 100.0;
  EXPECT_THAT(set(brief).message, HasSubstr("needs a duration"));
  brief.duration = 1.0;
  EXPECT_THAT(set(brief).message, HasSubstr("duration 1 s is shorter than a step of 60 s"));
  EXPECT_TRUE(list().point_sources.empty());
  node_.waitForStatus("seven refusals", [&](const Status& s) { return s.stimuli_refused == before + 7; });
}

TEST_F(StimulusServices, TimedStimuliSwitchAtStepBoundaries) {
  PointSource flash = lamp(PointSource::ADD, "flash", {0.1, 0.0, 0.1});
  flash.start = 90.0;
  flash.duration = 120.0;
  flash.period = 300.0;
  ASSERT_TRUE(set(flash).success);
  Stimuli stimuli = list();
  EXPECT_TRUE(stimuli.point_sources.empty());
  ASSERT_EQ(stimuli.scheduled.size(), 1u);
  EXPECT_EQ(stimuli.scheduled[0].kind, ScheduledStimulus::POINT_SOURCE);
  EXPECT_EQ(stimuli.scheduled[0].id, "flash");
  EXPECT_EQ(stimuli.scheduled[0].begin, 90.0);
  EXPECT_EQ(stimuli.scheduled[0].next_switch, 90.0);
  EXPECT_FALSE(stimuli.scheduled[0].is_on);
  for (std::uint64_t step = 1; step <= 12; ++step) {
    node_.stepTo(step, step - 1);
    const bool is_on = step == 2 || step == 3 || step == 7 || step == 8 || step == 12;  // from 90, 390 and 690 s
    stimuli = node_.waitForStimuli("those of step " + std::to_string(step),
                                   [&](const Stimuli& s) { return s.point_sources.size() == (is_on ? 1u : 0u); });
    EXPECT_EQ(list().point_sources.size(), is_on ? 1u : 0u) << step;
    EXPECT_EQ(list().scheduled.at(0).is_on, is_on) << step;
  }
  const AppliedCommand asked = node_.applied(0), on = node_.applied(1), off = node_.applied(2);
  EXPECT_EQ(asked.start, 90.0);
  EXPECT_EQ(asked.period, 300.0);
  EXPECT_EQ(on.operation, AppliedCommand::ADD);
  EXPECT_EQ(on.step_index, 2u);
  EXPECT_EQ(on.start + on.duration + on.period, 0.0);
  EXPECT_EQ(off.operation, AppliedCommand::REMOVE);
  EXPECT_EQ(off.step_index, 4u);
  ASSERT_TRUE(set(lamp(PointSource::REMOVE, "flash", rod::Vector3::Zero())).success);
  EXPECT_TRUE(list().scheduled.empty());
}

TEST_F(StimulusServices, TopicsTakeTimesToo) {
  ros::Publisher lights = node_.handle().advertise<LightDirection>("light_direction", 10);
  LightDirection dawn = light(LightDirection::ADD, "dawn", {1.0, 0.0, 0.0});
  dawn.start = 60.0;
  EXPECT_TRUE(node_.send(lights, dawn).accepted);
  EXPECT_TRUE(list().light_directions.empty());
  ASSERT_TRUE(node_.step(1).success);
  EXPECT_EQ(list().light_directions.size(), 1u);
  EXPECT_TRUE(list().scheduled.empty());
}

}  // namespace
}  // namespace sensory_growth::node::testing
