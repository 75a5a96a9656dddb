#pragma once

/// Valid scenarios at random, as text, so that what reads them is part of what is tested. Parameters that may change
/// while a simulation runs are drawn from their table.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/dice.h"
#include "support/random_organs.h"

namespace sensory_growth::support {

inline std::string relaxationText(Dice& dice, const Draft& draft) {
  if (draft.method == "dynamic") return "relaxation: {method: dynamic, tolerance: 1e-6}\n";
  if (draft.method != "continuous") return "relaxation: {method: " + draft.method + "}\n";
  // A step lasts for some time steps of the motion of the largest organs: their radius over the speed of sound.
  const double motion = dice.logBetween(0.5, 50.0) * 1e-2 * std::sqrt(kTissueDensity / 1e6);
  return "relaxation: {method: continuous, growth_per_second: " + si(draft.step / motion, "s") + "}\n";
}

inline std::string lampText(Dice& dice, const std::string& id) {
  return "{id: " + id + ", position: " + vectorOf(dice, 0.3, "m") + ", strength: " + si(dice.between(-2.0, 2.0), "") +
         "}";
}

inline std::string sunText(Dice& dice, const std::string& id) {
  return "{id: " + id + ", towards: " + directionOf(dice) + ", strength: " + si(dice.between(-2.0, 2.0), "") + "}";
}

inline std::string gravityText(Dice& dice) {
  return "{direction: " + directionOf(dice) +
         ", acceleration: " + si(dice.pick<double>({0.0, 9.81, 9.81, 30.0}), "m/s^2") + "}";
}

/// Another value for a number that an organ has.
inline std::string settingText(Dice& dice, const simulation::Scenario& scenario) {
  const simulation::OrganScenario& organ = dice.pick(scenario.organs);
  std::vector<simulation::Parameter> had;
  for (const simulation::Parameter& parameter : simulation::parameters()) {
    if (parameter.get(organ)) had.push_back(parameter);
  }
  const simulation::Parameter& parameter = dice.pick(had);
  simulation::ParameterCommand command{organ.id, parameter.name, *parameter.get(organ)};
  const double value = command.value * dice.pick<double>({0.0, 0.5, -1.0, 1.5});
  std::vector<simulation::OrganScenario> organs = scenario.organs;
  const simulation::ParameterCommand other{organ.id, parameter.name, value};
  if (!simulation::apply(other, organs)) command = other;
  return "{organ: " + command.organ + ", name: " + command.name +
         ", value: " + si(command.value, parameter.dimension ? parameter.dimension->unit : "") + "}";
}

inline std::string protocolText(Dice& dice, const Draft& draft, const simulation::Scenario& scenario) {
  std::vector<double> times;
  for (int i = dice.count(0, 6); i > 0; --i) times.push_back(dice.between(0.0, draft.steps * draft.step));
  std::sort(times.begin(), times.end());
  std::string text;
  for (const double time : times) {
    const std::string what = dice.pick<std::string>({"add: {point_source: " + lampText(dice, "lamp") + "}",
                                                     "add: {light_direction: " + sunText(dice, "late_sun") + "}",
                                                     "change: {light_direction: " + sunText(dice, "sun") + "}",
                                                     "set: {gravity: " + gravityText(dice) + "}",
                                                     "set: {parameter: " + settingText(dice, scenario) + "}"});
    text += "  - {at: " + si(time, "s") + ", " + what + "}\n";
  }
  return text.empty() ? "" : "protocol:\n" + text;
}

/// A scenario that is worth running for so many steps.
inline std::string randomScenario(unsigned seed, int steps, const std::string& method) {
  Dice dice(seed);
  Draft draft = {};
  draft.steps = steps;
  draft.method = method;
  draft.step = dice.logBetween(1.0, 1000.0);
  std::string text = "name: random_" + std::to_string(seed) + "\ngravity: " + gravityText(dice) +
                     "\nweight: " + (draft.isKinematic() || dice.chance(0.2) ? "false" : "true") +
                     "\nstepping: {step: " + si(draft.step, "s") +
                     ", second_order: " + dice.pick<std::string>({"true", "false"}) +
                     ", limits: {smallest_part: 0.01}}\n" + relaxationText(dice, draft) + "organs:\n";
  for (int i = 0, organs = dice.count(1, 3); i < organs; ++i) text += organText(dice, draft, i);
  text += "stimuli:\n  light_directions:\n    - " + sunText(dice, "sun") + "\n";
  if (dice.chance(0.5)) text += "  point_sources:\n    - " + lampText(dice, "lamp") + "\n";
  return text + protocolText(dice, draft, simulation::parseScenario(text, "random"));
}

}  // namespace sensory_growth::support
