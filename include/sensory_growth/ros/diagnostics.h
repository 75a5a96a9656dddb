#pragma once

/// Health of the simulation on /diagnostics, once a second of wall time.

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <set>
#include <string>

#include "sensory_growth/ros/clock.h"
#include "sensory_growth/ros/master_watch.h"
#include "sensory_growth/ros/simulation_loop.h"
#include "sensory_growth/ros/snapshot.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/wall_throttle.h"

namespace sensory_growth::node {

/// OK if the last relaxation converged, WARN if it had to be helped (parts cut again, branches left), ERROR if it
/// failed.
void reportRelaxation(const OrganSnapshot& organ, diagnostic_updater::DiagnosticStatusWrapper& status);

void reportLoop(const RunStatus& loop, const Snapshot& snapshot, diagnostic_updater::DiagnosticStatusWrapper& status);

/// WARN while refusals are recent, that is, since the previous report, of which `refused_before` is the count.
void reportStimuli(const StimulusCounters& counters, std::uint64_t refused_before,
                   diagnostic_updater::DiagnosticStatusWrapper& status);

/// WARN if recording ended early because of `failure`, which is empty otherwise. `path` is that of the open bag, or
/// empty.
void reportRecording(const std::string& path, const std::string& failure,
                     diagnostic_updater::DiagnosticStatusWrapper& status);

void reportMaster(MasterWatch::State state, diagnostic_updater::DiagnosticStatusWrapper& status);

/// ERROR if /clock has more than one publisher, WARN if it has none; `others` are the publishers but for this node.
void reportClock(ClockMode mode, const std::vector<std::string>& others,
                 diagnostic_updater::DiagnosticStatusWrapper& status);

class Diagnostics {
 public:
  struct Sources {
    std::function<SnapshotPtr()> snapshot;
    std::function<RunStatus()> loop;
    std::function<std::string()> recording;          ///< path of the open bag, or empty
    std::function<std::string()> recording_failure;  ///< why it ended early, or empty
    const StimulusCounters* counters = nullptr;
    ClockMode clock_mode = ClockMode::publish;
  };

  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Sources sources);

  /// Publishes now; called by a wall timer, because diagnostic_updater itself would wait for ROS time (ros.md 52).
  void update();

 private:
  void followOrgans();

  Sources sources_;
  SnapshotPtr snapshot_;  // that is being reported
  std::set<std::string> organs_;
  std::uint64_t refused_before_ = 0;
  WallThrottle clock_warnings_;
  MasterWatch master_;
  diagnostic_updater::Updater updater_;
};

}  // namespace sensory_growth::node
