/// A lamp that is sent while the simulation runs steers the organ; without it, gravitropism wins.

#include <gtest/gtest.h>

#include <cmath>

#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

/// Angle between the tip and the way to the lamp [rad].
double missedBy(const OrganState& state, const rod::Vector3& lamp) {
  return std::acos(tipDirection(state).dot((lamp - tipPosition(state)).normalized()));
}

TEST(Phototropism, TipFollowsALampAndRightsItselfWithoutOne) {
  const rod::Vector3 right(0.2, 0.0, 0.05), left(-0.2, 0.0, 0.05);
  NodeUnderTest node;
  ros::Publisher topic = node.handle().advertise<PointSource>("point_source", 10);

  EXPECT_NEAR(tipDirection(node.state(0)).z(), 1.0, 1e-12);

  const AppliedCommand added = node.send(topic, lamp(PointSource::ADD, "lamp", right));
  EXPECT_TRUE(added.accepted) << added.refusal;
  EXPECT_EQ(added.step_index, 0u);
  const OrganState lit = node.stepTo(80, 0);
  EXPECT_LT(missedBy(lit, right), 0.6);  // the balance of light and gravity keeps it from pointing at the lamp exactly
  EXPECT_GT(tipDirection(lit).x(), 0.5);

  const AppliedCommand moved = node.send(topic, lamp(PointSource::CHANGE, "lamp", left));
  EXPECT_EQ(moved.step_index, 80u);
  const OrganState followed = node.stepTo(200, 80);
  EXPECT_LT(missedBy(followed, left), 0.6);
  EXPECT_LT(tipDirection(followed).x(), -0.5);

  node.send(topic, lamp(PointSource::REMOVE, "lamp", rod::Vector3::Zero()));
  const OrganState dark = node.stepTo(400, 200);
  EXPECT_GT(tipDirection(dark).z(), 0.95);
}

}  // namespace
}  // namespace sensory_growth::node::testing
