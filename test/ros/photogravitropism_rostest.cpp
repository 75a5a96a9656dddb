/// Parallel light that is sent while the simulation runs, against gravity: the tip ends where the two balance (Bastien,
/// Douady and Moulia 2015), and the state says what each of them asks for.

#include <gtest/gtest.h>

#include <cmath>

#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

Eigen::Vector2d atTheLastBend(const std::vector<geometry_msgs::Vector3>& cue) { return {cue.back().x, cue.back().y}; }

TEST(Photogravitropism, TipPointsWhereLightAndGravityBalance) {
  NodeUnderTest node;
  ros::Publisher topic = node.handle().advertise<LightDirection>("light_direction", 10);

  // tan A = nu sin P / (beta + nu cos P) with nu / beta = 1 / 2 and the light at P from the vertical.
  const double P = 100.0 * M_PI / 180.0;
  const auto added = node.send(topic, light(LightDirection::ADD, "window", {std::sin(P), 0.0, std::cos(P)}));
  EXPECT_TRUE(added.accepted) << added.refusal;
  const OrganState state = node.stepTo(60, 0);
  const rod::Vector3 direction = tipDirection(state);
  const double expected = std::atan2(0.5 * std::sin(P), 1.0 + 0.5 * std::cos(P));
  EXPECT_NEAR(std::atan2(direction.x(), direction.z()), expected, 0.2 * M_PI / 180.0);

  // There the two cues are as large as their components across the tip, and cancel.
  const Eigen::Vector2d up = atTheLastBend(state.gravity_cue), lit = atTheLastBend(state.light_direction_cue);
  EXPECT_NEAR(up.norm(), 0.8 * std::sin(expected), 2e-3);
  EXPECT_LT((up + lit).norm(), 2e-3);
  EXPECT_EQ(atTheLastBend(state.point_source_cue), Eigen::Vector2d::Zero());
  EXPECT_EQ(atTheLastBend(state.oscillator_cue), Eigen::Vector2d::Zero());
  EXPECT_EQ(state.gravity_cue.size(), state.curvature.size());
}

}  // namespace
}  // namespace sensory_growth::node::testing
