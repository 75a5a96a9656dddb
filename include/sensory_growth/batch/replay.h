#pragma once

/// Runs again what a bag holds, and compares with it step by step.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/batch/batch_run.h"
#include "sensory_growth/batch/recorded_run.h"

namespace sensory_growth::batch {

/// Where a replay first does something else than what was recorded.
struct Difference {
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  std::string what;
};

struct ReplayReport {
  std::uint64_t compared = 0;  ///< states with a recorded checksum, the last one compared included
  std::optional<Difference> difference;
  bool interrupted = false;
};

/// Steps that a replay takes.
std::uint64_t stepsOf(const RecordedRun& recorded);

class Replay {
 public:
  /// Called after every step with how many were taken; false ends the replay.
  using Go = std::function<bool(std::uint64_t steps, const node::Snapshot& snapshot)>;

  /// `recorded` must outlive the replay. Throws as BatchRun does.
  Replay(const RecordedRun& recorded, const node::Parameters& parameters, const node::LoadedScenario& loaded,
         BatchRun::Watch watch);

  ReplayReport run(const Go& go);

  std::optional<node::RecordingSummary> finish() { return run_.finish(); }
  node::SnapshotPtr snapshot() const { return run_.snapshot(); }

 private:
  void listen(const node::Message& message);
  void begin(const RecordedEpoch& epoch);
  std::optional<std::string> follow(const RecordedEpoch& epoch, std::uint64_t step);
  std::optional<std::string> compareCommands(const std::vector<AppliedCommand>& recorded) const;

  const RecordedRun& recorded_;
  const node::Parameters parameters_;
  const BatchRun::Watch watch_;
  std::vector<AppliedCommand> commands_;  // of the replay at the present step
  std::vector<std::uint64_t> checksums_;  // the same
  BatchRun run_;
};

}  // namespace sensory_growth::batch
