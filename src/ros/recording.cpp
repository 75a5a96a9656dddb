#include "sensory_growth/ros/recording.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "sensory_growth/ros/confined_file.h"

namespace sensory_growth::node {
namespace {

constexpr char kActive[] = ".active";
constexpr std::size_t kMostQueued = 64;               // messages; what waits must be on disk soon after Ctrl-C
constexpr std::uint64_t kSpaceCheckInterval = 100;    // messages
constexpr std::uint32_t kChunkThreshold = 64 * 1024;  // [byte]
constexpr std::chrono::milliseconds kFlushInterval{50};
constexpr std::chrono::milliseconds kMostLag{100};

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

/// A bag that cannot be closed cannot be destroyed either, since its destructor would throw: it stays until the end.
void abandon(std::unique_ptr<rosbag::Bag> bag) {
  static std::mutex mutex;
  static auto& abandoned = *new std::vector<std::unique_ptr<rosbag::Bag>>;
  const std::lock_guard<std::mutex> lock(mutex);
  abandoned.push_back(std::move(bag));
}

/// With the reason of the operating system, which rosbag does not tell.
std::string describe(const std::exception& failure) {
  const int number = errno;
  return failure.what() + (number == 0 ? "" : std::string(": ") + std::generic_category().message(number));
}

}  // namespace

double freeSpace(const std::string& directory) {
  std::error_code unknown;
  const auto space = std::filesystem::space(directory, unknown);
  return unknown ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

std::optional<std::string> recordingAt(const std::string& path) {
  for (const std::string& taken : {path, path + kActive}) {
    if (std::filesystem::exists(taken)) return taken;
  }
  return std::nullopt;
}

std::string recordingPath(const std::string& directory, const std::string& file) {
  const std::string path = confinedPath({"recording_directory", directory, ".bag"}, file);
  if (const auto taken = recordingAt(path)) throw std::invalid_argument(*taken + " exists already");
  return path;
}

Recording::Recording(const std::string& path, const RecordingSettings& settings)
    : path_(path), settings_(settings), bag_(std::make_unique<rosbag::Bag>()) {
  if (!hasSpace()) throw std::runtime_error("the disk of " + path_ + " has too little free space");
  errno = 0;
  try {
    bag_->open(path_ + kActive, rosbag::bagmode::Write);
    bag_->setCompression(toRosbag(settings_.compression));
    bag_->setChunkThreshold(kChunkThreshold);
  } catch (const rosbag::BagException& error) {
    const std::string why = describe(error);
    if (bag_->isOpen()) abandon(std::move(bag_));
    throw std::runtime_error("cannot write " + path_ + ": " + why);
  }
  thread_ = std::thread([this] { run(); });
}

Recording::~Recording() { finish(); }

void Recording::finishSoon() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_finishing_ = true;
  changed_.notify_all();
}

RecordingSummary Recording::finish() {
  const std::lock_guard<std::mutex> only_one(finish_mutex_);
  if (thread_.joinable()) {
    finishSoon();
    thread_.join();
  }
  return {is_unfinished_ ? path_ + kActive : path_, messages_, error_};
}

void Recording::countFromHere() {
  push([this](rosbag::Bag& bag) { uncounted_size_ = bag.getSize(); });
}

void Recording::push(std::function<void(rosbag::Bag&)> write) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return is_failing_ || (queue_.size() < kMostQueued && !lags()); });
  if (is_failing_) return;
  const Time now = std::chrono::steady_clock::now();
  if (!oldest_) oldest_ = now;
  queue_.push_back({now, std::move(write)});
  changed_.notify_all();
}

bool Recording::lags() const { return oldest_ && std::chrono::steady_clock::now() - *oldest_ > kMostLag; }

void Recording::run() {
  do {
    if (const auto entry = waitForEntry()) writeEntry(*entry);
    if (flush_due_ && std::chrono::steady_clock::now() >= *flush_due_) flush();
  } while (!isDone());
  close();
  has_failed_ = !error_.empty();
}

/// Nothing if a flush is due first, or if there will be no more.
std::optional<Recording::Entry> Recording::waitForEntry() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto has_news = [this] { return is_finishing_ || !queue_.empty(); };
  if (flush_due_) {
    changed_.wait_until(lock, *flush_due_, has_news);
  } else {
    changed_.wait(lock, has_news);
  }
  if (queue_.empty()) return std::nullopt;
  Entry entry = std::move(queue_.front());
  queue_.pop_front();
  changed_.notify_all();
  return entry;
}

bool Recording::isDone() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_failing_ || (is_finishing_ && queue_.empty());
}

void Recording::writeEntry(const Entry& entry) {
  if (messages_ % kSpaceCheckInterval == 0 && !hasSpace()) {
    return fail("the disk has too little free space left");
  }
  errno = 0;
  try {
    entry.write(*bag_);
    if (bag_->getChunkThreshold() == 0) bag_->setChunkThreshold(kChunkThreshold);  // see flush()
    if (uncounted_size_) size_ = bag_->getSize() - *uncounted_size_;
  } catch (const std::exception& failure) {
    return fail(describe(failure));
  }
  if (!flush_due_) flush_due_ = std::chrono::steady_clock::now() + kFlushInterval;
}

void Recording::flush() {
  flush_due_.reset();
  errno = 0;
  try {
    // Ends the open chunk, which writes it. The next message makes a chunk of its own: a chunk that ends because it is
    // full lets go of the copy that rosbag keeps, and one that is ended from outside does not.
    bag_->setChunkThreshold(0);
  } catch (const std::exception& failure) {
    return fail(describe(failure));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  oldest_.reset();
  if (!queue_.empty()) oldest_ = queue_.front().handed_in;
  changed_.notify_all();
}

void Recording::close() {
  errno = 0;
  try {
    bag_->close();
    std::filesystem::rename(path_ + kActive, path_);
  } catch (const std::exception& failure) {
    fail(describe(failure));
    is_unfinished_ = true;
    if (!bag_->isOpen()) return;
    error_ += "; `rosbag reindex` recovers what was written";
    abandon(std::move(bag_));
  }
}

void Recording::fail(const std::string& why) {
  if (error_.empty()) error_ = why;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_failing_ = true;
  changed_.notify_all();
}

bool Recording::hasSpace() const {
  return settings_.free_space(std::filesystem::path(path_).parent_path()) >= settings_.minimum_free_space;
}

}  // namespace sensory_growth::node
