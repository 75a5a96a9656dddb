#pragma once

/// Reads what is in force when a simulation starts and what changes while it runs.

#include <vector>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/schedule.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {

/// What a protocol finds, to refuse what would change nothing in it.
struct KnownWorld {
  growth::Environment environment;
  std::vector<OrganScenario> organs;
  Schedule schedule;
  double step;  ///< growth time between two step boundaries [s]
};

/// The vector [m/s^2] from its direction and its size.
rod::Vector3 readGravity(YamlReader& in);

/// The keys `stimuli` and `protocol`. `known` is null if the world is not known; it is left as the protocol leaves it.
void readProtocol(YamlReader& in, std::vector<TimedCommand>& protocol, KnownWorld* known);

}  // namespace sensory_growth::simulation
