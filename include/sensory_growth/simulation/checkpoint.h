#pragma once

/// A simulation between two steps as a sequence of bytes that needs nothing else to go on: the texts that it was built
/// from and its state.
///
/// The bytes are the same on all machines: a mark, the version of the format, size and XXH3 of what follows, and that.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sensory_growth/simulation/simulation_state.h"

namespace sensory_growth::simulation {

struct Checkpoint {
  std::string version;   ///< of the package that made it; for people
  std::string scenario;  ///< YAML
  std::string protocol;  ///< YAML of the commands added to those of the scenario; empty: none
  SimulationState state;
};

/// Why bytes are no checkpoint that can be read.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The only format that is read. Whoever changes what is written counts on.
constexpr std::uint32_t kCheckpointFormat = 1;

/// More bytes are surely something else.
constexpr std::size_t kLargestCheckpoint = std::size_t{1} << 30;

/// Throws CheckpointError if it is too large.
std::string encode(const Checkpoint& checkpoint);

/// Throws CheckpointError saying whether the bytes are something else, cut off, altered or of a newer format. Whether
/// the state fits the scenario is found out by the Simulation that goes on from it.
Checkpoint decode(const std::string& bytes);

}  // namespace sensory_growth::simulation
