#pragma once

/// A run without a master, one step after another. States are stamped by counting them, as a node does that publishes
/// the clock; so a bag is what the node would have recorded, but for what it measures of its own speed.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "sensory_growth/ros/loaded_scenario.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/recording.h"
#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/ros/run.h"
#include "sensory_growth/ros/stimulus_counters.h"

namespace sensory_growth::batch {

class BatchRun {
 public:
  /// Sees every message, in order.
  using Watch = std::function<void(const node::Message&)>;

  /// A checkpoint from which to go on with the scenario, or nothing: from step 0.
  using Origin = std::optional<simulation::Checkpoint>;

  /// Shows the first state; `epoch` counts the resets and loads before it. Opens the bag that the parameters name, if
  /// ~record. Throws BadInput if the bag or the simulation cannot be begun.
  BatchRun(const node::Parameters& parameters, const node::LoadedScenario& loaded, Watch watch, std::uint32_t epoch = 0,
           const Origin& origin = std::nullopt);

  /// Nothing, or why the step failed; then the run is over.
  std::optional<std::string> step();

  void apply(const simulation::Command& command);
  void reset();

  /// Goes on from the checkpoint with its scenario. Throws BadInput if that cannot be.
  void load(simulation::Scenario scenario, const simulation::Checkpoint& checkpoint);

  /// The run as it stands.
  simulation::Checkpoint checkpoint() const { return reporter_.checkpointOf(run_.state()); }

  bool finished() const { return run_.finished(); }
  node::SnapshotPtr snapshot() const { return run_.snapshot(); }

  /// Closes the bag. Nothing if there is none.
  std::optional<node::RecordingSummary> finish();

 private:
  class Reporter : public node::Reporter {
   public:
    Reporter(const node::Parameters& parameters, const node::Sources& sources, const node::StimulusCounters& counters,
             Watch watch);

    std::optional<node::RecordingSummary> failure;

   private:
    void open(const Topic&) override {}
    void close(const Topic&) override {}
    void publish(const Topic& topic, const node::Message& message) override;
    void warn(const node::RecordingSummary& summary) override { failure = summary; }
    void warnOfSize(const std::string&) override {}

    const Watch watch_;
  };

  void showStatus();

  const int threads_;
  std::uint64_t ticks_ = 0;
  node::StimulusCounters counters_;
  Reporter reporter_;
  node::Run run_;
  std::optional<std::string> fault_;
};

/// The absolute path of a file to be written, whose folder is made. Throws BadInput if that fails.
std::filesystem::path inFolder(const std::string& file);

/// Parameters that record to the file of that path, unless it is empty. Throws BadInput if its folder cannot be made
/// or the file exists.
void recordTo(const std::string& bag, node::Parameters& parameters);

/// Steps that fill the time [s]; both positive.
std::uint64_t stepsIn(double duration, double step);

}  // namespace sensory_growth::batch
