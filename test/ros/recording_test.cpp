#include "sensory_growth/ros/recording.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "ros/wait.h"

namespace sensory_growth::node {
namespace {

using namespace std::chrono_literals;
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
  std::atomic<bool> is_open_{false};
};

boost::shared_ptr<const std_msgs::String> text(const std::string& data) {
  auto message = boost::make_shared<std_msgs::String>();
  message->data = data;
  return message;
}

/// From now on whoever has the file open has no space left.
void fill(const std::string& path) {
  const int full = open("/dev/full", O_RDWR);
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;  // that of the directory itself
    if (std::filesystem::read_symlink(entry.path(), gone) != path) continue;
    EXPECT_NE(dup2(full, std::stoi(entry.path().filename())), -1);
  }
  close(full);
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

TEST_F(RecordingTest, EndsBeforeTheDiskIsFull) {
  constexpr double kMinimum = 1e9;
  std::atomic<double> space{2.0 * kMinimum};
  Recording recording(directory_ / "run.bag", {Compression::none, kMinimum, "/node", [&](const std::string& directory) {
                                                 EXPECT_EQ(directory, directory_);
                                                 return space.load();
                                               }});
  const auto write = [&](int message) { recording.write("/topic", false, ros::Time(1 + message, 0), text("x")); };
  constexpr int kBefore = 30, kChecked = 100;  // once in so many messages
  for (int i = 0; i < kBefore; ++i) write(i);
  space = 0.9 * kMinimum;
  for (int i = kBefore; i < 3 * kChecked; ++i) write(i);  // nobody waits for ever
  testing::lookUntil("the end", [&] { return recording.failed(); });
  EXPECT_TRUE(std::filesystem::exists(directory_ / "run.bag"));  // closed before anybody asked
  const RecordingSummary summary = recording.finish();
  EXPECT_THAT(summary.error, HasSubstr("too little free space left"));
  EXPECT_LE(summary.messages, static_cast<std::uint64_t>(kChecked));
  rosbag::Bag bag(summary.path, rosbag::bagmode::Read);
  EXPECT_EQ(rosbag::View(bag).size(), summary.messages);
}

/// So a process that is killed loses little, however busy machine and disk are.
TEST_F(RecordingTest, LetsNobodyGoFarAheadOfTheFile) {
  std::promise<void> goes_on;
  const RecordingSettings settings{Compression::none, 0.0, "/node", [&, waits = goes_on.get_future().share()](auto&) {
                                     if (is_open_) waits.wait();
                                     return 1e9;
                                   }};
  Recording recording(directory_ / "run.bag", settings);
  is_open_ = true;
  constexpr int kMessages = 20;  // fewer than a queue holds
  auto writing = std::async(std::launch::async, [&] {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kMessages; ++i) {
      while (std::chrono::steady_clock::now() < begin + i * 10ms) std::this_thread::yield();
      recording.write("/topic", false, ros::Time(1 + i, 0), text("x"));
    }
  });
  EXPECT_EQ(writing.wait_for(1s), std::future_status::timeout);
  goes_on.set_value();
  writing.get();
  EXPECT_EQ(recording.finish().messages, static_cast<std::uint64_t>(kMessages));
}

TEST_F(RecordingTest, EndsWhenTheDiskIsFull) {
  Recording recording(directory_ / "run.bag", {Compression::none, 0.0, "/node"});
  fill(directory_ / "run.bag.active");
  for (int i = 0; i < 300; ++i) recording.write("/topic", false, ros::Time(1 + i, 0), text(std::string(1000, 'x')));
  testing::lookUntil("the end", [&] { return recording.failed(); });
  const RecordingSummary summary = recording.finish();
  EXPECT_THAT(summary.error, HasSubstr("No space left on device"));
  EXPECT_EQ(summary.path, directory_ / "run.bag.active");
}

TEST_F(RecordingTest, DoesNotBeginOnAFullDisk) {
  std::filesystem::create_symlink("/dev/full", directory_ / "run.bag.active");
  try {
    Recording(directory_ / "run.bag", {Compression::none, 0.0, "/node"});
    FAIL() << "it began";
  } catch (const std::runtime_error& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("No space left on device"));
  }
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
