#include "sensory_growth/ros/command_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace sensory_growth::node {
namespace {

using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;

StimulusCommand lamp(const std::string& id, StimulusOperation operation, double x) {
  return {StimulusKind::point_source, operation, id, {x, 0.0, 0.0}, 1.0};
}

const StimulusCommand& stimulus(const Command& command) { return std::get<StimulusCommand>(command); }

TEST(CommandQueue, KeepsTheOrder) {
  CommandQueue queue(10);
  queue.push(lamp("a", StimulusOperation::add, 1.0));
  queue.push(Control([] {}));
  queue.push(lamp("b", StimulusOperation::add, 2.0));
  const auto commands = queue.take();
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(stimulus(commands[0]).id, "a");
  EXPECT_EQ(commands[1].index(), 1u);
  EXPECT_EQ(stimulus(commands[2]).id, "b");
  EXPECT_TRUE(queue.take().empty());
}

TEST(CommandQueue, KeepsTheLastOfAFlood) {
  CommandQueue queue(2);
  EXPECT_TRUE(queue.push(lamp("a", StimulusOperation::add, 0.0)));
  EXPECT_TRUE(queue.push(lamp("b", StimulusOperation::change, 0.0)));
  for (int i = 1; i <= 1000; ++i) EXPECT_TRUE(queue.push(lamp("a", StimulusOperation::change, i)));
  const auto commands = queue.take();
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(stimulus(commands[0]).vector.x(), 1000.0);
  EXPECT_EQ(stimulus(commands[0]).operation, StimulusOperation::add);  // else the lamp would never have been added
}

TEST(CommandQueue, KeepsWhatHoldsUntilATimedStimulusBegins) {
  CommandQueue queue(10);
  queue.push(lamp("a", StimulusOperation::add, 1.0));
  StimulusCommand later = lamp("a", StimulusOperation::change, 2.0);
  later.timing.start = 60.0;
  queue.push(later);
  EXPECT_EQ(queue.take().size(), 2u);
}

TEST(CommandQueue, DoesNotMergeAcrossARemovalOrAControl) {
  CommandQueue queue(10);
  queue.push(lamp("a", StimulusOperation::add, 1.0));
  queue.push(lamp("a", StimulusOperation::remove, 0.0));
  queue.push(lamp("a", StimulusOperation::add, 2.0));
  queue.push(Control([] {}));
  queue.push(lamp("a", StimulusOperation::add, 3.0));
  EXPECT_EQ(queue.take().size(), 5u);
}

TEST(CommandQueue, BoundsTheStimuliThatWait) {
  CommandQueue queue(2);
  EXPECT_TRUE(queue.push(lamp("a", StimulusOperation::add, 0.0)));
  EXPECT_TRUE(queue.push(lamp("b", StimulusOperation::add, 0.0)));
  EXPECT_FALSE(queue.push(lamp("c", StimulusOperation::add, 0.0)));
  EXPECT_TRUE(queue.push(Control([] {})));
  queue.take();
  EXPECT_TRUE(queue.push(lamp("c", StimulusOperation::add, 0.0)));
}

TEST(CommandQueue, WakesWhoWaitsWhenClosedAndTakesNothingMore) {
  CommandQueue queue(2);
  std::thread waiting([&] { queue.wait(); });
  queue.close();
  waiting.join();
  EXPECT_TRUE(queue.isClosed());
  EXPECT_FALSE(queue.push(Control([] {})));
  EXPECT_FALSE(queue.push(lamp("a", StimulusOperation::add, 0.0)));
}

}  // namespace
}  // namespace sensory_growth::node
