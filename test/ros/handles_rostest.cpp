/// Stimuli by hand: the test plays the part of rviz, which shows handles and says what the mouse does to them.

#include <gtest/gtest.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>

#include <cmath>
#include <limits>
#include <set>

#include "ros/marker_lint.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerFeedback;

geometry_msgs::Pose poseAt(double x, double y, double z) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.position.y = y;
  pose.position.z = z;
  pose.orientation.w = 1.0;
  return pose;
}

/// A pose whose x axis is +z of the world, turned by a quarter about -y.
geometry_msgs::Pose turnedUp() {
  geometry_msgs::Pose pose;
  pose.orientation.w = std::sqrt(0.5);
  pose.orientation.y = -std::sqrt(0.5);
  return pose;
}

/// The handles as rviz has them, and the mouse.
class Rviz {
 public:
  explicit Rviz(NodeUnderTest& node)
      : feedback_(node.handle().advertise<InteractiveMarkerFeedback>("stimulus_handles/feedback", 1000)),
        full_(node.handle().subscribe("stimulus_handles/update_full", 100, &Rviz::takeAll, this)),
        update_(node.handle().subscribe("stimulus_handles/update", 1000, &Rviz::takeUpdate, this)) {
    waitFor("new");
  }

  /// The handle, once it is there.
  InteractiveMarker waitFor(const std::string& name) {
    return waitUntil(name, [](const InteractiveMarker&) { return true; });
  }

  /// The handle, once it has been at `x`.
  InteractiveMarker waitForX(const std::string& name, double x) {
    return waitUntil(name, [x](const InteractiveMarker& handle) { return handle.pose.position.x == x; });
  }

  void waitForMove(const std::string& name) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return moves_[name] > 0; })) << "no update of " << name;
  }

  void waitUntilGone(const std::string& name) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return handles_.count(name) == 0; })) << name << " stays";
  }

  InteractiveMarkerFeedback feedback(const std::string& name, std::uint8_t event,
                                     const geometry_msgs::Pose& pose = poseAt(0.0, 0.0, 0.0)) {
    InteractiveMarkerFeedback message;
    message.header.frame_id = "world";
    message.client_id = "rviz";
    message.marker_name = name;
    message.event_type = event;
    message.pose = pose;
    return message;
  }

  void send(NodeUnderTest& node, const InteractiveMarkerFeedback& message) { node.publish(feedback_, message); }

  AppliedCommand sendAndWait(NodeUnderTest& node, const InteractiveMarkerFeedback& message) {
    return node.send(feedback_, message);
  }

  /// Chooses the entry with that title from the menu of a handle.
  AppliedCommand choose(NodeUnderTest& node, const std::string& name, const std::string& title) {
    InteractiveMarkerFeedback message = feedback(name, InteractiveMarkerFeedback::MENU_SELECT);
    const InteractiveMarker handle = waitFor(name);
    message.pose = handle.pose;
    for (const auto& entry : handle.menu_entries) {
      if (entry.title == title) message.menu_entry_id = entry.id;
    }
    EXPECT_NE(message.menu_entry_id, 0u) << "no entry " << title;
    return sendAndWait(node, message);
  }

 private:
  void takeAll(const visualization_msgs::InteractiveMarkerInit& all) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (all.seq_num < sequence_) return;  // it comes on a connection of its own, later than an update that it precedes
    sequence_ = all.seq_num;
    handles_.clear();
    for (const InteractiveMarker& handle : all.markers) handles_[handle.name] = handle;
    changed_.notify_all();
  }

  void takeUpdate(const visualization_msgs::InteractiveMarkerUpdate& update) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& moved : update.poses) ++moves_[moved.name];
    if (update.seq_num > sequence_) {
      sequence_ = update.seq_num;
      for (const InteractiveMarker& handle : update.markers) handles_[handle.name] = handle;
      for (const auto& moved : update.poses) handles_[moved.name].pose = moved.pose;
      for (const std::string& name : update.erases) handles_.erase(name);
    }
    changed_.notify_all();
  }

  template <typename Predicate>
  InteractiveMarker waitUntil(const std::string& name, const Predicate& holds) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return handles_.count(name) && holds(handles_[name]); }))
        << "waited in vain for handle " << name;
    return handles_[name];
  }

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::uint64_t sequence_ = 0;
  std::map<std::string, InteractiveMarker> handles_;
  std::map<std::string, int> moves_;

  ros::Publisher feedback_;
  ros::Subscriber full_, update_;  // last, so that callbacks end before what they touch
};

/// The frame "table": 1 m along x, turned by 90 degrees about z.
class Table {
 public:
  Table() {
    geometry_msgs::TransformStamped table;
    table.header.frame_id = "world";
    table.child_frame_id = "table";
    table.transform.translation.x = 1.0;
    table.transform.rotation.z = table.transform.rotation.w = std::sqrt(0.5);
    broadcaster_.sendTransform(table);
  }

 private:
  tf2_ros::StaticTransformBroadcaster broadcaster_;
};

/// Each test begins paused at step 0, in the dark.
class Handles : public ::testing::Test {
 protected:
  Handles()
      : lamps_(node_.handle().advertise<PointSource>("point_source", 10)),
        lights_(node_.handle().advertise<LightDirection>("light_direction", 10)),
        rviz_(node_) {
    EXPECT_TRUE(node_.command("pause").success);
    EXPECT_TRUE(node_.command("reset").success);
    node_.waitForStimuli("darkness", [](const Stimuli& s) { return s.point_sources.empty() && s.step_index == 0; });
    rviz_.waitUntilGone("point_source/lamp");
    rviz_.waitUntilGone("light_direction/sun");
  }

  void addLamp(double x, double strength = 1.0) {
    EXPECT_TRUE(node_.send(lamps_, lamp(PointSource::ADD, "lamp", {x, 0.0, 0.05}, strength)).accepted);
    rviz_.waitForX("point_source/lamp", x);
  }

  void addSun() {
    EXPECT_TRUE(node_.send(lights_, light(LightDirection::ADD, "sun", {1.0, 0.0, 0.0}, 0.5)).accepted);
    rviz_.waitFor("light_direction/sun");
  }

  std::uint64_t refused() {
    return node_.waitForStatus("status", [](const Status&) { return true; }).stimuli_refused;
  }

  Table table_;  // first, so that the node has long heard of it
  NodeUnderTest node_;
  ros::Publisher lamps_, lights_;
  Rviz rviz_;
};

TEST_F(Handles, ALampIsDragged) {
  addLamp(0.1, 2.0);
  rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::MOUSE_DOWN));
  const AppliedCommand dragged = rviz_.sendAndWait(
      node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.12, 0.01, 0.06)));
  EXPECT_EQ(dragged.kind, AppliedCommand::POINT_SOURCE);
  EXPECT_EQ(dragged.operation, AppliedCommand::CHANGE);
  EXPECT_TRUE(dragged.accepted) << dragged.refusal;
  EXPECT_EQ(dragged.id, "lamp");
  EXPECT_EQ(dragged.vector.x, 0.12);
  EXPECT_EQ(dragged.vector.y, 0.01);
  EXPECT_EQ(dragged.vector.z, 0.06);
  EXPECT_EQ(dragged.strength, 2.0);
  rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::MOUSE_UP));
  rviz_.waitForX("point_source/lamp", 0.12);
}

TEST_F(Handles, ALightIsTurned) {
  addSun();
  const AppliedCommand turned = rviz_.sendAndWait(
      node_, rviz_.feedback("light_direction/sun", InteractiveMarkerFeedback::POSE_UPDATE, turnedUp()));
  EXPECT_EQ(turned.kind, AppliedCommand::LIGHT_DIRECTION);
  EXPECT_NEAR(turned.vector.x, 0.0, 1e-12);
  EXPECT_NEAR(turned.vector.z, 1.0, 1e-12);
  EXPECT_EQ(turned.strength, 0.5);
}

TEST_F(Handles, HundredsOfMovesWithinAStepAreOneChange) {
  constexpr int kMoves = 300;
  addLamp(0.1);
  ASSERT_TRUE(node_.command("resume").success);  // the first step is due in eleven days
  const Status before = node_.waitForStatus("running", [](const Status& s) { return s.mode == Status::RUNNING; });
  for (int i = 1; i <= kMoves; ++i) {
    rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE,
                                     poseAt(0.1 + 1e-4 * i, 0.0, 0.05)));
  }
  // What is refused shows in the status at once, and with it what waits for the step.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(nan, 0.0, 0.0)));
  const Status after = node_.waitForStatus(
      "a refusal", [&](const Status& status) { return status.stimuli_refused > before.stimuli_refused; });
  EXPECT_EQ(after.stimuli_accepted, before.stimuli_accepted + 1);
  EXPECT_EQ(after.step_index, 0u);
  node_.waitForStimuli("the last move", [](const Stimuli& stimuli) {
    return stimuli.point_sources.size() == 1 && stimuli.point_sources[0].position.x == 0.1 + 1e-4 * kMoves;
  });
}

TEST_F(Handles, FollowStimuliFromElsewhereButNotAgainstTheMouse) {
  addLamp(0.1);
  rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::MOUSE_DOWN));
  rviz_.sendAndWait(
      node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.11, 0.0, 0.05)));
  rviz_.waitForX("point_source/lamp", 0.11);

  EXPECT_TRUE(node_.send(lamps_, lamp(PointSource::CHANGE, "lamp", {0.2, 0.0, 0.05}, 3.0)).accepted);
  addSun();  // once its handle is there, the handles have been shown again
  EXPECT_EQ(rviz_.waitFor("point_source/lamp").pose.position.x, 0.11);

  // What the mouse does next keeps the strength that somebody else has set.
  const AppliedCommand dragged = rviz_.sendAndWait(
      node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.13, 0.0, 0.05)));
  EXPECT_EQ(dragged.strength, 3.0);
  EXPECT_TRUE(node_.send(lamps_, lamp(PointSource::CHANGE, "lamp", {0.2, 0.0, 0.05})).accepted);
  rviz_.send(node_, rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::MOUSE_UP));
  rviz_.waitForX("point_source/lamp", 0.2);

  EXPECT_TRUE(node_.send(lamps_, lamp(PointSource::REMOVE, "lamp", rod::Vector3::Zero())).accepted);
  rviz_.waitUntilGone("point_source/lamp");
}

TEST_F(Handles, MenusChangeStrengthAndSign) {
  addLamp(0.1);
  EXPECT_EQ(rviz_.choose(node_, "point_source/lamp", "Double").strength, 2.0);
  EXPECT_EQ(rviz_.choose(node_, "point_source/lamp", "Double").strength, 4.0);
  EXPECT_EQ(rviz_.choose(node_, "point_source/lamp", "Halve").strength, 2.0);
  const AppliedCommand repels = rviz_.choose(node_, "point_source/lamp", "Repel");
  EXPECT_EQ(repels.strength, -2.0);
  EXPECT_EQ(repels.vector.x, 0.1);
  EXPECT_EQ(rviz_.choose(node_, "point_source/lamp", "5").strength, -5.0);  // a size keeps the sign
  EXPECT_EQ(rviz_.choose(node_, "point_source/lamp", "Attract").strength, 5.0);
}

TEST_F(Handles, MenusAddAndRemove) {
  InteractiveMarkerFeedback place =
      rviz_.feedback("new", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.07, 0.01, 0.02));
  rviz_.send(node_, place);
  rviz_.waitForX("new", 0.07);
  const AppliedCommand first = rviz_.choose(node_, "new", "Add lamp here");
  EXPECT_EQ(first.operation, AppliedCommand::ADD);
  EXPECT_EQ(first.vector.x, 0.07);
  EXPECT_EQ(first.strength, 1.0);
  const AppliedCommand second = rviz_.choose(node_, "new", "Add lamp here");
  EXPECT_NE(second.id, first.id);
  const AppliedCommand above = rviz_.choose(node_, "new", "Add light");
  EXPECT_EQ(above.kind, AppliedCommand::LIGHT_DIRECTION);
  EXPECT_EQ(above.vector.z, 1.0);

  const AppliedCommand removed = rviz_.choose(node_, "point_source/" + first.id, "Remove");
  EXPECT_EQ(removed.operation, AppliedCommand::REMOVE);
  EXPECT_EQ(removed.id, first.id);
  EXPECT_TRUE(removed.accepted) << removed.refusal;
  rviz_.waitUntilGone("point_source/" + first.id);
  rviz_.waitFor("point_source/" + second.id);
}

TEST_F(Handles, RefuseWhatMakesNoSenseAndShowWhatIs) {
  addLamp(0.1);
  addSun();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  geometry_msgs::Pose nowhere;  // a quaternion of zeros
  const InteractiveMarkerFeedback bad[] = {
      rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(nan, 0.0, 0.0)),
      rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.0, 0.0, -infinity)),
      rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(2e6, 0.0, 0.0)),
      rviz_.feedback("light_direction/sun", InteractiveMarkerFeedback::POSE_UPDATE, nowhere),
      rviz_.feedback("new", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.0, nan, 0.0))};
  std::uint64_t count = refused();
  const std::size_t applied = node_.appliedCount();
  for (const InteractiveMarkerFeedback& message : bad) {
    rviz_.send(node_, message);
    ++count;
    node_.waitForStatus("a refusal", [count](const Status& status) { return status.stimuli_refused == count; });
  }
  EXPECT_EQ(node_.appliedCount(), applied);
  rviz_.waitForX("point_source/lamp", 0.1);
}

TEST_F(Handles, FeedbackInAnotherFrameIsTransformed) {
  addLamp(0.1);
  InteractiveMarkerFeedback on_table =
      rviz_.feedback("point_source/lamp", InteractiveMarkerFeedback::POSE_UPDATE, poseAt(0.5, 0.0, 0.2));
  on_table.header.frame_id = "table";
  const AppliedCommand moved = rviz_.sendAndWait(node_, on_table);
  EXPECT_NEAR(moved.vector.x, 1.0, 1e-12);
  EXPECT_NEAR(moved.vector.y, 0.5, 1e-12);
  EXPECT_NEAR(moved.vector.z, 0.2, 1e-12);
}

TEST_F(Handles, AreShownToWhoComesWhileTimeStandsStill) {
  Rviz late(node_);
  late.waitForMove("new");  // rviz waits for an update before it shows anything
}

TEST_F(Handles, PleaseRviz) {
  addLamp(0.1);
  addSun();
  for (const char* name : {"point_source/lamp", "light_direction/sun", "new"}) {
    const InteractiveMarker handle = rviz_.waitFor(name);
    EXPECT_EQ(handle.header.frame_id, "world");
    EXPECT_GT(handle.scale, 0.0F);
    EXPECT_FALSE(handle.menu_entries.empty());
    std::set<std::string> names;
    for (const auto& control : handle.controls) {
      EXPECT_TRUE(names.insert(control.name).second) << control.name;
      const auto& q = control.orientation;
      EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-6) << control.name;
      std::vector<std::string> faults;
      for (const auto& marker : control.markers) MarkerLint(marker, faults).added();
      for (const std::string& fault : faults) ADD_FAILURE() << control.name << ": " << fault;
    }
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
