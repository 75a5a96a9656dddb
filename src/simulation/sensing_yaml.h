#pragma once

#include <vector>

#include "sensory_growth/growth/perception.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {

/// Reads `sensing` of an organ.
std::vector<growth::Route> readSensing(YamlReader& organ);

}  // namespace sensory_growth::simulation
