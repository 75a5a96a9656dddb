#pragma once

/// Valid organs at random, as text. Each mechanism is one function in organParts() below.

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "support/dice.h"

namespace sensory_growth::support {

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
  bool is_inextensible;
  bool nutates;  ///< by an oscillator

  bool isStatic() const { return method == "static"; }
  bool isKinematic() const { return method == "kinematic"; }
  bool isInTime() const { return method == "dynamic" || method == "continuous"; }

  /// Bending stiffness [N m^2].
  double stiffness() const { return young_modulus * M_PI * std::pow(radius, 4) / 4.0; }

  /// Rate that gives this growth strain in the whole run [1/s].
  double rate(double strain) const { return strain / (steps * step); }
};

constexpr double kTissueDensity = 1000.0;  ///< [kg/m^3]

inline std::string sensitivityOf(Dice& dice) {
  return si(dice.chance(0.3) ? 0.0 : dice.pick<double>({-1.0, 1.0}) * dice.logBetween(1e-3, 3.0), "");
}

// The parts of an organ: each returns lines of YAML, or nothing.

inline std::string stressCoupling(Dice& dice, const Draft& draft) {
  if (draft.isKinematic() || draft.is_inextensible || dice.chance(0.6)) return "";
  return ", stress_coupling: {yield_margin: " + si(draft.young_modulus * dice.logBetween(1e-2, 1.0), "Pa") +
         ", largest_factor: " + dice.pick<std::string>({"inf", "1", "1.5"}) +
         ", lockhart_sign: " + dice.pick<std::string>({"1", "1", "-1"}) + "}";
}

inline std::string growthPart(Dice& dice, const Draft& draft) {
  const double fastest = draft.rate(dice.chance(0.1) ? 0.0 : dice.logBetween(0.01, 2.0));
  const std::string rate = ", rate: " + si(fastest, "1/s");
  const std::string zone = ", zone_length: " + si(draft.length * dice.logBetween(0.05, 3.0), "m");
  const std::vector<double> distances = rising(dice, 0.0, 0.5 * draft.length);
  const std::string profile =
      dice.pick<std::string>({"uniform" + rate, "apical_flat" + rate + zone, "apical_gaussian" + rate + zone,
                              "logistic" + rate + zone + ", steepness: " + si(dice.logBetween(1.0, 100.0), ""),
                              "sampled, distances: " + list(distances, "m") +
                                  ", rates: " + list(numbers(dice, distances.size(), 0.0, fastest), "1/s")});
  return "growth: {profile: " + profile + ", elongation: " + dice.pick<std::string>({"true", "true", "false"}) +
         ", twist_transport: " + dice.pick<std::string>({"angle", "rate"}) + stressCoupling(dice, draft) + "}\n";
}

inline std::string agingPart(Dice& dice, const Draft& draft) {
  if (dice.chance(0.6)) return "";
  const auto time = [&] { return ", time: " + si(draft.steps * draft.step * dice.logBetween(0.03, 3.0), "s") + "}"; };
  const double largest = draft.isInTime() ? 2.0 : 20.0;  // stiff tissue in motion takes short steps
  const std::string stiffening =
      ", stiffening: {mature_modulus: " + si(draft.young_modulus * dice.logBetween(0.5, largest), "Pa") + time();
  const std::string thickening =
      ", thickening: {mature_radius: " + si(draft.radius * dice.logBetween(0.8, 2.0), "m") + time();
  const std::string clock = "aging: {clock: " + dice.pick<std::string>({"maturation", "time"});
  if (draft.isKinematic()) return clock + thickening + "}\n";
  return clock + dice.pick<std::string>({stiffening, thickening, stiffening + thickening}) + "}\n";
}

inline std::string distanceLaw(Dice& dice, const Draft& draft) {
  const std::string length = ", length: " + si(draft.length * dice.logBetween(0.1, 10.0), "m");
  const std::vector<double> distances = rising(dice, 0.0, draft.length);
  const std::string samples =
      ", distances: " + list(distances, "m") + ", factors: " + list(numbers(dice, distances.size(), -1.0, 1.0), "");
  return dice.pick<std::string>({"constant", "constant", "inverse_power" + length + ", exponent: 2",
                                 "exponential" + length, "gaussian" + length, "sampled" + samples});
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
  if (draft.nutates) {
    return "circumnutation: {form: oscillator, amplitude: " + si(dice.logBetween(0.01, 1.0), "") + period +
           ", phase: " + si(dice.between(0.0, 6.0), "rad") +
           ", phase_gradient: " + si(dice.between(-3.0, 3.0) / draft.length, "rad/m") + "}\n";
  }
  if (dice.chance(0.8)) return "";
  return "circumnutation: {form: rotation" + period + ", gate: " + si(dice.between(0.0, 0.9), "") + "}\n";
}

inline std::string sensorText(Dice& dice, const Draft& draft) {
  const std::string distance = ", distance: " + si(draft.length * dice.between(0.0, 1.5), "m");
  return dice.pick<std::string>({"apex", "distance_from_apex" + distance, "distance_from_base" + distance,
                                 "label, label: " + si(dice.between(0.0, 1.0), "")});
}

inline std::string memoryText(Dice& dice, const Draft& draft) {
  const auto time = [&] { return si(draft.step * dice.logBetween(0.5, 50.0), "s"); };
  const std::vector<double> times = rising(dice, draft.step * dice.pick<double>({0.0, 3.0}), 30.0 * draft.step, 2);
  const double density = 1.0 / (times.back() - times.front());
  const std::string kernel = dice.pick<std::string>(
      {"delay, delay: " + time(), "exponential, time_constant: " + time(),
       "linear_ode, delay: " + dice.pick<std::string>({"0 s", time()}) + ", time_constant: " + time() +
           ", coefficients: " + dice.pick<std::string>({"[1]", "[2, 1]", "[0.8, 1]", "[3, 3, 1]"}),
       "sampled, times: " + list(times, "s") +
           ", densities: " + list(numbers(dice, times.size(), -density, 2.0 * density), "1/s")});
  return ", memory: {kernel: " + kernel + ", before_start: " + dice.pick<std::string>({"constant", "zero"}) + "}";
}

inline std::string spreadText(Dice& dice, const Draft& draft) {
  const std::string length = si(draft.length * dice.logBetween(0.01, 3.0), "m");
  const std::string direction = dice.pick<std::string>({"basipetal", "acropetal", "both"});
  const auto row = [&] { return list(numbers(dice, 3, -2.0 / draft.length, 2.0 / draft.length), "1/m"); };
  return ", spread: {kernel: " +
         dice.pick<std::string>(
             {"exponential, direction: " + direction + ", length: " + length,
              "sampled, labels: [0, 0.3, 1], densities: [" + row() + ", " + row() + ", " + row() + "]"}) +
         "}";
}

inline std::string receiversText(Dice& dice, const Draft& draft) {
  const std::vector<double> distances = rising(dice, 0.0, draft.length);
  const std::vector<double> labels = rising(dice, 0.1, 0.3);
  const auto weights = [&](std::size_t count) { return ", weights: " + list(numbers(dice, count, -1.0, 1.0), ""); };
  return ", receivers: {coordinate: " +
         dice.pick<std::string>({"distance_from_apex, distances: " + list(distances, "m") + weights(distances.size()),
                                 "distance_from_base, distances: " + list(distances, "m") + weights(distances.size()),
                                 "label, labels: " + list(labels, "") + weights(labels.size())}) +
         "}";
}

inline std::string routeText(Dice& dice, const Draft& draft) {
  std::string cues;
  for (const char* cue : {"gravity", "light_direction", "point_source", "oscillator"}) {
    const bool is_sensed = cue != std::string("oscillator") || draft.nutates;
    if (is_sensed && dice.chance(0.4)) cues += (cues.empty() ? "" : ", ") + std::string(cue);
  }
  const bool is_local = dice.chance(0.5);
  return "  - {cues: [" + (cues.empty() ? "gravity" : cues) +
         "], sensor: {at: " + (is_local ? "local" : sensorText(dice, draft)) + "}" +
         (dice.chance(0.3) ? "" : memoryText(dice, draft)) +
         (is_local && dice.chance(0.6) ? spreadText(dice, draft) : "") +
         (dice.chance(0.5) ? "" : receiversText(dice, draft)) + "}\n";
}

inline std::string sensingPart(Dice& dice, const Draft& draft) {
  if (dice.chance(0.5)) return "";
  std::string text = "sensing:\n";
  for (int i = dice.count(1, 3); i > 0; --i) text += routeText(dice, draft);
  return text;
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
  static const std::vector<OrganPart> parts = {
      growthPart,   agingPart,  sensesPart,        circumnutationPart, sensingPart,     proprioceptionPart,
      divisionPart, sourcePart, restCurvaturePart, loadsPart,          surroundingsPart};
  return parts;
}

inline std::string organText(Dice& dice, Draft& draft, int index) {
  draft.radius = dice.logBetween(1e-4, 1e-2);
  draft.length = draft.radius * (draft.isInTime() ? dice.between(5.0, 10.0) : dice.logBetween(5.0, 200.0));
  draft.elements = draft.isInTime() ? dice.count(2, 4) : dice.count(2, 20);
  draft.young_modulus = dice.logBetween(1e5, 1e9);
  draft.base_height = dice.between(-0.1, 0.1);
  draft.is_inextensible = !draft.isInTime() && dice.chance(0.2);
  draft.nutates = dice.chance(0.3);
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
  add("material: {young_modulus: " + si(draft.young_modulus, "Pa") + ", poisson_ratio: 0.5, density: " +
      si(kTissueDensity, "kg/m^3") + ", inextensible: " + (draft.is_inextensible ? "true" : "false") + "}");
  for (const OrganPart part : organParts()) add(part(dice, draft));
  return text;
}

}  // namespace sensory_growth::support
