#pragma once

#include <string>

#include "sensory_growth/ros/confined_file.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/ros/simulation_loop.h"

namespace sensory_growth::node {

/// Keeps the state of a running simulation in files of one directory, and goes on from them. What takes long (disk,
/// parsing, building organs) is done on the calling thread, so that a refusal never touches what runs.
class Checkpoints {
 public:
  /// `node` is its name, `step` the ROS time of a step [s]. The references must outlive the object.
  Checkpoints(const Parameters& parameters, const std::string& node, double step, SimulationLoop& loop,
              const Reporter& reporter);

  // One at a time, not from the thread of the loop.
  Answer save(const std::string& file);
  Answer load(const std::string& file, bool keep_stimuli);

 private:
  simulation::Simulation resume(const std::string& path, const simulation::Checkpoint& checkpoint) const;
  Answer refusal(const std::string& why) const;

  const Parameters parameters_;
  const std::string node_;
  const double step_;
  const Confinement files_;
  SimulationLoop& loop_;
  const Reporter& reporter_;
};

}  // namespace sensory_growth::node
