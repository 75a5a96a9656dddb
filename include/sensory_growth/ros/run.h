#pragma once

/// A simulation that is listened to: every state, command and change of stimuli is shown as it happens, in order.

#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "sensory_growth/ros/snapshot.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/simulation/checkpoint.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node {

enum class Mode {
  paused,
  running,
  finished,  ///< the duration of the scenario is reached; step and reset still work
  fault,     ///< a step failed; the last good state is kept; reset or a checkpoint recovers
};

inline constexpr char kFinished[] = "the duration of the scenario is reached";

struct RunStatus {
  Mode mode = Mode::paused;
  std::string message;  ///< what is wrong; empty if nothing is
  double achieved_real_time_factor = 0.0;
  std::uint64_t overruns = 0;
  double real_time_factor = 0.0;  ///< asked for; 0: as fast as possible
};

class Run;

class RunListener {
 public:
  virtual ~RunListener() = default;

  /// An epoch begins with this checkpoint instead of step 0; its state is that of `snapshot` and shown next.
  virtual void onCheckpoint(const simulation::Checkpoint& checkpoint, const Snapshot& snapshot) = 0;

  /// A new state: the first, after a step, after a reset or from a checkpoint.
  virtual void onState(const SnapshotPtr& snapshot) = 0;

  /// Organs came or went while this state was current; those of `snapshot` are there now.
  virtual void onOrgans(const SnapshotPtr& snapshot) = 0;

  /// A command was taken while the state of `snapshot` was current.
  virtual void onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) = 0;

  /// Gravity and the stimuli in force and to come are those of `snapshot`.
  virtual void onStimuli(const Snapshot& snapshot) = 0;

  virtual void onStatus(const RunStatus& status, const Snapshot& snapshot) = 0;

  /// Everything that was taken is shown: the state of `run` is what came of it.
  virtual void onSettled(const Run& run) = 0;
};

/// Knows neither threads nor clocks. Of its functions only snapshot() may be called from any thread.
class Run {
 public:
  /// Gives the stamp of a new state, later than all before.
  using Stamps = std::function<ros::Time()>;

  /// Shows the first state. The references must outlive the run; `epoch` counts the resets and loads before, `origin`
  /// is what the simulation goes on from, if it does not start at step 0.
  Run(simulation::Simulation simulation, Stamps next_stamp, StimulusCounters& counters, RunListener& listener,
      std::uint32_t epoch = 0, const std::optional<simulation::Checkpoint>& origin = std::nullopt);

  /// Takes a step and shows where it led, with the commands of the protocol that have fallen due. If it fails, the last
  /// good state stays, with the report of what went wrong, and no state is shown.
  simulation::StepReport step();

  /// Applies a command now and shows what became of it.
  simulation::AppliedCommand apply(const simulation::Command& command);

  /// Back to step 0, which is shown as a new state.
  void reset();

  /// Goes on with a simulation that was made from the checkpoint, which is shown as a new state. If `keep_stimuli`,
  /// gravity and the stimuli in force stay.
  void load(simulation::Simulation simulation, simulation::Checkpoint checkpoint, bool keep_stimuli);

  /// To be kept in a checkpoint.
  simulation::SimulationState state() const { return simulation_.state(); }

  bool finished() const { return simulation_.finished(); }

  SnapshotPtr snapshot() const;

 private:
  void showFirstState(const std::optional<simulation::Checkpoint>& origin);
  void setSnapshot(const ros::Time& stamp);
  bool showApplied();

  simulation::Simulation simulation_;
  const Stamps next_stamp_;
  StimulusCounters& counters_;
  RunListener& listener_;
  std::uint32_t epoch_;

  mutable std::mutex mutex_;  // guards what follows; nothing else is locked while it is held
  SnapshotPtr snapshot_;
};

}  // namespace sensory_growth::node
