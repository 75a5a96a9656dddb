#include "sensory_growth/ros/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "ros/wait.h"

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

TEST_F(RecorderTest, LeavesPartsOfEarlierRunsAlone) {
  for (const char* left_over : {"run_1.bag", "run_2.bag.active"}) std::ofstream(directory_ / left_over) << "precious";
  Recorder recorder(settings());
  ASSERT_FALSE(recorder.start("run.bag"));
  write(recorder, 1);
  for (const char* part : {"run_3.bag", "run_4.bag"}) {
    ASSERT_FALSE(recorder.split());
    EXPECT_EQ(recorder.path(), directory_ / part);
    write(recorder, 2);
  }
  EXPECT_EQ(recorder.take()->finish().error, "");
  for (const char* part : {"run.bag", "run_3.bag", "run_4.bag"}) EXPECT_EQ(messagesIn(part), 1u) << part;
  EXPECT_EQ(std::filesystem::file_size(directory_ / "run_1.bag"), std::string("precious").size());
}

TEST_F(RecorderTest, GoesOnInTheSameBagWhenTheNextCannotBeOpened) {
  constexpr std::size_t kMessage = 10000;
  constexpr std::uint64_t kSize = 200 * kMessage;  // much more than a queue holds
  Recorder recorder(settings(kSize));
  ASSERT_FALSE(recorder.start("run.bag"));
  recorder.recording()->countFromHere();
  std::size_t messages = 0;
  const auto write_until_full = [&] {
    for (; !recorder.isFull() && messages < 1000; ++messages) write(recorder, static_cast<int>(messages), kMessage);
  };
  write_until_full();
  const std::filesystem::path elsewhere = directory_.string() + "_elsewhere";
  std::filesystem::rename(directory_, elsewhere);
  const auto refusal = recorder.split();
  std::filesystem::rename(elsewhere, directory_);
  ASSERT_TRUE(refusal);
  EXPECT_THAT(*refusal, HasSubstr("run_1.bag: Error opening file"));
  EXPECT_EQ(recorder.path(), directory_ / "run.bag");
  EXPECT_EQ(recorder.failure(), "");
  EXPECT_FALSE(recorder.takeFailure());
  EXPECT_FALSE(recorder.isFull());  // again when it has grown by as much again
  write_until_full();
  EXPECT_GE(recorder.recording()->size(), 2 * kSize);

  ASSERT_FALSE(recorder.split());
  EXPECT_EQ(recorder.path(), directory_ / "run_1.bag");
  EXPECT_EQ(recorder.take()->finish().error, "");
  EXPECT_EQ(messagesIn("run.bag"), messages);
}

TEST_F(RecorderTest, SaysWhyItStopped) {
  Recorder recorder(settings());
  ASSERT_FALSE(recorder.start("run.bag"));
  write(recorder, 1);
  recorder.stop("it was asked to");
  EXPECT_EQ(recorder.recording(), nullptr);
  EXPECT_EQ(recorder.path(), "");
  EXPECT_THAT(recorder.failure(), HasSubstr("run.bag: it was asked to"));
  EXPECT_EQ(recorder.takeFailure()->error, "it was asked to");
  EXPECT_FALSE(recorder.takeFailure());  // said once
  EXPECT_THAT(recorder.failure(), HasSubstr("it was asked to"));
  EXPECT_EQ(messagesIn("run.bag"), 1u);

  ASSERT_FALSE(recorder.start("again.bag"));
  EXPECT_EQ(recorder.failure(), "");
}

TEST_F(RecorderTest, LetsABagGoOnceItHasFailedAndIsClosed) {
  Recorder recorder(settings());
  ASSERT_FALSE(recorder.start("run.bag"));
  write(recorder, 1);
  EXPECT_FALSE(recorder.takeFailure());
  write(recorder, -1);  // rosbag refuses time zero
  std::optional<RecordingSummary> failure;
  testing::lookUntil("the failure", [&] { return (failure = recorder.takeFailure()).has_value(); });
  EXPECT_THAT(failure->error, HasSubstr("TIME_MIN"));
  EXPECT_EQ(recorder.recording(), nullptr);
  EXPECT_EQ(recorder.path(), "");
  EXPECT_EQ(messagesIn("run.bag"), 1u);
}

}  // namespace
}  // namespace sensory_growth::node
