/// Services answer after their effect is visible, and say why when they refuse.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <future>

#include "ros/message_log.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Services : public ::testing::Test {
 protected:
  /// Each test begins paused at step 0.
  Services() {
    EXPECT_TRUE(node_.command("pause").success);
    EXPECT_TRUE(node_.command("reset").success);
    EXPECT_TRUE(node_.setRealTimeFactor(20.0).success);
    // What was latched by the test before must not be mistaken for progress in this one.
    node_.waitForStatus("step 0", [](const Status& s) { return s.mode == Status::PAUSED && s.step_index == 0; });
  }

  NodeUnderTest node_;
};

TEST_F(Services, StepAdvancesExactlyAndTimeWithIt) {
  const Step::Response first = node_.step(1);
  ASSERT_TRUE(first.success) << first.message;
  EXPECT_EQ(first.step_index, 1u);
  const Step::Response more = node_.step(9);
  EXPECT_EQ(more.step_index, 10u);
  EXPECT_EQ(more.stamp - first.stamp, ros::Duration(9.0));  // a step of 60 s at a scale of 60
  const OrganState state = node_.state(10);
  EXPECT_EQ(state.header.stamp, more.stamp);
  EXPECT_EQ(state.growth_time, 600.0);
}

TEST_F(Services, StepRefusesWithAReason) {
  const Step::Response none = node_.step(0);
  EXPECT_FALSE(none.success);
  EXPECT_TRUE(contains(none.message, "from 1 to 1000000")) << none.message;
  const Step::Response many = node_.step(1000001);
  EXPECT_FALSE(many.success);
  EXPECT_TRUE(contains(many.message, "1000001")) << many.message;
  ASSERT_TRUE(node_.command("resume").success);
  const Step::Response running = node_.step(1);
  EXPECT_FALSE(running.success);
  EXPECT_TRUE(contains(running.message, "pause it first")) << running.message;
}

TEST_F(Services, ResetGoesBackToStepZeroWhileTimeGoesOn) {
  const Step::Response before = node_.step(5);
  const auto reset = node_.command("reset");
  ASSERT_TRUE(reset.success);
  EXPECT_EQ(reset.step_index, 0u);
  EXPECT_GT(reset.stamp, before.stamp);
  const Step::Response after = node_.step(1);
  EXPECT_EQ(after.step_index, 1u);
  EXPECT_GT(after.stamp, reset.stamp);
}

TEST_F(Services, ResumeRunsAndPauseStops) {
  ASSERT_TRUE(node_.command("resume").success);
  node_.waitForStatus("running", [](const Status& s) { return s.mode == Status::RUNNING && s.step_index >= 3; });
  const auto paused = node_.command("pause");
  ASSERT_TRUE(paused.success);
  EXPECT_GE(paused.step_index, 3u);
  node_.waitForStatus("paused",
                      [&](const Status& s) { return s.mode == Status::PAUSED && s.step_index == paused.step_index; });
  EXPECT_EQ(node_.step(1).step_index, paused.step_index + 1);  // nothing moved in between
}

TEST_F(Services, PauseAndResetAbortALongStep) {
  for (const char* aborting : {"pause", "reset"}) {
    auto long_step = std::async(std::launch::async, [this] { return node_.step(1000000); });
    node_.waitForStatus("a step", [](const Status& s) { return s.step_index >= 1; });
    ASSERT_TRUE(node_.command(aborting).success);
    const Step::Response aborted = long_step.get();
    EXPECT_FALSE(aborted.success);
    EXPECT_TRUE(contains(aborted.message, std::string("aborted by ") + aborting)) << aborted.message;
    ASSERT_TRUE(node_.command("reset").success);
    node_.waitForStatus("reset", [](const Status& s) { return s.step_index == 0; });
  }
}

TEST_F(Services, FinishedAllowsStepsAndResetButNotResume) {
  ASSERT_TRUE(node_.step(240).success);  // 4 h
  node_.waitForStatus("the end", [](const Status& s) { return s.mode == Status::FINISHED && s.step_index == 240; });
  const auto resume = node_.command("resume");
  EXPECT_FALSE(resume.success);
  EXPECT_TRUE(contains(resume.message, "reset first")) << resume.message;
  EXPECT_EQ(node_.step(1).step_index, 241u);
  EXPECT_TRUE(node_.command("reset").success);
  EXPECT_TRUE(node_.command("resume").success);
}

TEST_F(Services, AnotherRealTimeFactorHoldsAtOnce) {
  ASSERT_TRUE(node_.setRealTimeFactor(1e-6).success);  // a step in eleven days
  ASSERT_TRUE(node_.command("resume").success);
  const SetRealTimeFactor::Response set = node_.setRealTimeFactor(0.0);
  ASSERT_TRUE(set.success) << set.message;
  EXPECT_EQ(set.step_index, 0u);
  const Status running = node_.waitForStatus("a step", [](const Status& s) { return s.step_index >= 1; });
  EXPECT_EQ(running.real_time_factor, 0.0);
}

TEST_F(Services, WhatIsAchievedAndWhatIsMissedIsPublished) {
  const std::uint64_t overruns = node_.waitForStatus("status", [](const Status&) { return true; }).overruns;
  ASSERT_TRUE(node_.setRealTimeFactor(1e12).success);  // more than any machine achieves
  ASSERT_TRUE(node_.command("resume").success);
  node_.waitForStatus("late steps", [&](const Status& s) { return s.overruns >= overruns + 3; });
  ASSERT_TRUE(node_.command("pause").success);  // unless the scenario has ended before
  const Status status =
      node_.waitForStatus("end of running", [](const Status& s) { return s.mode != Status::RUNNING; });
  EXPECT_GT(status.achieved_real_time_factor, 0.0);
  EXPECT_LT(status.achieved_real_time_factor, 1e12);
}

TEST_F(Services, ARealTimeFactorOutOfRangeIsRefused) {
  for (const double bad : {-1.0, 1e-7, 1e13, double{NAN}, double{INFINITY}}) {
    const SetRealTimeFactor::Response response = node_.setRealTimeFactor(bad);
    EXPECT_FALSE(response.success) << bad;
    EXPECT_TRUE(contains(response.message, "must be 0")) << response.message;
  }
  EXPECT_EQ(node_.waitForStatus("status", [](const Status&) { return true; }).real_time_factor, 20.0);
}

TEST_F(Services, ParametersAndGravityChangeAtAStepBoundary) {
  const Step::Response before = node_.step(3);
  const SetParameter::Response set = node_.setParameter("shoot", "growth.rate", 0.0);
  ASSERT_TRUE(set.success) << set.message;
  EXPECT_EQ(set.step_index, 3u);
  EXPECT_EQ(set.stamp, before.stamp);
  const AppliedCommand applied = node_.applied(0);
  EXPECT_EQ(applied.kind, AppliedCommand::PARAMETER);
  EXPECT_EQ(applied.parameter, "growth.rate");
  EXPECT_TRUE(applied.accepted);
  EXPECT_EQ(applied.step_index, 3u);
  node_.step(1);
  EXPECT_EQ(node_.state(4).rest_length, node_.state(3).rest_length);

  ASSERT_TRUE(node_.setGravity({0.0, 3.0, -4.0}).success);
  EXPECT_EQ(node_.applied(1).kind, AppliedCommand::GRAVITY);
  EXPECT_EQ(node_.applied(1).vector.y, 3.0);
  node_.waitForStimuli("gravity", [](const Stimuli& s) { return s.gravity.y == 3.0 && s.gravity.z == -4.0; });
}

TEST_F(Services, ParametersAndGravityAreRefusedWithAReason) {
  const SetParameter::Response structural = node_.setParameter("shoot", "elements", 5.0);
  EXPECT_FALSE(structural.success);
  EXPECT_TRUE(contains(structural.message, "'elements' is structural")) << structural.message;
  EXPECT_TRUE(contains(node_.setParameter("root", "growth.rate", 0.0).message, "no organ 'root'"));
  EXPECT_TRUE(contains(node_.setParameter("shoot", "growth.rate", -1.0).message, "must be >= 0 1/s"));
  EXPECT_TRUE(contains(node_.setGravity({NAN, 0.0, 0.0}).message, "not finite"));
  EXPECT_FALSE(node_.applied(3).accepted);
}

TEST_F(Services, RecordingRefusesNamesThatLeaveItsDirectory) {
  for (const char* file : {"../escape.bag", "/tmp/escape.bag", "no_extension"}) {
    StartRecording::Request request;
    request.file = file;
    const auto response = node_.call<StartRecording>("start_recording", request);
    EXPECT_FALSE(response.success) << file;
    EXPECT_TRUE(contains(response.message, file)) << response.message;
  }
  const auto stop = node_.call<StopRecording>("stop_recording");
  EXPECT_FALSE(stop.success);
  EXPECT_EQ(stop.message, "nothing is being recorded");
}

TEST_F(Services, OneRecordingAtATime) {
  StartRecording::Request request;
  request.file = "once_" + std::to_string(getpid()) + ".bag";
  ASSERT_TRUE(node_.call<StartRecording>("start_recording", request).success);
  const auto again = node_.call<StartRecording>("start_recording");
  EXPECT_FALSE(again.success);
  EXPECT_TRUE(contains(again.message, "already recording")) << again.message;
  const auto stopped = node_.call<StopRecording>("stop_recording");
  EXPECT_TRUE(stopped.success) << stopped.message;
  std::filesystem::remove(stopped.path);
}

TEST_F(Services, ClockIsKeptAliveWhilePausedAndNeverZero) {
  const ros::Time stamp = node_.step(1).stamp;
  for (int i = 0; i < 3; ++i) {  // a new subscription each time: whoever comes late gets the time
    MessageLog<rosgraph_msgs::Clock> clock("/clock");
    clock.waitForCount(2);
    for (const rosgraph_msgs::Clock& message : clock.all()) EXPECT_EQ(message.clock, stamp);
  }
}

TEST_F(Services, ClockGoesForwardAndNoFasterThanAsked) {
  constexpr double kRate = 10.0;  // ~clock_rate, far below the 100 steps that are taken in a second
  constexpr int kAnswers = 4;     // each may let the clock say what the rate has held back
  ASSERT_TRUE(node_.setRealTimeFactor(100.0).success);
  MessageLog<rosgraph_msgs::Clock> clock("/clock");
  clock.waitForCount(1);
  clock.forget();
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(node_.command("resume").success);
  node_.waitForStatus("200 steps", [](const Status& s) { return s.step_index >= 200; });
  const ros::Time end = node_.command("pause").stamp;
  clock.waitFor("the last stamp", [&](const rosgraph_msgs::Clock& message) { return message.clock == end; });
  const std::vector<rosgraph_msgs::Clock> said = clock.all();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  for (std::size_t i = 1; i < said.size(); ++i) EXPECT_GE(said[i].clock, said[i - 1].clock) << i;
  EXPECT_GE(said.size(), 3u);  // it went on, not only from one end to the other
  EXPECT_LE(static_cast<double>(said.size()), elapsed.count() * kRate + 1.0 + kAnswers);
}

}  // namespace
}  // namespace sensory_growth::node::testing
