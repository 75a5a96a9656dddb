/// What the node publishes are the numbers of the core, bit for bit, at the steps where its commands were taken.

#include <gtest/gtest.h>

#include "ros/node_under_test.h"
#include "sensory_growth/ros/conversions.h"

namespace sensory_growth::node::testing {
namespace {

TEST(CoreAgreement, StatesAreThoseOfTheCoreAlone) {
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 10);
  simulation::Simulation alone = simulationAlone();

  const auto follow = [&](std::uint64_t from, std::uint64_t to) {
    node.stepTo(to, from);
    for (std::uint64_t step = from + 1; step <= to; ++step) {
      ASSERT_TRUE(alone.step().ok);
      expectSame(node.state(step), alone);
    }
  };

  follow(0, 10);
  const AppliedCommand sun = node.send(lights, light(LightDirection::ADD, "sun", {3.0, 1.0, 2.0}, 0.7));
  EXPECT_EQ(sun.step_index, 10u);
  alone.apply(toCommand(sun).value());
  follow(10, 40);
  const AppliedCommand lit = node.send(lamps, lamp(PointSource::ADD, "lamp", {-0.1, 0.05, 0.1}, 1.3));
  EXPECT_EQ(lit.step_index, 40u);
  EXPECT_EQ(lit.vector.x, -0.1);
  alone.apply(toCommand(lit).value());
  follow(40, 50);
  const SetParameter::Response set = node.setParameter("shoot", "sensitivities.gravity", -0.4);
  EXPECT_TRUE(set.success) << set.message;
  EXPECT_EQ(set.step_index, 50u);
  const SetGravity::Response turned = node.setGravity({9.81, 0.0, 0.0});
  EXPECT_TRUE(turned.success) << turned.message;
  alone.apply(toCommand(node.applied(2)).value());
  alone.apply(toCommand(node.applied(3)).value());
  EXPECT_EQ(alone.gravity(), rod::Vector3(9.81, 0.0, 0.0));
  follow(50, 70);

  ASSERT_TRUE(node.command("reset").success);
}

TEST(CoreAgreement, TheSameAgainAfterAReset) {
  NodeUnderTest node;
  ASSERT_TRUE(node.command("reset").success);
  simulation::Simulation alone = simulationAlone();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(alone.step().ok);
  expectSame(node.stepTo(20, 0), alone);
}

}  // namespace
}  // namespace sensory_growth::node::testing
