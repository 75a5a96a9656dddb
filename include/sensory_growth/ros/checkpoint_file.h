#pragma once

#include <string>

#include "sensory_growth/simulation/checkpoint.h"

namespace sensory_growth::node {

inline constexpr char kCheckpointExtension[] = ".checkpoint";

/// Reads a regular file. Throws std::runtime_error that begins with the path and says why it is none that can be read.
simulation::Checkpoint readCheckpoint(const std::string& path);

/// Writes a new file that is whole or not there, whatever happens on the way. Throws std::runtime_error that begins
/// with the path if there is one already, or why it cannot be written.
void writeCheckpoint(const std::string& path, const simulation::Checkpoint& checkpoint);

}  // namespace sensory_growth::node
