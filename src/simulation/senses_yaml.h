#pragma once

/// The part of an organ in a scenario file that says what it senses and how it bends by that.

#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {

/// The keys of an organ that fill its senses and its bending law.
void readSenses(YamlReader& in, OrganScenario& organ);

}  // namespace sensory_growth::simulation
