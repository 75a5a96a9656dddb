#pragma once

/// One bag being written, on a thread of its own. Nothing that was handed in is lost while the disk takes it: a full
/// queue makes the caller wait. So does a message that was handed in 0.1 s of wall time ago and is not yet in the file;
/// what is lost if the process is killed is no older than that when the last message was handed in.

#include <ros/message_traits.h>
#include <ros/time.h>
#include <rosbag/bag.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "sensory_growth/ros/parameters.h"

namespace sensory_growth::node {

/// Space that is left on the disk of a directory [byte]; infinite if that cannot be told.
double freeSpace(const std::string& directory);

struct RecordingSettings {
  Compression compression = Compression::lz4;
  double minimum_free_space = 0.0;  ///< recording stops when the disk has less [byte]
  std::string caller;               ///< name of the node, kept with every topic
  std::function<double(const std::string& directory)> free_space = freeSpace;
};

struct RecordingSummary {
  std::string path;  ///< where the bag is; unfinished if it could not be closed
  std::uint64_t messages = 0;
  std::string error;  ///< why recording ended early; empty if it did not
};

/// Which file there is already at `path` or at its unfinished form, or nothing.
std::optional<std::string> recordingAt(const std::string& path);

/// Path of `file` inside `directory`. Throws std::invalid_argument unless `file` is a plain name that ends in ".bag"
/// and neither it nor its unfinished form exists.
std::string recordingPath(const std::string& directory, const std::string& file);

class Recording {
 public:
  /// Opens `path` with the suffix ".active". Throws std::runtime_error if that fails or the disk is too full.
  Recording(const std::string& path, const RecordingSettings& settings);

  /// Finishes.
  ~Recording();

  /// Queues a message. Latched topics are latched again on playback. `stamp` must be later than zero.
  template <typename Message>
  void write(const std::string& topic, bool is_latched, const ros::Time& stamp, Message message) {
    push([this, topic, is_latched, stamp, message = std::move(message)](rosbag::Bag& bag) {
      using ros::message_traits::DataType;
      using ros::message_traits::Definition;
      using ros::message_traits::MD5Sum;
      using Content = std::decay_t<decltype(*message)>;
      auto& header = headers_[topic];
      if (!header) {
        header = boost::make_shared<ros::M_string>(ros::M_string{{"type", DataType<Content>::value()},
                                                                 {"md5sum", MD5Sum<Content>::value()},
                                                                 {"message_definition", Definition<Content>::value()},
                                                                 {"latching", is_latched ? "1" : "0"},
                                                                 {"callerid", settings_.caller}});
      }
      bag.write(topic, stamp, *message, header);
      ++messages_;
    });
  }

  /// True once writing has failed and the bag was closed for that, so that finish() need not wait.
  bool failed() const { return has_failed_; }

  const std::string& path() const { return path_; }

  /// What comes now is the first that size() counts; before, it is 0.
  void countFromHere();

  /// Growth of the file so far, or a little less [byte].
  std::uint64_t size() const { return size_; }

  /// From now on nothing is taken in; what is queued is written and the bag closed without making anybody wait.
  void finishSoon();

  /// The same, but waits for it. The suffix is gone afterwards, unless the bag could not be closed. May be called
  /// again.
  RecordingSummary finish();

 private:
  using Time = std::chrono::steady_clock::time_point;

  struct Entry {
    Time handed_in;
    std::function<void(rosbag::Bag&)> write;
  };

  void push(std::function<void(rosbag::Bag&)> write);
  bool lags() const;
  void run();
  std::optional<Entry> waitForEntry();
  bool isDone();
  void writeEntry(const Entry& entry);
  void flush();
  void close();
  void fail(const std::string& why);
  bool hasSpace() const;

  const std::string path_;
  const RecordingSettings settings_;

  // Of the writing thread alone, and of finish() once that has ended.
  std::unique_ptr<rosbag::Bag> bag_;
  std::optional<Time> flush_due_;  // nothing: all that was written is in the file
  std::map<std::string, boost::shared_ptr<ros::M_string>> headers_;
  std::uint64_t messages_ = 0;
  std::optional<std::uint64_t> uncounted_size_;  // [byte]; nothing: nothing is counted yet
  std::string error_;
  bool is_unfinished_ = false;

  std::atomic<bool> has_failed_{false};
  std::atomic<std::uint64_t> size_{0};
  std::mutex finish_mutex_;  // locked before mutex_
  std::mutex mutex_;         // guards what follows
  std::condition_variable changed_;
  std::deque<Entry> queue_;
  std::optional<Time> oldest_;  // of what is not in the file; nothing: all is
  bool is_finishing_ = false;
  bool is_failing_ = false;  // what is handed in is dropped

  std::thread thread_;
};

}  // namespace sensory_growth::node
