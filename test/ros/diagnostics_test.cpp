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
