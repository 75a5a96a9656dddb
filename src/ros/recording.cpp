#include "sensory_growth/ros/recording.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "sensory_growth/ros/confined_file.h"

namespace sensory_growth::node {
namespace {

constexpr char kActive[] = ".active";
constexpr std::size_t kMostQueued = 64;               // messages; what waits must be on disk soon after Ctrl-C
constexpr std::uint64_t kSpaceCheckInterval = 100;    // messages
constexpr std::uint32_t kChunkThreshold = 64 * 1024;  // small, so that little is lost if the process is killed [byte]

rosbag::CompressionType toRosbag(Compression compression) {
  switch (compression) {
    case Compression::none:
      return rosbag::compression::Uncompressed;
    case Compression::lz4:
      return rosbag::compression::LZ4;
    case Compression::bz2:
      return rosbag::compression::BZ2;
  }
  return rosbag::compression::Uncompressed;
}

}  // namespace

std::string recordingPath(const std::string& directory, const std::string& file) {
  const std::string path = confinedPath({"recording_directory", directory, ".bag"}, file);
  for (const std::string& taken : {path, path + kActive}) {
    if (std::filesystem::exists(taken)) throw std::invalid_argument(taken + " exists already");
  }
  return path;
}

Recording::Recording(const std::string& path, const RecordingSettings& settings) : path_(path), settings_(settings) {
  if (!hasSpace()) throw std::runtime_error("the disk of " + path_ + " has too little free space");
  try {
    bag_.open(path_ + kActive, rosbag::bagmode::Write);
    bag_.setCompression(toRosbag(settings_.compression));
    bag_.setChunkThreshold(kChunkThreshold);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error("cannot write " + path_ + ": " + error.what());
  }
  thread_ = std::thread([this] { run(); });
}

Recording::~Recording() { finish(); }

RecordingSummary Recording::finish() {
  const std::lock_guard<std::mutex> only_one(finish_mutex_);
  if (thread_.joinable()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_finishing_ = true;
      changed_.notify_all();
    }
    thread_.join();
    try {
      bag_.close();
      std::filesystem::rename(path_ + kActive, path_);
    } catch (const std::exception& failure) {
      fail(failure.what());
    }
  }
  return {path_, messages_, error_};
}

void Recording::push(Entry entry) {
  if (failed_) return;
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return queue_.size() < kMostQueued || failed_; });
  queue_.push_back(std::move(entry));
  changed_.notify_all();
}

void Recording::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_finishing_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const Entry entry = std::move(queue_.front());
    queue_.pop_front();
    changed_.notify_all();
    lock.unlock();
    writeEntry(entry);
    lock.lock();
  }
}

void Recording::writeEntry(const Entry& entry) {
  if (failed_) return;
  if (messages_ % kSpaceCheckInterval == 0 && !hasSpace()) {
    return fail("the disk has too little free space left");
  }
  try {
    entry(bag_);
    ++messages_;
  } catch (const std::exception& failure) {
    fail(failure.what());
  }
}

void Recording::fail(const std::string& why) {
  if (error_.empty()) error_ = why;
  failed_ = true;
}

bool Recording::hasSpace() const {
  std::error_code unknown;
  const auto space = std::filesystem::space(std::filesystem::path(path_).parent_path(), unknown);
  return unknown || static_cast<double>(space.available) >= settings_.minimum_free_space;
}

}  // namespace sensory_growth::node
