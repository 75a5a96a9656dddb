#pragma once

/// What a bag holds that is needed to run the same again, and to see whether it was the same.

#include <rosbag/bag.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/batch/frame_files.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/simulation/checkpoint.h"

namespace sensory_growth::batch {

/// What happened from a reset or a checkpoint to the next.
struct RecordedEpoch {
  /// From which it began; nothing if it began at step 0.
  std::optional<simulation::Checkpoint> origin;

  /// Checksums of each state and of what commands made of it, in order; a step that was not recorded is missing.
  std::map<std::uint64_t, std::vector<std::uint64_t>> checksums;

  /// Taken while the state of that step was current, in order; from the beginning on, even if recording began later.
  std::map<std::uint64_t, std::vector<AppliedCommand>> commands;

  std::uint64_t beginning() const { return origin ? origin->state.step_index : 0; }
  std::uint64_t firstStep() const { return checksums.begin()->first; }
  std::uint64_t lastStep() const { return checksums.rbegin()->first; }
};

struct RecordedRun {
  std::string version;  ///< of the package that recorded
  node::Parameters parameters;
  node::Sources sources;                          ///< without what follows from the scenario
  std::map<std::uint32_t, RecordedEpoch> epochs;  ///< by number of resets and loads before; none without a state
};

/// Opens a closed bag. Throws BadInput.
rosbag::Bag openBag(const std::string& path);

/// The name of the node whose run the bag holds: `wanted`, or the only one if that is empty. Throws BadInput.
std::string nodeOf(const rosbag::Bag& bag, const std::string& wanted);

/// Throws BadInput if something is missing or is not what this version writes.
RecordedRun readRun(const rosbag::Bag& bag, const std::string& node);

/// Writes the states that the bag holds of a node, those after its last reset. Throws as FrameFiles does.
/// Returns how many states there were.
std::uint64_t writeFrames(const rosbag::Bag& bag, const std::string& node, const FrameOptions& options);

}  // namespace sensory_growth::batch
