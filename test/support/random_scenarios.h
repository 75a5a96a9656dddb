#pragma once

/// Valid scenarios at random, as text, so that what reads them is part of what is tested. Each mechanism is one
/// function in organParts() below; parameters that may change while a simulation runs are drawn from their table.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::support {

/// The same throws for the same seed.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double logBetween(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  template <typename Value>
  const Value& pick(const std::vector<Value>& values) {
    return values[static_cast<std::size_t>(count(0, static_cast<int>(values.size()) - 1))];
  }

 private:
  std::mt19937 random_;
};

/// What the parts of a random scenario have to know about it.
struct Draft {
  int steps;           ///< it will run for
  double step;         ///< [s]
  std::string method;  ///< of relaxation
  double length;       ///< of the organ at hand [m]
  double radius;       ///< [m]
  int elements;
  double young_modulus;  ///< [Pa]
  double base_height;    ///< z of its base [m]

  bool isStatic() const { return method == "static"; }
  bool isKinematic() const { return method == "kinematic"; }
  bool isInTime() const { return method == "dynamic" || method == "continuous"; }

  /// Bending stiffness [N m^2].
  double stiffness() const { return young_modulus * M_PI * std::pow(radius, 4) / 4.0; }

  /// Rate that gives this growth strain in the whole run [1/s].
  double rate(double strain) const { return strain / (steps * step); }
};

constexpr double kTissueDensity = 1000.0;  ///< [kg/m^3]

/// A number with its unit in YAML.
inline std::string si(double value, const std::string& unit) {
  std::ostringstream text;
  text.precision(9);
  text << value << (unit.empty() ? "" : " ") << unit;
  return text.str();
}

inline std::string vectorOf(Dice& dice, double largest, const std::string& unit) {
  std::string text;
  for (int i = 0; i < 3; ++i) text += (i ? ", " : "[") + si(dice.between(-largest, largest), unit);
  return text + "]";
}

/// Nowhere near zero length.
inline std::string directionOf(Dice& dice) {
  return "[" + si(dice.between(-1.0, 1.0), "") + ", " + si(dice.between(-1.0, 1.0), "") + ", " +
         si(dice.pick<double>({-1.0, 1.0}), "") + "]";
}

inline std::string sensitivityOf(Dice& dice) {
  return si(dice.chance(0.3) ? 0.0 : dice.pick<double>({-1.0, 1.0}) * dice.logBetween(1e-3, 3.0), "");
}

// The parts of an organ: each returns lines of YAML, or nothing.

inline std::string growthPart(Dice& dice, const Draft& draft) {
  const std::string rate = si(draft.rate(dice.chance(0.1) ? 0.0 : dice.logBetween(0.01, 2.0)), "1/s");
  const std::string zone = ", zone_length: " + si(draft.length * dice.logBetween(0.05, 3.0), "m");
  const std::string profile = dice.pick<std::string>(
      {"uniform", "apical_flat" + zone, "logistic" + zone + ", steepness: " + si(dice.logBetween(1.0, 100.0), "")});
  return "growth: {profile: " + profile + ", rate: " + rate +
         ", elongation: " + dice.pick<std::string>({"true", "true", "false"}) +
         ", twist_transport: " + dice.pick<std::string>({"angle", "rate"}) + "}\n";
}

inline std::string distanceLaw(Dice& dice, const Draft& draft) {
  const std::string length = ", length: " + si(draft.length * dice.logBetween(0.1, 10.0), "m");
  return dice.pick<std::string>({"constant", "constant", "inverse_power" + length + ", exponent: 2",
                                 "exponential" + length, "gaussian" + length});
}

inline std::string sensesPart(Dice& dice, const Draft& draft) {
  return "sensitivities: {gravity: " + sensitivityOf(dice) + ", light_direction: " + sensitivityOf(dice) +
         ", point_source: " + sensitivityOf(dice) +
         ", softening_length: " + si(draft.length * dice.logBetween(0.02, 1.0), "m") +
         ", intensity_exponent: " + si(dice.chance(0.5) ? 1.0 : dice.logBetween(0.2, 3.0), "") +
         ", distance: {law: " + distanceLaw(dice, draft) + "}}\n" +
         "saturation: " + dice.pick<std::string>({"true", "false"}) + "\n";
}

inline std::string proprioceptionPart(Dice& dice, const Draft& draft) {
  const auto length = [&](const std::string& key, double largest) {
    return key + ": " + si(dice.chance(0.4) ? 0.0 : draft.radius * dice.logBetween(0.01, largest), "m");
  };
  const double curvature = 0.5 / draft.length;
  return "proprioception: {" + length("intrinsic_length", 100.0) + ", " + length("actual_length", 10.0) + ", " +
         length("relaxation_length", 1.0) + ", set_point: [" + si(dice.between(-curvature, curvature), "1/m") + ", " +
         si(dice.between(-curvature, curvature), "1/m") + "]}\n";
}

inline std::string circumnutationPart(Dice& dice, const Draft& draft) {
  const std::string period =
      ", period: " + si(draft.step * dice.pick<double>({-1.0, 1.0}) * dice.logBetween(5.0, 500.0), "s");
  if (dice.chance(0.6)) return "";
  if (dice.chance(0.3)) return "circumnutation: {form: rotation" + period + "}\n";
  return "circumnutation: {form: oscillator, amplitude: " + si(dice.logBetween(0.01, 1.0), "") + period +
         ", phase: " + si(dice.between(0.0, 6.0), "rad") + "}\n";
}

inline std::string divisionPart(Dice& dice, const Draft& draft) {
  const double element = draft.length / draft.elements;
  const std::string longest = dice.chance(0.2) ? "inf" : si(element * dice.between(0.9, 3.0), "m");
  const bool keeps_positions = !draft.isKinematic() && dice.chance(0.3);
  return "division: {longest_element: " + longest + ", mode: " + (keeps_positions ? "keep_positions" : "keep_strain") +
         "}\n";
}

inline std::string sourcePart(Dice& dice, const Draft&) {
  if (dice.chance(0.4)) return "";
  return "source: {label: " + si(dice.between(0.0, 1.0), "") + ", strength: " + si(dice.between(-2.0, 2.0), "") + "}\n";
}

inline std::string restCurvaturePart(Dice& dice, const Draft& draft) {
  if (dice.chance(0.7)) return "";
  return "rest_curvature: " + vectorOf(dice, 1.0 / draft.length, "1/m") + "\n";
}

inline std::string loadsPart(Dice& dice, const Draft& draft) {
  if (draft.isKinematic()) return "";
  const double force = draft.stiffness() / (draft.length * draft.length);
  std::string text;
  if (dice.chance(0.2)) text += "tip_force: " + vectorOf(dice, force, "N") + "\n";
  if (dice.chance(0.2)) text += "line_force: " + vectorOf(dice, force / draft.length, "N/m") + "\n";
  if (dice.chance(0.2)) text += "tip_couple: " + vectorOf(dice, 0.5 * force * draft.length, "N.m") + "\n";
  return text;
}

inline std::string surroundingsPart(Dice& dice, const Draft& draft) {
  if (draft.isKinematic()) return "";
  const double stiffness = draft.stiffness() / std::pow(draft.length, 3);
  std::string text;
  if (dice.chance(0.15)) {
    text += "springs: [{label: " + si(dice.between(0.1, 1.0), "") + ", anchor: " + vectorOf(dice, draft.length, "m") +
            ", stiffness: " + si(stiffness * dice.logBetween(0.1, 30.0), "N/m") + "}]\n";
  }
  if (dice.chance(0.15)) {
    const bool is_rigid = draft.isStatic() && dice.chance(0.5);
    text += "walls: [{point: [0 m, 0 m, " + si(draft.base_height - draft.length * dice.between(0.0, 0.5), "m") +
            "], normal: [0, 0, 1], stiffness: " +
            (is_rigid ? "rigid" : si(stiffness * dice.logBetween(1.0, 100.0), "N/m")) + "}]\n";
  }
  return text;
}

using OrganPart = std::string (*)(Dice&, const Draft&);

/// Every mechanism of an organ: a new one goes in here.
inline const std::vector<OrganPart>& organParts() {
  static const std::vector<OrganPart> parts = {growthPart,   sensesPart,       proprioceptionPart,
                                               divisionPart, sourcePart,       restCurvaturePart,
                                               loadsPart,    surroundingsPart, circumnutationPart};
  return parts;
}

inline std::string organText(Dice& dice, Draft& draft, int index) {
  draft.radius = dice.logBetween(1e-4, 1e-2);
  draft.length = draft.radius * (draft.isInTime() ? dice.between(5.0, 10.0) : dice.logBetween(5.0, 200.0));
  draft.elements = draft.isInTime() ? dice.count(2, 4) : dice.count(2, 20);
  draft.young_modulus = dice.logBetween(1e5, 1e9);
  draft.base_height = dice.between(-0.1, 0.1);
  const std::string support = draft.isKinematic() || dice.chance(0.7) ? "clamped" : "frozen_first_element";
  std::string text = "  - id: organ_" + std::to_string(index) + "\n";
  const auto add = [&text](const std::string& lines) {
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);) text += "    " + line + "\n";
  };
  add("base: {position: [" + si(dice.between(-0.1, 0.1), "m") + ", " + si(dice.between(-0.1, 0.1), "m") + ", " +
      si(draft.base_height, "m") + "], direction: " + directionOf(dice) + ", support: " + support + "}");
  add("length: " + si(draft.length, "m"));
  add("elements: " + std::to_string(draft.elements));
  add("radius: " + si(draft.radius, "m"));
  const bool is_inextensible = !draft.isInTime() && dice.chance(0.2);
  add("material: {young_modulus: " + si(draft.young_modulus, "Pa") + ", poisson_ratio: 0.5, density: " +
      si(kTissueDensity, "kg/m^3") + ", inextensible: " + (is_inextensible ? "true" : "false") + "}");
  for (const OrganPart part : organParts()) add(part(dice, draft));
  return text;
}

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
