#include "sensory_growth/ros/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace sensory_growth::node {
namespace {

using ::testing::HasSubstr;

class RecorderTest : public ::testing::Test {
 protected:
  RecorderTest() : directory_(std::filesystem::temp_directory_path() / ("recorder_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(directory_);
  }
  ~RecorderTest() override { std::filesystem::remove_all(directory_); }

  RecorderSettings settings(std::uint64_t split_size = 0) const {
    return {directory_, split_size, {Compression::none, 0.0, "/node"}};
  }

  void write(Recorder& recorder, int message, std::size_t size = 1) const {
    auto text = boost::make_shared<std_msgs::String>();
    text->data.assign(size, 'x');
    recorder.recording()->write("/topic", false, ros::Time(1 + message, 0),
                                boost::shared_ptr<const std_msgs::String>(text));
  }

  std::size_t messagesIn(const std::string& file) const {
    const rosbag::Bag bag(directory_ / file);  // throws unless closed and indexed
    return rosbag::View(bag).size();
  }

  const std::filesystem::path directory_;
};

TEST_F(RecorderTest, PartsFollowEachOther) {
  Recorder recorder(settings());
  EXPECT_EQ(recorder.split(), "nothing is being recorded");
  ASSERT_FALSE(recorder.start("run.bag"));
  int message = 0;
  for (int part = 0; part < 3; ++part) {
    if (part > 0) {
      ASSERT_FALSE(recorder.split());
    }
    for (int i = 0; i <= part; ++i) write(recorder, message++);
  }
  EXPECT_EQ(recorder.path(), directory_ / "run_2.bag");
  EXPECT_EQ(recorder.take()->finish().error, "");
  EXPECT_EQ(recorder.path(), "");
  EXPECT_EQ(messagesIn("run.bag"), 1u);
  EXPECT_EQ(messagesIn("run_1.bag"), 2u);
  EXPECT_EQ(messagesIn("run_2.bag"), 3u);

  ASSERT_FALSE(recorder.start("other.bag"));  // the numbers begin anew
  ASSERT_FALSE(recorder.split());
  EXPECT_EQ(recorder.path(), directory_ / "other_1.bag");
}

TEST_F(RecorderTest, IsFullWhenTheFileHasGrownBySplitSize) {
  constexpr int kMessages = 200, kQueue = 64;  // at most so many are not yet written
  constexpr std::size_t kSize = 10000;
  Recorder recorder(settings((kMessages - kQueue) * kSize));
  EXPECT_FALSE(recorder.isFull());
  ASSERT_FALSE(recorder.start("run.bag"));
  for (int i = 0; i < kMessages; ++i) write(recorder, i, kSize);  // what a part begins with
  recorder.recording()->countFromHere();
  for (int i = 0; i < kQueue + 1; ++i) write(recorder, i, 1);
  EXPECT_FALSE(recorder.isFull());
  for (int i = 0; i < kMessages + 10; ++i) write(recorder, i, kSize);
  EXPECT_TRUE(recorder.isFull());
}

TEST_F(RecorderTest, SaysWhyItStopped) {
  Recorder recorder(settings());
  ASSERT_FALSE(recorder.start("run.bag"));
  write(recorder, 1);
  std::ofstream(directory_ / "run_1.bag").put('x');
  const auto refusal = recorder.split();
  ASSERT_TRUE(refusal);
  EXPECT_THAT(*refusal, HasSubstr("exists already"));
  EXPECT_EQ(recorder.recording(), nullptr);
  EXPECT_EQ(recorder.path(), "");
  EXPECT_THAT(recorder.failure(), HasSubstr("run_1.bag exists already"));
  EXPECT_THAT(recorder.takeFailure()->error, HasSubstr("exists already"));
  EXPECT_FALSE(recorder.takeFailure());  // said once
  EXPECT_THAT(recorder.failure(), HasSubstr("exists already"));

  ASSERT_FALSE(recorder.start("again.bag"));
  EXPECT_EQ(recorder.failure(), "");
  EXPECT_EQ(messagesIn("run.bag"), 1u);  // the part before was closed
}

}  // namespace
}  // namespace sensory_growth::node
