#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/rod/rotations.h"
#include "sensory_growth/simulation/organ_state.h"
#include "sensory_growth/simulation/schedule.h"

namespace sensory_growth::simulation {

/// How an organ that the scenario does not have came to be.
struct Birth {
  std::string id;
  std::string organ;                            ///< as in SpawnCommand
  rod::Vector3 gravity = rod::Vector3::Zero();  ///< then in force [m/s^2]
};

/// All that decides how a simulation goes on, beside its scenario: from equal states follow equal bits.
struct SimulationState {
  std::uint64_t step_index = 0;
  rod::Vector3 gravity = rod::Vector3::Zero();  ///< in force [m/s^2]
  bool gravity_changed = false;                 ///< since the last step
  std::vector<growth::PointSource> point_sources;
  std::vector<growth::LightDirection> light_directions;
  std::vector<ScheduledStimulus> scheduled;
  std::vector<OrganState> organs;
  std::vector<Birth> births;                    ///< of those that the scenario does not have
  std::vector<rod::Vector3> source_velocities;  ///< of the organs that others sense (OrganSources)
};

/// The latest step that a state may be at: growth time still counts every step.
constexpr std::uint64_t kLatestStep = std::uint64_t{1} << 50;

}  // namespace sensory_growth::simulation
