#pragma once

/// What a run starts from, as texts and as parsed.

#include <string>
#include <vector>

#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/simulation/scenario.h"

namespace sensory_growth::node {

/// A scenario with the commands of the protocol added, and the texts it comes from.
struct LoadedScenario {
  simulation::Scenario scenario;
  Sources sources;
};

/// Reads the files that the parameters name and checks what depends on both. Appends what is wrong to `problems`; the
/// result is meaningful only if nothing was. `node` is the name of who runs it.
LoadedScenario loadScenario(const Parameters& parameters, const std::string& node, std::vector<std::string>& problems);

/// The same from the two texts of `sources`, which are called what the parameters call their files. Completes
/// `sources`.
LoadedScenario parseScenario(const Parameters& parameters, Sources sources, std::vector<std::string>& problems);

/// Name, version and parameters of a node in YAML.
std::string describeEffective(const Parameters& parameters, const std::string& node);

/// Of this package; bags are marked with it.
const char* version();

}  // namespace sensory_growth::node
