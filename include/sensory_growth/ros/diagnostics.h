#pragma once

/// Health of the simulation on /diagnostics, once a second of wall time.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <set>
#include <string>

#include "sensory_growth/ros/simulation_loop.h"
#include "sensory_growth/ros/snapshot.h"
#include "sensory_growth/ros/stimulus_counters.h"

namespace sensory_growth::node {

/// OK if the last relaxation converged, WARN if it had to be helped (parts cut again, branches left), ERROR if it
/// failed.
void reportRelaxation(const OrganSnapshot& organ, diagnostic_updater::DiagnosticStatusWrapper& status);

void reportLoop(const RunStatus& loop, const Snapshot& snapshot, diagnostic_updater::DiagnosticStatusWrapper& status);

/// WARN while refusals are recent, that is, since the previous report, of which `refused_before` is the count.
void reportStimuli(const StimulusCounters& counters, std::uint64_t refused_before,
                   diagnostic_updater::DiagnosticStatusWrapper& status);

class Diagnostics {
 public:
  struct Sources {
    std::function<SnapshotPtr()> snapshot;
    std::function<RunStatus()> loop;
    std::function<std::string()> recording;  ///< path of the open bag, or empty
    const StimulusCounters* counters = nullptr;
    bool owns_clock = false;
  };

  Diagnostics(ros::NodeHandle node, ros::NodeHandle private_node, Sources sources);

  /// Publishes now; called by a wall timer, because diagnostic_updater itself would wait for ROS time (ros.md 52).
  void update();

 private:
  void followOrgans();

  Sources sources_;
  SnapshotPtr snapshot_;  // that is being reported
  std::set<std::string> organs_;
  std::uint64_t refused_before_ = 0;
  diagnostic_updater::Updater updater_;
};

}  // namespace sensory_growth::node
