#include "sensory_growth/ros/checkpoint_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace sensory_growth::node {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::runtime_error(path + " " + why);
}

[[noreturn]] void fail(const std::string& path, int error) {
  refuse(path, "cannot be written: " + std::generic_category().message(error));
}

/// Closes what it holds.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) fail(path, errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  const int number_;
};

void write(const std::string& path, const std::string& bytes) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t count = ::write(file.number(), bytes.data() + written, bytes.size() - written);
    if (count < 0 && errno != EINTR) fail(path, errno);
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  if (::fsync(file.number()) != 0) fail(path, errno);
}

/// So that the name is on the disk, too.
void syncDirectory(const std::string& path) {
  const Descriptor directory(path, O_RDONLY | O_DIRECTORY);
  if (::fsync(directory.number()) != 0) fail(path, errno);
}

}  // namespace

simulation::Checkpoint readCheckpoint(const std::string& path) {
  std::error_code failure;
  const auto status = std::filesystem::symlink_status(path, failure);
  if (!std::filesystem::exists(status)) refuse(path, "does not exist");
  if (!std::filesystem::is_regular_file(status)) refuse(path, "is no regular file");
  const auto size = std::filesystem::file_size(path, failure);
  if (failure) refuse(path, "cannot be read: " + failure.message());
  if (size > simulation::kLargestCheckpoint) {
    refuse(path, "has " + std::to_string(size) + " bytes; a checkpoint has at most " +
                     std::to_string(simulation::kLargestCheckpoint));
  }
  std::string bytes(size, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) refuse(path, "cannot be read");
  try {
    return simulation::decode(bytes);
  } catch (const simulation::CheckpointError& error) {
    refuse(path, error.what());
  }
}

void writeCheckpoint(const std::string& path, const simulation::Checkpoint& checkpoint) {
  const std::filesystem::path target(path);
  if (std::filesystem::exists(std::filesystem::symlink_status(target))) refuse(path, "exists already");
  const std::string partial = path + ".active";
  try {
    write(partial, simulation::encode(checkpoint));
    std::filesystem::rename(partial, target);
  } catch (const std::exception&) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw;
  }
  syncDirectory(target.parent_path());
}

}  // namespace sensory_growth::node
