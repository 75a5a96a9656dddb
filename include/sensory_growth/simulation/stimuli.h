#pragma once

/// The one typed path by which the stimuli of a simulation change.

#include <cstddef>
#include <optional>
#include <string>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::simulation {

enum class StimulusKind { point_source, light_direction };

enum class StimulusOperation {
  add,     ///< adds the stimulus; one of the same kind and id is replaced
  change,  ///< replaces the stimulus; refused unless it exists
  remove,  ///< refused unless the stimulus exists
};

/// Largest magnitudes a command may hold; beyond them it is surely an error of unit or arithmetic.
constexpr double kMaxPosition = 1e6;  ///< of each coordinate of a point source [m]
constexpr double kMaxStrength = 1e3;  ///< [-]

/// Most stimuli of one kind at a time: every organ senses each of them at every bend.
constexpr std::size_t kMostStimuli = 256;

/// One change of the stimuli, in the world frame.
struct StimulusCommand {
  StimulusKind kind = StimulusKind::point_source;
  StimulusOperation operation = StimulusOperation::add;
  std::string id;                              ///< unique among stimuli of one kind; not empty
  rod::Vector3 vector = rod::Vector3::Zero();  ///< position [m], or direction towards the light (any length > 0)
  double strength = 1.0;                       ///< multiplies the sensitivity of the organ [-]; negative repels
};

const char* name(StimulusKind kind);
const char* name(StimulusOperation operation);

/// Why the command makes sense for no environment (empty id, number not finite or out of range, zero direction), or
/// nothing.
std::optional<std::string> findFault(const StimulusCommand& command);

/// Applies the command, or leaves the environment as it was and returns why.
std::optional<std::string> apply(const StimulusCommand& command, growth::Environment& environment);

}  // namespace sensory_growth::simulation
