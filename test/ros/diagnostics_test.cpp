#include "sensory_growth/ros/diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

#include "ros/snapshots.h"

namespace sensory_growth::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

TEST(RelaxationDiagnostics, FollowTheReason) {
  OrganSnapshot organ = testing::straightOrgan("stem");
  const auto level = [&] {
    DiagnosticStatusWrapper status;
    reportRelaxation(organ, status);
    return status.level;
  };
  EXPECT_EQ(level(), DiagnosticStatus::OK);
  organ.report.retries = 1;
  EXPECT_EQ(level(), DiagnosticStatus::WARN);
  organ.report.retries = 0;
  organ.report.largest_differential_growth = 1.5;
  EXPECT_EQ(level(), DiagnosticStatus::WARN);
  organ.report.fault = simulation::OrganFault::relaxation;
  EXPECT_EQ(level(), DiagnosticStatus::ERROR);
}

TEST(LoopDiagnostics, AFaultIsAnError) {
  const auto snapshot = testing::snapshotOf("stem");
  DiagnosticStatusWrapper status;
  reportLoop({Mode::fault, "organ stem does not converge", 0.0, 0}, *snapshot, status);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(status.message, "fault: organ stem does not converge");
}

TEST(RecordingDiagnostics, AFailureIsShownUntilTheNextRecording) {
  DiagnosticStatusWrapper off, writing, failed;
  reportRecording("", "", off);
  EXPECT_EQ(off.level, DiagnosticStatus::OK);
  EXPECT_EQ(off.message, "off");
  reportRecording("/run.bag", "", writing);
  EXPECT_EQ(writing.message, "writing /run.bag");
  reportRecording("", "/run.bag: No space left on device", failed);
  EXPECT_EQ(failed.level, DiagnosticStatus::WARN);
  EXPECT_EQ(failed.message, "failed: /run.bag: No space left on device");
}

TEST(ClockDiagnostics, ThereMustBeOneOwner) {
  const auto level = [](ClockMode mode, const std::vector<std::string>& others) {
    DiagnosticStatusWrapper status;
    reportClock(mode, others, status);
    return status.level;
  };
  EXPECT_EQ(level(ClockMode::publish, {}), DiagnosticStatus::OK);
  EXPECT_EQ(level(ClockMode::publish, {"/player"}), DiagnosticStatus::ERROR);
  EXPECT_EQ(level(ClockMode::follow, {}), DiagnosticStatus::WARN);
  EXPECT_EQ(level(ClockMode::follow, {"/player"}), DiagnosticStatus::OK);
  EXPECT_EQ(level(ClockMode::follow, {"/player", "/simulator"}), DiagnosticStatus::ERROR);
}

TEST(MasterDiagnostics, WarnUnlessTheMasterKnowsTheNode) {
  const auto level = [](MasterWatch::State state) {
    DiagnosticStatusWrapper status;
    reportMaster(state, status);
    return status.level;
  };
  EXPECT_EQ(level(MasterWatch::State::known), DiagnosticStatus::OK);
  EXPECT_EQ(level(MasterWatch::State::unreachable), DiagnosticStatus::WARN);
  EXPECT_EQ(level(MasterWatch::State::registered_again), DiagnosticStatus::WARN);
}

TEST(StimulusDiagnostics, WarnWhileRefusalsAreRecent) {
  StimulusCounters counters;
  counters.count(StimulusFate::malformed);
  counters.count(StimulusFate::accepted);
  DiagnosticStatusWrapper recent, past;
  reportStimuli(counters, 0, recent);
  EXPECT_EQ(recent.level, DiagnosticStatus::WARN);
  reportStimuli(counters, 1, past);
  EXPECT_EQ(past.level, DiagnosticStatus::OK);
}

}  // namespace
}  // namespace sensory_growth::node
