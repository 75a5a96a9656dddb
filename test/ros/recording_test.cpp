#include "sensory_growth/ros/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace sensory_growth::node {
namespace {

using ::testing::HasSubstr;

class RecordingTest : public ::testing::Test {
 protected:
  RecordingTest()
      : directory_(std::filesystem::temp_directory_path() / ("recording_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(directory_);
  }
  ~RecordingTest() override { std::filesystem::remove_all(directory_); }

  std::string refusalOf(const std::string& file) const {
    try {
      recordingPath(directory_, file);
      return "none";
    } catch (const std::invalid_argument& refusal) {
      return refusal.what();
    }
  }

  const std::filesystem::path directory_;
};

boost::shared_ptr<const std_msgs::String> text(const std::string& data) {
  auto message = boost::make_shared<std_msgs::String>();
  message->data = data;
  return message;
}

TEST_F(RecordingTest, StaysInItsDirectory) {
  EXPECT_EQ(refusalOf("run.bag"), "none");
  for (const char* file : {"../run.bag", "/tmp/run.bag", "a/b.bag", ".hidden.bag", "", "-x.bag", "sp ace.bag"}) {
    EXPECT_THAT(refusalOf(file), HasSubstr("without a directory")) << file;
  }
  EXPECT_THAT(refusalOf("run.txt"), HasSubstr("must end in .bag"));
  std::ofstream(directory_ / "run.bag").put('x');
  EXPECT_THAT(refusalOf("run.bag"), HasSubstr("exists already"));
  std::ofstream(directory_ / "other.bag.active").put('x');
  EXPECT_THAT(refusalOf("other.bag"), HasSubstr("exists already"));
}

TEST_F(RecordingTest, HoldsEveryMessageInOrderAndIsRenamedWhenClosed) {
  const std::string path = directory_ / "run.bag";
  Recording recording(path, {Compression::lz4, 0.0, "/node"});
  EXPECT_TRUE(std::filesystem::exists(path + ".active"));
  constexpr int kMessages = 10000;  // more than the queue holds
  for (int i = 0; i < kMessages; ++i) {
    recording.write("/latched", true, ros::Time(1 + i, 0), text(std::to_string(i)));
  }
  const RecordingSummary summary = recording.finish();
  EXPECT_EQ(summary.error, "");
  EXPECT_EQ(summary.messages, static_cast<std::uint64_t>(kMessages));
  EXPECT_FALSE(std::filesystem::exists(path + ".active"));

  rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag);
  int expected = 0;
  for (const rosbag::MessageInstance& message : view) {
    EXPECT_EQ(message.instantiate<std_msgs::String>()->data, std::to_string(expected));
    EXPECT_EQ(message.getTime(), ros::Time(1 + expected, 0));
    EXPECT_EQ((*message.getConnectionHeader())["latching"], "1");
    ++expected;
  }
  EXPECT_EQ(expected, kMessages);
}

TEST_F(RecordingTest, NeedsSpaceOnTheDisk) {
  EXPECT_THROW(Recording(directory_ / "run.bag", {Compression::none, 1e30, "/node"}), std::runtime_error);
}

TEST_F(RecordingTest, SurvivesAMessageThatCannotBeWritten) {
  Recording recording(directory_ / "run.bag", {Compression::none, 0.0, "/node"});
  recording.write("/topic", false, ros::Time(1, 0), text("good"));
  recording.write("/topic", false, ros::Time(0, 0), text("rosbag refuses time zero"));
  recording.write("/topic", false, ros::Time(2, 0), text("dropped"));
  const RecordingSummary summary = recording.finish();
  EXPECT_TRUE(recording.failed());
  EXPECT_EQ(summary.messages, 1u);
  EXPECT_THAT(summary.error, HasSubstr("TIME_MIN"));
  rosbag::Bag bag(summary.path, rosbag::bagmode::Read);
  EXPECT_EQ(rosbag::View(bag).size(), 1u);
}

}  // namespace
}  // namespace sensory_growth::node
