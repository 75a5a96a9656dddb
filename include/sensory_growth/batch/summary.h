#pragma once

/// How a run without a master went.

#include <cstdint>
#include <optional>
#include <string>

#include "sensory_growth/batch/commands.h"
#include "sensory_growth/ros/recording.h"
#include "sensory_growth/ros/snapshot.h"

namespace sensory_growth::batch {

struct Summary {
  std::uint64_t steps = 0;
  double wall_time = 0.0;      ///< [s]
  node::SnapshotPtr snapshot;  ///< the last
  std::optional<node::RecordingSummary> recording;
  bool interrupted = false;
};

/// "480 steps, 8 h of growth in 0.6 s (800 steps/s), checksum 0123456789abcdef, run.bag: 2900 messages"
std::string describe(const Summary& summary);

/// Complains about a bag that could not be written, and chooses the exit code.
ExitCode conclude(const Summary& summary, bool has_failed, const Console& console);

}  // namespace sensory_growth::batch
