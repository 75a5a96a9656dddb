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
constexpr double kMaxPosition = 1e6;   ///< of each coordinate of a point source [m]
constexpr double kMaxStrength = 1e3;   ///< [-]
constexpr double kLongestWait = 1e12;  ///< of each time in a timing [s]

/// Most stimuli of one kind at a time: every organ senses each of them at every bend.
constexpr std::size_t kMostStimuli = 256;

/// When a stimulus that is added or changed is on, in growth time. It switches at the first step boundary that is not
/// earlier.
struct StimulusTiming {
  double start = 0.0;     ///< from when the command is taken until the stimulus is on [s]; until then nothing changes
  double duration = 0.0;  ///< for which it is on [s]; 0: for ever
  double period = 0.0;    ///< from one flash to the next [s], not shorter than one of them; 0: it is on once
};

/// One change of the stimuli, in the world frame.
struct StimulusCommand {
  StimulusKind kind = StimulusKind::point_source;
  StimulusOperation operation = StimulusOperation::add;
  std::string id;                              ///< unique among stimuli of one kind; not empty
  rod::Vector3 vector = rod::Vector3::Zero();  ///< position [m], or direction towards the light (any length > 0)
  double strength = 1.0;                       ///< multiplies the sensitivity of the organ [-]; negative repels
  StimulusTiming timing = {};                  ///< of what is not removed
};

const char* name(StimulusKind kind);
const char* name(StimulusOperation operation);

/// Why a stimulus cannot be on at such times, or nothing.
std::optional<std::string> findFault(const StimulusTiming& timing);

/// Why the command makes sense for no environment (empty id, number not finite or out of range, zero direction), or
/// nothing.
std::optional<std::string> findFault(const StimulusCommand& command);

/// Applies the command whatever its timing, or leaves the environment as it was and returns why.
std::optional<std::string> apply(const StimulusCommand& command, growth::Environment& environment);

}  // namespace sensory_growth::simulation
