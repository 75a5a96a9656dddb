#pragma once

/// The numbers of an organ that may change while it grows. All others are built into it when a simulation starts.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/simulation/commands.h"
#include "sensory_growth/simulation/range.h"
#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/units.h"

namespace sensory_growth::simulation {

struct Parameter {
  std::string name;            ///< its key in a scenario, below organs[]
  const Dimension* dimension;  ///< null for a number without a unit
  Range range;                 ///< of the value in SI

  /// The value in SI; nothing if the organ has no such part.
  std::function<std::optional<double>(const OrganScenario&)> get;
  std::function<void(OrganScenario&, double)> set;  ///< for organs that have it
};

/// All there are.
const std::vector<Parameter>& parameters();

/// The one of that name; null if there is none.
const Parameter* findParameter(const std::string& name);

/// Why there is no such parameter: a misspelling, or a part of an organ that is built in when a simulation starts.
std::string whyUnknown(const std::string& name);

/// Why the command makes sense for no organ (no such parameter, value out of range), or nothing.
std::optional<std::string> findFault(const ParameterCommand& command);

/// Applies the command to the organs it means, or leaves all as they were and returns why: there must be such an organ,
/// it must have that part, and the value must go with its others.
std::optional<std::string> apply(const ParameterCommand& command, std::vector<OrganScenario>& organs);

/// Whether the command means this organ.
bool addresses(const ParameterCommand& command, const OrganScenario& organ);

}  // namespace sensory_growth::simulation
