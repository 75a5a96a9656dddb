#pragma once

/// The one typed path by which a simulation changes while it runs.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "sensory_growth/rod/rotations.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::simulation {

/// Stands for every organ where a command asks for the id of one; no organ has this id.
inline constexpr char kAllOrgans[] = "all";

/// Largest acceleration a command may hold [m/s^2]; beyond it, it is surely an error of unit or arithmetic.
constexpr double kMaxGravity = 1e6;

/// No organ is added while there are so many.
constexpr std::size_t kMostOrgans = 256;

/// Longest text of an organ to add [byte].
constexpr std::size_t kLongestOrganText = 100000;

/// Gives one number of an organ, or of all, another value.
struct ParameterCommand {
  std::string organ;   ///< its id, or kAllOrgans
  std::string name;    ///< one of parameters() (simulation/parameters.h)
  double value = 0.0;  ///< in SI
};

/// Turns the world, or takes it away from the Earth: both what organs sense as down and what makes them heavy.
struct GravityCommand {
  rod::Vector3 acceleration = rod::Vector3::Zero();  ///< in the world frame [m/s^2]; at zero nothing is sensed
};

/// Adds an organ, which begins to grow now, in equilibrium.
struct SpawnCommand {
  std::string organ;  ///< YAML of one entry of `organs` in a scenario
};

/// Takes an organ away; nothing of it stays.
struct RemoveCommand {
  std::string organ;  ///< its id
};

using Command = std::variant<StimulusCommand, ParameterCommand, GravityCommand, SpawnCommand, RemoveCommand>;

/// A command with the growth time [s] from which it holds.
struct TimedCommand {
  double time = 0.0;
  Command command;
};

/// A command as it was taken, with the step before which it took effect.
struct AppliedCommand {
  std::uint64_t step = 0;  ///< index of the state that was current when it was applied
  Command command;
  std::string refusal;  ///< why it changed nothing; empty if it was applied
};

/// Why the command makes sense in no world (number not finite or too large), or nothing.
std::optional<std::string> findFault(const GravityCommand& command);

}  // namespace sensory_growth::simulation
