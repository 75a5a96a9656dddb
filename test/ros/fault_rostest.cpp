/// A step that fails: the last good state stays, everybody is told why, nothing that is not a number gets out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <regex>
#include <sstream>

#include "ros/diagnostics_listener.h"
#include "ros/message_log.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

using ::testing::HasSubstr;

/// Lines of all messages that hold a number which is none.
template <typename Message>
std::string notFinite(MessageLog<Message>& log) {
  static const std::regex pattern(": [-+]?(nan|inf)");
  std::string found;
  for (const Message& message : log.all()) {
    std::ostringstream text;
    text << message;
    std::istringstream lines(text.str());
    for (std::string line; std::getline(lines, line);) {
      if (std::regex_search(line, pattern)) found += line + '\n';
    }
  }
  return found;
}

TEST(Fault, KeepsTheLastGoodStateAndSaysWhy) {
  NodeUnderTest node;
  DiagnosticsListener diagnostics;
  MessageLog<OrganState> states("/sensory_growth/organs/shoot/state");
  MessageLog<Status> statuses("/sensory_growth/status");
  MessageLog<Stimuli> stimuli("/sensory_growth/stimuli");
  MessageLog<AppliedCommand> commands("/sensory_growth/applied_commands");
  MessageLog<tf2_msgs::TFMessage> transforms("/tf");
  MessageLog<visualization_msgs::MarkerArray> markers("/sensory_growth/markers");

  const OrganState good = node.stepTo(5, 0);
  ASSERT_TRUE(node.setGravity({0.0, 0.0, -1e6}).success);  // the organ folds between two elements
  const Step::Response failed = node.step(3);
  EXPECT_FALSE(failed.success);
  EXPECT_EQ(failed.step_index, 5u);
  EXPECT_EQ(failed.stamp, good.header.stamp);
  for (const char* part : {"organ 'shoot' failed in step 6", "scaled residual", "at element"}) {
    EXPECT_THAT(failed.message, HasSubstr(part));
  }

  const Status status = node.waitForStatus("the fault", [](const Status& s) { return s.mode == Status::FAULT; });
  EXPECT_EQ(status.step_index, 5u);
  EXPECT_THAT(status.message, HasSubstr("organ 'shoot' failed in step 6"));
  const std::string simulation = diagnostics.waitFor("simulation", "fault: organ 'shoot' failed in step 6");
  EXPECT_THAT(simulation, HasSubstr("scaled residual"));
  EXPECT_THAT(diagnostics.waitFor("organ shoot", "relaxation failed"), HasSubstr("at element"));

  // Whoever comes late sees the last good state.
  MessageLog<OrganState> late("/sensory_growth/organs/shoot/state");
  late.waitForCount(1);
  EXPECT_EQ(late.all().front().step_index, 5u);
  EXPECT_EQ(late.all().front().positions, good.positions);

  for (const char* refused : {"resume", "step"}) {
    const std::string message = refused == std::string("step") ? node.step(1).message : node.command(refused).message;
    EXPECT_THAT(message, HasSubstr("reset first: organ 'shoot'"));
  }

  ASSERT_TRUE(node.command("reset").success);
  node.countReset();
  diagnostics.waitFor("simulation", "paused");
  diagnostics.waitFor("organ shoot", "in equilibrium");
  simulation::Simulation alone = simulationAlone();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(alone.step().ok);
  const OrganState again = node.stepTo(5, 0);
  expectSame(again, alone);
  EXPECT_EQ(again.positions, good.positions);

  EXPECT_EQ(notFinite(states), "");
  EXPECT_EQ(notFinite(statuses), "");
  EXPECT_EQ(notFinite(stimuli), "");
  EXPECT_EQ(notFinite(commands), "");
  EXPECT_EQ(notFinite(transforms), "");
  EXPECT_EQ(notFinite(markers), "");
}

}  // namespace
}  // namespace sensory_growth::node::testing
