/// Stimuli in other frames are transformed, standard types work, and the frames of the organ are on tf.

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <map>
#include <string>

#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

/// The frame "bench": 1 m along x, turned by 90 degrees about z.
void publishBench(tf2_ros::StaticTransformBroadcaster& broadcaster) {
  geometry_msgs::TransformStamped bench;
  bench.header.frame_id = "world";
  bench.child_frame_id = "bench";
  bench.transform.translation.x = 1.0;
  bench.transform.rotation.z = bench.transform.rotation.w = std::sqrt(0.5);
  broadcaster.sendTransform(bench);
}

/// Position at rest arc length s [m], linear between the vertices of the message.
rod::Vector3 positionAt(const OrganState& state, double s) {
  std::size_t e = 0;
  while (state.rest_arc_length[e + 1] < s) ++e;
  const double fraction = (s - state.rest_arc_length[e]) / (state.rest_arc_length[e + 1] - state.rest_arc_length[e]);
  const auto &p = state.positions[e], &q = state.positions[e + 1];
  return {p.x + fraction * (q.x - p.x), p.y + fraction * (q.y - p.y), p.z + fraction * (q.z - p.z)};
}

TEST(Frames, PositionsMoveAndTurnDirectionsOnlyTurn) {
  tf2_ros::StaticTransformBroadcaster broadcaster;
  publishBench(broadcaster);
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 10);

  PointSource on_bench = lamp(PointSource::ADD, "lamp", {0.5, 0.0, 0.2});
  on_bench.header.frame_id = "bench";
  const AppliedCommand moved = node.send(lamps, on_bench);
  EXPECT_NEAR(moved.vector.x, 1.0, 1e-12);
  EXPECT_NEAR(moved.vector.y, 0.5, 1e-12);
  EXPECT_NEAR(moved.vector.z, 0.2, 1e-12);

  LightDirection over_bench = light(LightDirection::ADD, "light", {2.0, 0.0, 0.0});
  over_bench.header.frame_id = "bench";
  const AppliedCommand turned = node.send(lights, over_bench);
  EXPECT_NEAR(turned.vector.x, 0.0, 1e-12);
  EXPECT_NEAR(turned.vector.y, 2.0, 1e-12);
}

TEST(Frames, AStimulusOfAFrameOfTheOrganWorksWhilePaused) {
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);
  PointSource above_tip = lamp(PointSource::ADD, "above", {0.0, 0.0, 0.01});
  above_tip.header.frame_id = "shoot/tip";
  const AppliedCommand applied = node.send(lamps, above_tip);
  EXPECT_NEAR(applied.vector.z, 0.04, 1e-6);  // the organ is 30 mm long, less what its weight compresses

  // Stamped later than anything on tf, as by a node on wall time: what stood there last still does.
  above_tip.id = "later";
  const Status status = node.waitForStatus("status", [](const Status&) { return true; });
  above_tip.header.stamp = status.header.stamp + ros::Duration(100.0);
  EXPECT_NEAR(node.send(lamps, above_tip).vector.z, 0.04, 1e-6);
}

TEST(Frames, AnUnknownFrameIsRefusedWithoutHoldingUpOthers) {
  constexpr std::uint64_t kLost = 90;  // more than may wait for a transform
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 100);
  const std::uint64_t refused = node.waitForStatus("status", [](const Status&) { return true; }).stimuli_refused;
  PointSource lost = lamp(PointSource::ADD, "lost", {0.1, 0.0, 0.1});
  lost.header.frame_id = "nowhere";
  for (std::uint64_t i = 0; i < kLost; ++i) {
    lost.id = "lost_" + std::to_string(i);
    node.publish(lamps, lost);
  }
  const AppliedCommand other = node.send(lamps, lamp(PointSource::ADD, "other", {0.1, 0.0, 0.1}));
  EXPECT_EQ(other.id, "other");
  node.waitForStatus("the refusals", [&](const Status& s) { return s.stimuli_refused == refused + kLost; });
  const Stimuli stimuli = node.waitForStimuli("stimuli", [](const Stimuli& s) { return !s.point_sources.empty(); });
  for (const PointSource& source : stimuli.point_sources) EXPECT_NE(source.id.substr(0, 4), "lost");
}

TEST(Frames, EachClickedPointAddsALampAndSunSetsALight) {
  NodeUnderTest node;
  ros::NodeHandle relative;
  ros::Publisher clicks = relative.advertise<geometry_msgs::PointStamped>("clicked_point", 10);
  ros::Publisher suns = relative.advertise<geometry_msgs::Vector3Stamped>("sun", 10);

  geometry_msgs::PointStamped click;
  click.header.frame_id = "world";
  std::map<std::string, double> places;  // by lamp
  for (const double x : {0.1, -0.2}) {
    click.point.x = x;
    const AppliedCommand clicked = node.send(clicks, click);
    EXPECT_EQ(clicked.kind, AppliedCommand::POINT_SOURCE);
    EXPECT_TRUE(places.emplace(clicked.id, x).second) << clicked.id;
  }
  geometry_msgs::Vector3Stamped sun;
  sun.vector.y = 4.0;
  const AppliedCommand shining = node.send(suns, sun);
  EXPECT_EQ(shining.kind, AppliedCommand::LIGHT_DIRECTION);
  EXPECT_EQ(shining.id, "sun");

  const Stimuli stimuli = node.waitForStimuli("the sun", [](const Stimuli& s) {
    for (const auto& light : s.light_directions) {
      if (light.id == "sun") return true;
    }
    return false;
  });
  for (const auto& source : stimuli.point_sources) {
    const auto place = places.find(source.id);
    if (place == places.end()) continue;
    EXPECT_EQ(source.position.x, place->second);
    places.erase(place);
  }
  EXPECT_TRUE(places.empty());  // each click has a lamp
  for (const auto& light : stimuli.light_directions) {
    if (light.id == "sun") {
      EXPECT_EQ(light.towards.y, 1.0);  // a unit vector
    }
  }
}

TEST(Frames, TipAndStationsAreOnTf) {
  tf2::BufferCore transforms;
  tf2_ros::TransformListener listener(transforms);
  NodeUnderTest node;
  const std::uint64_t now = node.waitForStatus("status", [](const Status&) { return true; }).step_index;
  ASSERT_TRUE(node.step(1).success);
  const OrganState state = node.state(now + 1);
  lookUntil("the transforms of the step", [&] {
    return transforms.canTransform("world", "shoot/tip", state.header.stamp) &&
           transforms.canTransform("shoot/base", "shoot/station_2", state.header.stamp);
  });
  const auto tip = transforms.lookupTransform("world", "shoot/tip", state.header.stamp);
  EXPECT_EQ(tip.transform.translation.x, state.tip.position.x);
  EXPECT_EQ(tip.transform.translation.z, state.tip.position.z);
  const auto station = transforms.lookupTransform("shoot/base", "shoot/station_2", state.header.stamp);
  const rod::Vector3 expected = positionAt(state, 2.0 / 3.0 * state.rest_length);  // the base stands in the origin
  EXPECT_NEAR(station.transform.translation.x, expected.x(), 1e-12);
  EXPECT_NEAR(station.transform.translation.y, expected.y(), 1e-12);
  EXPECT_NEAR(station.transform.translation.z, expected.z(), 1e-12);
}

}  // namespace
}  // namespace sensory_growth::node::testing
