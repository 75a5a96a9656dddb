/// A live run that the node has recorded is the same when it is run again without a master, bit for bit.

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "batch/bags.h"
#include "ros/batch_process.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

using batch::testing::contentsOf;
using ::testing::HasSubstr;

class LiveRun : public ::testing::Test {
 protected:
  LiveRun() : folder_(std::filesystem::temp_directory_path() / ("batch_rostest_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(folder_);
  }
  ~LiveRun() override {
    std::filesystem::remove_all(folder_);
    if (!bag_.empty()) std::filesystem::remove(bag_);
  }

  void startRecording(const std::string& file) {
    StartRecording::Request start;
    start.file = std::to_string(getpid()) + file;
    const StartRecording::Response started = node_.call<StartRecording>("start_recording", start);
    ASSERT_TRUE(started.success) << started.message;
  }

  void stopRecording() {
    const StopRecording::Response stopped = node_.call<StopRecording>("stop_recording");
    ASSERT_TRUE(stopped.success) << stopped.message;
    bag_ = stopped.path;
  }

  /// 40 steps with stimuli, parameters and gravity that change.
  void disturb() {
    ros::Publisher lamps = node_.handle().advertise<PointSource>("point_source", 10);
    ros::Publisher lights = node_.handle().advertise<LightDirection>("light_direction", 10);
    node_.send(lights, light(LightDirection::ADD, "sun", {1.0, 2.0, 0.5}, 0.9));
    node_.stepTo(10, 0);
    node_.send(lamps, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.1}));
    node_.send(lamps, lamp(PointSource::CHANGE, "nobody", {0.1, 0.0, 0.1}));
    ASSERT_TRUE(node_.setParameter("shoot", "sensitivities.gravity", 0.7).success);
    node_.stepTo(15, 10);
    ASSERT_TRUE(node_.setGravity({1.0, 5.0, -5.0}).success);
    ASSERT_TRUE(node_.setParameter("all", "growth.rate", 2e-4).success);
    node_.stepTo(30, 15);
    node_.send(lights, light(LightDirection::REMOVE, "sun", rod::Vector3::Zero()));
    ASSERT_TRUE(node_.setGravity(rod::Vector3::Zero()).success);
    node_.stepTo(40, 30);
  }

  NodeUnderTest node_;
  const std::filesystem::path folder_;
  std::string bag_;
};

TEST_F(LiveRun, IsEqualOnEveryStepAndABitIsFoundOut) {
  startRecording("_whole.bag");
  disturb();
  stopRecording();
  const std::string again = folder_ / "again.bag";
  const BatchOutcome equal = batch({"replay", bag_, "--bag", again});
  EXPECT_EQ(equal.code, 0) << equal.printed;
  EXPECT_THAT(equal.printed, HasSubstr("all 41 states compared are equal"));

  // The same messages, stamps and latches on every topic, too.
  const auto live = contentsOf(bag_), replayed = contentsOf(again);
  EXPECT_EQ(live.size(), replayed.size());
  for (const auto& [topic, content] : live) {
    EXPECT_TRUE(replayed.count(topic) && replayed.at(topic) == content) << topic;
  }

  const std::string altered = folder_ / "altered.bag";
  batch::testing::copyChanged(bag_, altered, [](AppliedCommand& command, std::size_t) {
    if (command.kind == AppliedCommand::PARAMETER && command.step_index == 15) {
      batch::testing::flipLastBit(command.value);
    }
  });
  const BatchOutcome found = batch({"replay", altered});
  EXPECT_EQ(found.code, 1) << found.printed;
  EXPECT_THAT(found.printed, HasSubstr("differs first at step 15 of epoch 0"));
}

TEST_F(LiveRun, IsEqualAlsoIfRecordedFromTheMiddleAndAcrossAReset) {
  ASSERT_TRUE(node_.command("reset").success);
  node_.countReset();
  ros::Publisher lamps = node_.handle().advertise<PointSource>("point_source", 10);
  node_.send(lamps, lamp(PointSource::ADD, "early", {0.1, 0.1, 0.1}));
  node_.stepTo(7, 0);
  node_.send(lamps, lamp(PointSource::ADD, "middle", {-0.1, 0.1, 0.1}));
  startRecording("_middle.bag");
  ASSERT_TRUE(node_.setGravity({1.0, 0.0, -9.0}).success);
  node_.stepTo(12, 7);
  ASSERT_TRUE(node_.command("reset").success);
  node_.countReset();
  disturb();
  stopRecording();
  const BatchOutcome outcome = batch({"replay", bag_, "--threads", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.printed;
  EXPECT_THAT(outcome.printed, HasSubstr("all 47 states compared are equal"));  // 7 to 12, 0 to 40
}

}  // namespace
}  // namespace sensory_growth::node::testing
