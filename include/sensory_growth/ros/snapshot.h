#pragma once

/// What the simulation looked like at one step boundary. Immutable, so that every publisher can read it without a lock.

#include <ros/time.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/surroundings.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node {

struct OrganSnapshot {
  std::string id;
  rod::Rod rod;
  std::vector<double> growth_rates;  ///< of the elements [1/s]
  growth::CueFields cues;
  mechanics::Energy energy;
  mechanics::Surroundings surroundings;
  simulation::OrganReport report;  ///< of the step that led here
};

struct Snapshot {
  ros::Time stamp;  ///< ROS time of the step; two states never share it
  std::uint64_t step_index = 0;
  std::uint32_t epoch = 0;                      ///< resets so far
  double growth_time = 0.0;                     ///< [s]
  std::uint64_t checksum = 0;                   ///< of the state (simulation/checksum.h)
  rod::Vector3 gravity = rod::Vector3::Zero();  ///< [m/s^2]
  growth::Environment environment;
  std::vector<simulation::ScheduledStimulus> scheduled;
  std::vector<OrganSnapshot> organs;
};

using SnapshotPtr = std::shared_ptr<const Snapshot>;

SnapshotPtr takeSnapshot(const simulation::Simulation& simulation, const ros::Time& stamp, std::uint32_t epoch);

}  // namespace sensory_growth::node
