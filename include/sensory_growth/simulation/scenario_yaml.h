#pragma once

/// Scenarios as YAML files. Every number that has a dimension carries its unit; see docs/scenario.md for all keys.

#include <string>
#include <vector>

#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/scenario_error.h"

namespace sensory_growth::simulation {

/// Reads a scenario. Throws ScenarioError with every problem found, and std::runtime_error if udunits2 cannot read its
/// database of units.
Scenario loadScenario(const std::string& file);

/// The same from text; `source` names it in messages.
Scenario parseScenario(const std::string& yaml, const std::string& source);

/// Reads one entry of `organs` from text. Throws as loadScenario() does.
OrganScenario parseOrgan(const std::string& yaml, const std::string& source, RelaxationMethod relaxation);

/// Reads a protocol on its own: a file whose only top-level keys besides `name` and `description` are
/// `stimuli` and `protocol`. In order of time; the stimuli are added at time 0. Throws as loadScenario() does, but
/// cannot tell whether what it changes, removes or sets will exist.
std::vector<TimedCommand> loadProtocol(const std::string& file);

/// The same from text.
std::vector<TimedCommand> parseProtocol(const std::string& yaml, const std::string& source);

}  // namespace sensory_growth::simulation
