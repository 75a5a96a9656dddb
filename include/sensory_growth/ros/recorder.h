#pragma once

/// What is recorded of a run: at most one bag at a time, which may be followed by further parts.

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sensory_growth/ros/recording.h"

namespace sensory_growth::node {

struct RecorderSettings {
  std::string directory;         ///< empty: recording is refused
  std::uint64_t split_size = 0;  ///< another part begins when the file has this size [byte]; 0: never
  RecordingSettings recording;
};

/// Of one thread, but for path() and failure().
class Recorder {
 public:
  explicit Recorder(RecorderSettings settings) : settings_(std::move(settings)) {}

  /// Opens a bag. Returns why it failed, or nothing.
  std::optional<std::string> start(const std::string& file);

  /// Lets the next part begin: run.bag is followed by run_1.bag, run_2.bag, but for numbers that are taken. Nobody
  /// waits for the one before to be closed. Returns why it failed, or nothing; then the open bag goes on, and is full
  /// again when it has grown by as much again.
  std::optional<std::string> split();

  /// Closes the open bag early, because of `why`.
  void stop(const std::string& why);

  /// The open bag, or null.
  Recording* recording() { return recording_.get(); }

  /// True if the open bag has the size at which it is to be split.
  bool isFull() const;

  /// Hands the open bag over, to be finished elsewhere; null if there is none. All parts before are finished.
  std::unique_ptr<Recording> take();

  /// What ended early since the last call, with the reason, or nothing.
  std::optional<RecordingSummary> takeFailure();

  /// Path of the open bag; empty if there is none. From any thread.
  std::string path() const;

  /// Why recording ended early; empty if it did not, or has begun again. From any thread.
  std::string failure() const;

 private:
  std::unique_ptr<Recording> open(const std::string& file) const;
  int nextPart() const;
  void finishPrevious();
  void setRecording(std::unique_ptr<Recording> recording);
  void noteFailure(const RecordingSummary& summary);

  const RecorderSettings settings_;
  std::string first_file_;       // of the parts
  int part_ = 0;                 // number of the open one, after the first
  std::uint64_t full_size_ = 0;  // of the open one [byte]
  std::unique_ptr<Recording> recording_;
  std::unique_ptr<Recording> previous_;  // part that is being closed
  std::optional<RecordingSummary> failed_;

  mutable std::mutex mutex_;  // guards what follows
  std::string path_;
  std::string failure_;
};

}  // namespace sensory_growth::node
