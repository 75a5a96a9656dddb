/// Input that makes no sense changes nothing, is counted by reason, and leaves the simulation running.

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ros/diagnostics_listener.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(BadInput, ChangesNothingAndIsCounted) {
  NodeUnderTest node;
  DiagnosticsListener diagnostics;
  ros::NodeHandle relative;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 100);
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 100);
  ros::Publisher clicks = relative.advertise<geometry_msgs::PointStamped>("clicked_point", 100);
  ros::Publisher suns = relative.advertise<geometry_msgs::Vector3Stamped>("sun", 100);

  node.stepTo(5, 0);
  std::uint64_t malformed = 0, unknown = 0;
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    node.publish(lamps, lamp(PointSource::ADD, "lamp", {bad, 0.0, 0.1}));
    node.publish(lamps, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.1}, bad));
    node.publish(lights, light(LightDirection::ADD, "light", {0.0, bad, 1.0}));
    node.publish(lights, light(LightDirection::ADD, "light", {1.0, 0.0, 0.0}, bad));
    geometry_msgs::PointStamped click;
    click.point.z = bad;
    node.publish(clicks, click);
    geometry_msgs::Vector3Stamped sun;
    sun.vector.x = bad;
    node.publish(suns, sun);
    malformed += 6;
  }
  node.publish(lights, light(LightDirection::ADD, "light", {0.0, 0.0, 0.0}));
  node.publish(suns, geometry_msgs::Vector3Stamped());
  node.publish(lamps, lamp(PointSource::ADD, "", {0.1, 0.0, 0.1}));
  node.publish(lights, light(LightDirection::ADD, "", {1.0, 0.0, 0.0}));
  malformed += 4;
  for (const std::uint8_t operation : {0, 4, 255}) {
    node.publish(lamps, lamp(operation, "lamp", {0.1, 0.0, 0.1}));
    node.publish(lights, light(operation, "light", {1.0, 0.0, 0.0}));
    unknown += 2;
  }
  const Status refused = node.waitForStatus(
      "refusals", [&](const Status& status) { return status.stimuli_refused >= malformed + unknown; });
  EXPECT_EQ(refused.stimuli_refused, malformed + unknown);
  EXPECT_EQ(refused.stimuli_accepted, 0u);

  node.publish(lamps, lamp(PointSource::CHANGE, "nobody", {0.1, 0.0, 0.1}));
  node.publish(lights, light(LightDirection::REMOVE, "nobody", {1.0, 0.0, 0.0}));
  const Status inapplicable = node.waitForStatus("refusals at the step boundary", [&](const Status& status) {
    return status.stimuli_refused >= malformed + unknown + 2;
  });
  EXPECT_EQ(inapplicable.stimuli_refused, malformed + unknown + 2);
  EXPECT_EQ(inapplicable.stimuli_accepted, 0u);
  EXPECT_FALSE(node.applied(0).accepted);
  EXPECT_FALSE(node.applied(1).accepted);
  EXPECT_EQ(node.applied(0).id, "nobody");

  diagnostics.waitForValue("stimuli", "malformed", std::to_string(malformed));
  diagnostics.waitForValue("stimuli", "unknown operation", std::to_string(unknown));
  diagnostics.waitForValue("stimuli", "not applicable", "2");
  diagnostics.waitForValue("stimuli", "accepted", "0");

  simulation::Simulation alone = simulationAlone();
  for (int i = 0; i < 15; ++i) ASSERT_TRUE(alone.step().ok);
  const OrganState state = node.stepTo(15, 5);
  expectSame(state, alone);
  for (const auto& position : state.positions) {
    EXPECT_TRUE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
