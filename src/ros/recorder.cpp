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
  try {
    setRecording(open(file));
  } catch (const std::exception& refusal) {
    return refusal.what();
  }
  first_file_ = file;
  part_ = 0;
  return std::nullopt;
}

std::optional<std::string> Recorder::split() {
  if (!recording_) return "nothing is being recorded";
  std::unique_ptr<Recording> next;
  int part = 0;
  try {
    part = nextPart();
    next = open(partOf(first_file_, part));
  } catch (const std::exception& refusal) {
    full_size_ = recording_->size() + settings_.split_size;
    return refusal.what();
  }
  finishPrevious();
  recording_->finishSoon();
  previous_ = std::move(recording_);
  setRecording(std::move(next));
  part_ = part;
  return std::nullopt;
}

void Recorder::stop(const std::string& why) {
  RecordingSummary summary = take()->finish();
  summary.error = why;
  noteFailure(summary);
}

bool Recorder::isFull() const { return recording_ && settings_.split_size > 0 && recording_->size() >= full_size_; }

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

/// Throws std::exception if it cannot.
std::unique_ptr<Recording> Recorder::open(const std::string& file) const {
  return std::make_unique<Recording>(recordingPath(settings_.directory, file), settings_.recording);
}

int Recorder::nextPart() const {
  int part = part_ + 1;
  while (recordingAt(std::filesystem::path(settings_.directory) / partOf(first_file_, part))) ++part;
  return part;
}

void Recorder::finishPrevious() {
  if (!previous_) return;
  const RecordingSummary summary = std::exchange(previous_, nullptr)->finish();
  if (!summary.error.empty()) noteFailure(summary);
}

void Recorder::setRecording(std::unique_ptr<Recording> recording) {
  recording_ = std::move(recording);
  full_size_ = settings_.split_size;
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
