#include "sensory_growth/ros/recorder.h"

#include <exception>
#include <filesystem>
#include <utility>

namespace sensory_growth::node {
namespace {

std::string partOf(const std::string& file, int part) {
  const std::filesystem::path path(file);
  return path.stem().string() + "_" + std::to_string(part) + path.extension().string();
}

}  // namespace

std::optional<std::string> Recorder::start(const std::string& file) {
  if (recording_) return "already recording " + recording_->path();
  finishPrevious();
  first_file_ = file;
  parts_ = 0;
  return open(file);
}

std::optional<std::string> Recorder::split() {
  if (!recording_) return "nothing is being recorded";
  finishPrevious();
  recording_->finishSoon();
  previous_ = std::move(recording_);
  auto refusal = open(partOf(first_file_, ++parts_));
  if (refusal) {
    setRecording(nullptr);
    noteFailure({previous_->path(), 0, *refusal});
  }
  return refusal;
}

void Recorder::stop(const std::string& why) {
  RecordingSummary summary = take()->finish();
  summary.error = why;
  noteFailure(summary);
}

bool Recorder::isFull() const {
  return recording_ && settings_.split_size > 0 && recording_->size() >= settings_.split_size;
}

std::unique_ptr<Recording> Recorder::take() {
  finishPrevious();
  std::unique_ptr<Recording> recording = std::move(recording_);
  setRecording(nullptr);
  return recording;
}

std::optional<RecordingSummary> Recorder::takeFailure() {
  if (recording_ && recording_->failed()) noteFailure(take()->finish());
  return std::exchange(failed_, std::nullopt);
}

std::string Recorder::path() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return path_;
}

std::string Recorder::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

std::optional<std::string> Recorder::open(const std::string& file) {
  try {
    setRecording(std::make_unique<Recording>(recordingPath(settings_.directory, file), settings_.recording));
  } catch (const std::exception& refusal) {
    return refusal.what();
  }
  return std::nullopt;
}

void Recorder::finishPrevious() {
  if (!previous_) return;
  const RecordingSummary summary = std::exchange(previous_, nullptr)->finish();
  if (!summary.error.empty()) noteFailure(summary);
}

void Recorder::setRecording(std::unique_ptr<Recording> recording) {
  recording_ = std::move(recording);
  const std::lock_guard<std::mutex> lock(mutex_);
  path_ = recording_ ? recording_->path() : "";
  if (recording_) failure_.clear();
}

void Recorder::noteFailure(const RecordingSummary& summary) {
  failed_ = summary;
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = summary.path + ": " + summary.error;
}

}  // namespace sensory_growth::node
