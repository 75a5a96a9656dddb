#pragma once

/// The part of an organ in a scenario file that says how it is held and what acts on it.

#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {

/// The section "base" of an organ: base and base_support.
void readBase(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ);

/// The keys of an organ that fill its loads. Expects the base to be read. Refuses what the relaxation cannot serve.
void readLoads(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ);

}  // namespace sensory_growth::simulation
