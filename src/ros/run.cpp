#include "sensory_growth/ros/run.h"

#include <exception>
#include <utility>
#include <variant>
#include <vector>

namespace sensory_growth::node {
namespace {

simulation::StepReport stepGuarded(simulation::Simulation& simulation) {
  try {
    return simulation.step();
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

bool changesOrgans(const simulation::Command& command) {
  return std::holds_alternative<simulation::SpawnCommand>(command) ||
         std::holds_alternative<simulation::RemoveCommand>(command);
}

}  // namespace

Run::Run(simulation::Simulation simulation, Stamps next_stamp, StimulusCounters& counters, RunListener& listener,
         std::uint32_t epoch, const std::optional<simulation::Checkpoint>& origin)
    : simulation_(std::move(simulation)),
      next_stamp_(std::move(next_stamp)),
      counters_(counters),
      listener_(listener),
      epoch_(epoch) {
  showFirstState(origin);
}

simulation::StepReport Run::step() {
  simulation::StepReport report = stepGuarded(simulation_);
  const bool has_applied = showApplied();  // taken while the state before this step was current
  if (!report.ok) {
    setSnapshot(snapshot_->stamp);
    return report;
  }
  setSnapshot(next_stamp_());
  listener_.onState(snapshot_);
  if (has_applied) listener_.onStimuli(*snapshot_);
  listener_.onSettled(*this);
  return report;
}

simulation::AppliedCommand Run::apply(const simulation::Command& command) {
  simulation::AppliedCommand applied = simulation_.apply(command);
  const bool is_done = applied.refusal.empty();
  if (is_done) setSnapshot(snapshot_->stamp);  // who hears of a command finds it done
  showApplied();
  if (is_done) {
    if (changesOrgans(command)) {
      listener_.onOrgans(snapshot_);
    } else {
      listener_.onStimuli(*snapshot_);
    }
  }
  listener_.onSettled(*this);
  return applied;
}

void Run::reset() {
  simulation_.reset();
  ++epoch_;
  showFirstState(std::nullopt);
}

void Run::load(simulation::Simulation simulation, simulation::Checkpoint checkpoint, bool keep_stimuli) {
  if (keep_stimuli) simulation.takeStimuliOf(simulation_);
  simulation_ = std::move(simulation);
  checkpoint.state = simulation_.state();
  ++epoch_;
  showFirstState(checkpoint);
}

SnapshotPtr Run::snapshot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return snapshot_;
}

void Run::showFirstState(const std::optional<simulation::Checkpoint>& origin) {
  setSnapshot(next_stamp_());
  if (origin) listener_.onCheckpoint(*origin, *snapshot_);
  listener_.onState(snapshot_);
  showApplied();
  listener_.onStimuli(*snapshot_);
}

void Run::setSnapshot(const ros::Time& stamp) {
  SnapshotPtr snapshot = takeSnapshot(simulation_, stamp, epoch_);
  const std::lock_guard<std::mutex> lock(mutex_);
  snapshot_ = std::move(snapshot);
}

bool Run::showApplied() {
  const std::vector<simulation::AppliedCommand> applied = simulation_.takeApplied();
  for (const simulation::AppliedCommand& command : applied) {
    if (std::holds_alternative<simulation::StimulusCommand>(command.command)) {
      counters_.count(command.refusal.empty() ? StimulusFate::accepted : StimulusFate::not_applicable);
    }
    listener_.onCommand(command, *snapshot_);
  }
  return !applied.empty();
}

}  // namespace sensory_growth::node
