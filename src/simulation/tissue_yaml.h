#pragma once

/// The part of an organ in a scenario file that says what its tissue is and how it grows and divides.

#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {

/// The section "material" of an organ. Refuses what the relaxation cannot serve.
void readMaterial(YamlReader& in, RelaxationMethod relaxation, rod::Section& section);

/// The section "growth" of an organ: profile, elongation, transport of twist and stress coupling. Expects the material
/// to be read.
void readGrowth(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ);

/// The section "aging" of an organ.
growth::Aging readAging(YamlReader& in, RelaxationMethod relaxation);

/// The section "division" of an organ. Expects the length to be read.
void readDivision(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ);

}  // namespace sensory_growth::simulation
