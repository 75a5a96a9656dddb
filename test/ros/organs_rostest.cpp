/// Organs that come and go while the node runs, and everything that is said of them.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <map>
#include <string>

#include "ros/message_log.h"
#include "ros/node_under_test.h"
#include "sensory_growth/RemoveOrgan.h"
#include "sensory_growth/SpawnOrgan.h"
#include "sensory_growth/simulation/checksum.h"
#include "support/spawned_organ.h"

namespace sensory_growth::node::testing {
namespace {

using support::organText;
using ::testing::HasSubstr;
using visualization_msgs::Marker;

class Organs : public ::testing::Test {
 protected:
  /// Each test begins paused at step 0 with the organ of the scenario.
  Organs() {
    EXPECT_TRUE(node_.command("pause").success);
    EXPECT_TRUE(node_.command("reset").success);
    node_.waitForStatus("step 0", [](const Status& s) { return s.mode == Status::PAUSED && s.step_index == 0; });
  }

  SpawnOrgan::Response spawn(const std::string& organ) {
    SpawnOrgan::Request request;
    request.organ = organ;
    return node_.call<SpawnOrgan>("spawn_organ", request);
  }

  RemoveOrgan::Response remove(const std::string& id) {
    RemoveOrgan::Request request;
    request.id = id;
    return node_.call<RemoveOrgan>("remove_organ", request);
  }

  static bool isAdvertised(const std::string& topic) {
    ros::master::V_TopicInfo topics;
    EXPECT_TRUE(ros::master::getTopics(topics));
    return std::any_of(topics.begin(), topics.end(), [&](const auto& info) { return info.name == topic; });
  }

  NodeUnderTest node_;
};

bool hasFrame(const tf2_msgs::TFMessage& message, const std::string& frame) {
  return std::any_of(message.transforms.begin(), message.transforms.end(),
                     [&](const auto& transform) { return transform.child_frame_id == frame; });
}

bool hasMarker(const visualization_msgs::MarkerArray& array, const std::string& ns, int action) {
  return std::any_of(array.markers.begin(), array.markers.end(),
                     [&](const Marker& marker) { return marker.ns == ns && marker.action == action; });
}

TEST_F(Organs, AreThereWhenTheServiceAnswersAndGrowAsInTheCore) {
  ASSERT_TRUE(node_.step(3).success);
  const SpawnOrgan::Response spawned = spawn(organText("late"));
  ASSERT_TRUE(spawned.success) << spawned.message;
  EXPECT_EQ(spawned.step_index, 3u);
  EXPECT_TRUE(isAdvertised("/sensory_growth/organs/late/state"));
  MessageLog<OrganState> states("/sensory_growth/organs/late/state");
  const auto stateOf = [&](std::uint64_t step) {
    return states.waitFor("state of step " + std::to_string(step),
                          [&](const OrganState& s) { return s.step_index == step; });
  };
  EXPECT_EQ(stateOf(3).header.stamp, spawned.stamp);
  EXPECT_NEAR(stateOf(3).rest_length, 0.02, 1e-15);
  ASSERT_TRUE(node_.step(5).success);
  EXPECT_GT(stateOf(8).rest_length, 0.0202);
  ASSERT_TRUE(remove("late").success);
  EXPECT_FALSE(isAdvertised("/sensory_growth/organs/late/state"));
  ASSERT_TRUE(node_.step(2).success);

  simulation::Simulation alone = simulationAlone();
  for (int i = 0; i < 10; ++i) {
    if (i == 3) alone.apply(simulation::SpawnCommand{organText("late")});
    if (i == 8) alone.apply(simulation::RemoveCommand{"late"});
    ASSERT_TRUE(alone.step().ok);
  }
  const Status status = node_.waitForStatus("step 10", [](const Status& s) { return s.step_index == 10; });
  EXPECT_EQ(status.checksum, simulation::checksum(alone));
}

TEST_F(Organs, AreEchoed) {
  ASSERT_TRUE(spawn(organText("late")).success);
  ASSERT_TRUE(remove("late").success);
  EXPECT_EQ(node_.applied(0).kind, AppliedCommand::SPAWN_ORGAN);
  EXPECT_EQ(node_.applied(0).organ, organText("late"));
  EXPECT_TRUE(node_.applied(0).accepted);
  EXPECT_EQ(node_.applied(1).kind, AppliedCommand::REMOVE_ORGAN);
  EXPECT_EQ(node_.applied(1).id, "late");
}

TEST_F(Organs, AreRefusedWithAReason) {
  EXPECT_THAT(spawn(organText("shoot")).message, HasSubstr("there is an organ 'shoot' already"));
  EXPECT_THAT(spawn("id: late\n").message, HasSubstr("organ:1: length: is missing"));
  EXPECT_THAT(remove("late").message, HasSubstr("there is no organ 'late'"));
  EXPECT_FALSE(node_.applied(2).accepted);
  EXPECT_TRUE(node_.step(1).success);
}

TEST_F(Organs, HaveFramesWhileTheyAreThere) {
  MessageLog<tf2_msgs::TFMessage> moving("/tf"), fixed("/tf_static");
  moving.connect([this] { node_.step(1); });
  fixed.waitFor("base of the shoot", [](const auto& m) { return hasFrame(m, "shoot/base"); });
  ASSERT_TRUE(spawn(organText("late")).success);
  const auto base = fixed.waitFor("base", [](const auto& m) { return hasFrame(m, "late/base"); });
  EXPECT_TRUE(hasFrame(base, "shoot/base"));
  ASSERT_TRUE(node_.step(1).success);
  moving.waitFor("tip", [](const auto& m) { return hasFrame(m, "late/tip"); });

  fixed.forget();
  ASSERT_TRUE(remove("late").success);
  fixed.waitFor("end of the base", [](const auto& m) { return !hasFrame(m, "late/base"); });
  moving.forget();
  ASSERT_TRUE(node_.step(1).success);
  const auto after = moving.waitFor("tip of the shoot", [](const auto& m) { return hasFrame(m, "shoot/tip"); });
  EXPECT_FALSE(hasFrame(after, "late/tip"));
  MessageLog<tf2_msgs::TFMessage> late_joiner("/tf_static");
  EXPECT_FALSE(hasFrame(late_joiner.waitFor("latched bases", [](const auto&) { return true; }), "late/base"));
}

TEST_F(Organs, SendNoTransformTwice) {
  MessageLog<tf2_msgs::TFMessage> moving("/tf");
  moving.connect([this] { node_.step(1); });
  std::map<std::string, ros::Time> sent;
  ASSERT_TRUE(spawn(organText("late")).success);
  ASSERT_TRUE(remove("late").success);
  ASSERT_TRUE(spawn(organText("late")).success);
  const ros::Time last = node_.step(1).stamp;
  moving.waitFor("last step", [&](const tf2_msgs::TFMessage& message) {
    for (const auto& transform : message.transforms) {
      EXPECT_GT(transform.header.stamp, sent[transform.child_frame_id]) << transform.child_frame_id;
      sent[transform.child_frame_id] = transform.header.stamp;
    }
    return message.transforms.front().header.stamp == last;
  });
}

TEST_F(Organs, AreDrawnAndDeleted) {
  MessageLog<visualization_msgs::MarkerArray> markers("/sensory_growth/markers");
  ASSERT_TRUE(spawn(organText("late")).success);
  markers.waitFor("body", [](const auto& array) { return hasMarker(array, "late/body", Marker::ADD); });
  ASSERT_TRUE(remove("late").success);
  const auto gone =
      markers.waitFor("end", [](const auto& array) { return hasMarker(array, "late/body", Marker::DELETE); });
  EXPECT_TRUE(hasMarker(gone, "late/tip", Marker::DELETE));
  EXPECT_TRUE(hasMarker(gone, "shoot/body", Marker::ADD));
}

TEST_F(Organs, HaveDiagnosticsWhileTheyAreThere) {
  MessageLog<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const auto tells = [](const diagnostic_msgs::DiagnosticArray& array) {
    return std::any_of(array.status.begin(), array.status.end(), [](const auto& status) {
      return status.name == "sensory_growth: organ late" && status.message == "in equilibrium";
    });
  };
  ASSERT_TRUE(spawn(organText("late")).success);
  diagnostics.waitFor("entry", tells);
  ASSERT_TRUE(remove("late").success);
  diagnostics.forget();
  diagnostics.waitFor("entries of the others alone",
                      [&](const auto& array) { return array.status.size() > 1 && !tells(array); });
}

TEST_F(Organs, ComeBackWithAReset) {
  ASSERT_TRUE(spawn(organText("late")).success);
  ASSERT_TRUE(remove("shoot").success);
  ASSERT_TRUE(node_.step(2).success);
  ASSERT_TRUE(node_.command("reset").success);
  EXPECT_FALSE(isAdvertised("/sensory_growth/organs/late/state"));
  EXPECT_TRUE(isAdvertised("/sensory_growth/organs/shoot/state"));
  const Status status = node_.waitForStatus("step 0", [](const Status& s) { return s.step_index == 0; });
  EXPECT_EQ(status.checksum, simulation::checksum(simulationAlone()));
}

}  // namespace
}  // namespace sensory_growth::node::testing
