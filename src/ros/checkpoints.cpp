#include "sensory_growth/ros/checkpoints.h"

#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sensory_growth/ros/checkpoint_file.h"
#include "sensory_growth/ros/loaded_scenario.h"

namespace sensory_growth::node {
namespace {

std::string join(const std::vector<std::string>& texts, const std::string& between) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : between) + text;
  return joined;
}

}  // namespace

Checkpoints::Checkpoints(const Parameters& parameters, const std::string& node, double step, SimulationLoop& loop,
                         const Reporter& reporter)
    : parameters_(parameters),
      node_(node),
      step_(step),
      files_{"checkpoint_directory", parameters.checkpoint_directory, kCheckpointExtension},
      loop_(loop),
      reporter_(reporter) {}

Answer Checkpoints::save(const std::string& file) {
  try {
    const std::string path = confinedPath(files_, file);
    simulation::Checkpoint checkpoint;
    Answer answer =
        loop_.save([&](simulation::SimulationState state) { checkpoint = reporter_.checkpointOf(std::move(state)); });
    if (!answer.success) return answer;
    writeCheckpoint(path, checkpoint);
    answer.message = path;
    return answer;
  } catch (const std::exception& fault) {
    return refusal(fault.what());
  }
}

Answer Checkpoints::load(const std::string& file, bool keep_stimuli) {
  try {
    const std::string path = confinedPath(files_, file);
    const simulation::Checkpoint checkpoint = readCheckpoint(path);
    return loop_.load(resume(path, checkpoint), checkpoint, keep_stimuli);
  } catch (const std::exception& fault) {
    return refusal(fault.what());
  }
}

/// Throws std::exception saying why this node cannot go on from it.
simulation::Simulation Checkpoints::resume(const std::string& path, const simulation::Checkpoint& checkpoint) const {
  std::vector<std::string> problems;
  LoadedScenario loaded = parseScenario(parameters_, node_, path, checkpoint, problems);
  if (!problems.empty()) throw std::runtime_error(join(problems, "\n"));
  const double step = loaded.scenario.stepping.step;
  if (step / parameters_.growth_time_scale != step_) {
    throw std::runtime_error(path + " has steps of " + std::to_string(step) + " s of growth; this run has " +
                             std::to_string(step_ * parameters_.growth_time_scale) + " s, and its clock counts steps");
  }
  try {
    return simulation::Simulation(std::move(loaded.scenario), checkpoint.state, parameters_.threads);
  } catch (const std::invalid_argument& fault) {
    throw std::runtime_error(path + ": " + fault.what());
  }
}

Answer Checkpoints::refusal(const std::string& why) const {
  const SnapshotPtr snapshot = loop_.snapshot();
  return {false, why, snapshot->step_index, snapshot->stamp};
}

}  // namespace sensory_growth::node
