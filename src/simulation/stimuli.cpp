#include "sensory_growth/simulation/stimuli.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace sensory_growth::simulation {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(const rod::Vector3& v) { return "(" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + ")"; }

template <typename Stimulus>
std::optional<std::string> applyTo(std::vector<Stimulus>& stimuli, const StimulusCommand& command,
                                   const Stimulus& stimulus) {
  const auto found =
      std::find_if(stimuli.begin(), stimuli.end(), [&](const Stimulus& s) { return s.id == command.id; });
  const bool exists = found != stimuli.end();
  if (!exists && command.operation != StimulusOperation::add) {
    return std::string("there is no ") + name(command.kind) + " '" + command.id + "' to " + name(command.operation);
  }
  if (!exists && stimuli.size() == kMostStimuli) {
    return "there are " + std::to_string(kMostStimuli) + " " + name(command.kind) + "s already; remove one first";
  }
  if (command.operation == StimulusOperation::remove) {
    stimuli.erase(found);
  } else if (exists) {
    *found = stimulus;
  } else {
    stimuli.push_back(stimulus);
  }
  return std::nullopt;
}

}  // namespace

const char* name(StimulusKind kind) { return kind == StimulusKind::point_source ? "point_source" : "light_direction"; }

const char* name(StimulusOperation operation) {
  switch (operation) {
    case StimulusOperation::add:
      return "add";
    case StimulusOperation::change:
      return "change";
    case StimulusOperation::remove:
      return "remove";
  }
  return "?";
}

std::optional<std::string> findFault(const StimulusTiming& timing) {
  const std::pair<const char*, double> times[] = {
      {"start", timing.start}, {"duration", timing.duration}, {"period", timing.period}};
  for (const auto& [name, time] : times) {
    if (!(time >= 0.0 && time <= kLongestWait)) {
      return std::string(name) + " " + text(time) + " s is not in [0, " + text(kLongestWait) + "] s";
    }
  }
  if (timing.period == 0.0) return std::nullopt;
  const std::string period = "period " + text(timing.period) + " s";
  if (timing.duration == 0.0) return period + " needs a duration, for which each flash is on";
  if (timing.duration <= timing.period) return std::nullopt;
  return period + " is shorter than the duration of " + text(timing.duration) + " s";
}

std::optional<std::string> findFault(const StimulusCommand& command) {
  if (command.id.empty()) return "id is empty; a stimulus needs a name";
  if (command.operation == StimulusOperation::remove) return std::nullopt;
  const bool is_direction = command.kind == StimulusKind::light_direction;
  const std::string what = is_direction ? "direction" : "position";
  if (!command.vector.allFinite()) return what + " " + text(command.vector) + " is not finite";
  if (is_direction && !(command.vector.stableNorm() > 0.0)) return what + " has zero length";
  if (!is_direction && command.vector.cwiseAbs().maxCoeff() > kMaxPosition) {
    return what + " " + text(command.vector) + " lies beyond +-" + text(kMaxPosition) + " m";
  }
  if (!(std::abs(command.strength) <= kMaxStrength)) {
    return "strength " + text(command.strength) + " is not in [" + text(-kMaxStrength) + ", " + text(kMaxStrength) +
           "]";
  }
  return findFault(command.timing);
}

std::optional<std::string> apply(const StimulusCommand& command, growth::Environment& environment) {
  if (auto fault = findFault(command)) return fault;
  if (command.kind == StimulusKind::point_source) {
    return applyTo(environment.point_sources, command, {command.id, command.vector, command.strength});
  }
  return applyTo(environment.light_directions, command,
                 {command.id, command.vector.stableNormalized(), command.strength});
}

}  // namespace sensory_growth::simulation
