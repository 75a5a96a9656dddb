#include "sensory_growth/simulation/checkpoint.h"

#include <xxhash.h>

#include <cereal/archives/portable_binary.hpp>
#include <sstream>

#include "state_archive.h"

namespace sensory_growth::simulation {
namespace {

using Writer = cereal::PortableBinaryOutputArchive;
using Reader = cereal::PortableBinaryInputArchive;

/// Begins with a byte that no text has, and has the line ends that careless copying changes.
const std::string kMark("\x89SGC\r\n\x1a\n", 8);

struct Header {
  std::uint32_t format = kCheckpointFormat;
  std::uint64_t size = 0;      ///< of what follows [byte]
  std::uint64_t checksum = 0;  ///< of the same

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(format, size, checksum);
  }
};

template <typename Archive, typename Content>
void archiveContent(Archive& archive, Content& checkpoint) {
  archive(checkpoint.version, checkpoint.scenario, checkpoint.protocol, checkpoint.state);
}

std::uint64_t checksumOf(const std::string& bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

/// The lowest byte first on all machines.
template <typename Write>
std::string written(const Write& write) {
  std::ostringstream stream;
  Writer archive(stream, Writer::Options::LittleEndian());
  write(archive);
  return stream.str();
}

std::size_t headerSize() {
  static const std::size_t size = written([](Writer& archive) { archive(Header()); }).size();
  return size;
}

}  // namespace

std::string encode(const Checkpoint& checkpoint) {
  const std::string content = written([&](Writer& archive) { archiveContent(archive, checkpoint); });
  const Header header{kCheckpointFormat, content.size(), checksumOf(content)};
  std::string bytes = kMark + written([&](Writer& archive) { archive(header); }) + content;
  if (bytes.size() > kLargestCheckpoint) {
    throw CheckpointError("would have " + std::to_string(bytes.size()) + " bytes; a checkpoint has at most " +
                          std::to_string(kLargestCheckpoint));
  }
  return bytes;
}

Checkpoint decode(const std::string& bytes) {
  if (bytes.compare(0, kMark.size(), kMark) != 0) throw CheckpointError("is no checkpoint");
  const std::size_t begin = kMark.size() + headerSize();
  if (bytes.size() < begin) throw CheckpointError("is cut off");
  Checkpoint checkpoint;
  try {
    Header header;
    std::istringstream first(bytes.substr(kMark.size(), headerSize()));
    Reader header_archive(first);
    header_archive(header);
    if (header.format != kCheckpointFormat) {
      throw CheckpointError("has format " + std::to_string(header.format) + "; this version of sensory_growth reads " +
                            std::to_string(kCheckpointFormat) +
                            (header.format > kCheckpointFormat ? ", a newer one is needed" : ""));
    }
    if (bytes.size() - begin != header.size) {
      throw CheckpointError("is cut off or has been added to: it has " + std::to_string(bytes.size() - begin) +
                            " bytes of content instead of " + std::to_string(header.size));
    }
    const std::string content = bytes.substr(begin);
    if (checksumOf(content) != header.checksum) throw CheckpointError("was altered: its checksum is another");
    std::istringstream rest(content);
    Reader content_archive(rest);
    archiveContent(content_archive, checkpoint);
    if (rest.peek() != std::istringstream::traits_type::eof()) throw CheckpointError("holds more than a checkpoint");
  } catch (const cereal::Exception&) {
    throw CheckpointError("was altered: it holds less than it says");
  } catch (const std::invalid_argument& fault) {
    throw CheckpointError(std::string("was altered: ") + fault.what());
  }
  return checkpoint;
}

}  // namespace sensory_growth::simulation
