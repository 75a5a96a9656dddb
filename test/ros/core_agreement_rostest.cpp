/// What the node publishes are the numbers of the core, bit for bit, at the steps where its commands were taken.

#include <gtest/gtest.h>

#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

simulation::StimulusCommand commandOf(const AppliedCommand& applied) {
  return {applied.kind == AppliedCommand::POINT_SOURCE ? simulation::StimulusKind::point_source
                                                       : simulation::StimulusKind::light_direction,
          simulation::StimulusOperation::add, applied.id,
          rod::Vector3(applied.vector.x, applied.vector.y, applied.vector.z), applied.strength};
}

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
  alone.apply(commandOf(sun));
  follow(10, 40);
  const AppliedCommand lit = node.send(lamps, lamp(PointSource::ADD, "lamp", {-0.1, 0.05, 0.1}, 1.3));
  EXPECT_EQ(lit.step_index, 40u);
  EXPECT_EQ(lit.vector.x, -0.1);
  alone.apply(commandOf(lit));
  follow(40, 70);

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
