#pragma once

/// What the tests of scenario files share: files, a text without fault, and the problems of others.

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::support {

using rod::Vector3;
using simulation::parseScenario;
using simulation::Problem;
using simulation::ScenarioError;

inline const std::string good = "data/scenarios/good/";
inline const std::string bad = "data/scenarios/bad/";
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline std::string contentOf(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<Problem> problemsOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const ScenarioError& error) {
    return error.problems();
  }
  return {};
}

inline std::vector<Problem> problemsOf(const std::string& yaml) {
  return problemsOf([&] { parseScenario(yaml, "test"); });
}

inline std::string list(const std::vector<Problem>& problems) {
  return problems.empty() ? "no problem" : ScenarioError("test", problems).what();
}

inline void expectNear(const Vector3& actual, const Vector3& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-14 * std::max(1.0, expected.norm()))
      << actual.transpose() << " instead of " << expected.transpose();
}

/// A scenario without fault; each test below spoils a piece of it.
inline const std::string valid = R"(name: one_organ
gravity: {direction: [0, 0, -1], acceleration: 9.81 m/s^2}
weight: true
duration: 8 h
stepping:
  step: 1 min
  limits: {bend_angle: 0.02 rad}
relaxation: {method: static, max_iterations: 100}
organs:
  - id: first
    base: {position: [0 mm, 0 mm, 0 mm], direction: [0, 0, 1], roll: 0 deg}
    length: 30 mm
    elements: 60
    radius: 0.8 mm
    material: {young_modulus: 10 MPa, poisson_ratio: 0.5, density: 1000 kg/m^3}
    growth: {profile: apical_flat, rate: 0.05 1/h, zone_length: 10 mm}
    sensitivities: {gravity: 0.1, light_direction: 0.3, point_source: 0.3, softening_length: 1 mm, distance: {law: gaussian, length: 5 cm}}
    circumnutation: {form: oscillator, amplitude: 0.1, period: 2 h, phase: 0 rad}
    proprioception: {intrinsic_length: 0.06 mm, set_point: [0 1/m, 1 1/m]}
    division: {longest_element: 1 mm, mode: keep_strain}
    tip_force: [0 N, 0 N, 0 N]
    line_force: [0 N/m, 0 N/m, 0 N/m]
    tip_couple: [0 N m, 0 N m, 0 N m]
    springs:
      - {label: 0.5, anchor: [5 mm, 0 m, 15 mm], stiffness: 2 N/m}
    walls:
      - {point: [0 m, 0 m, -1 cm], normal: [0, 0, 1], stiffness: rigid}
    held_apex: {position: [0 m, 0 m, 29 mm], direction: [0, 0, 1], roll: 10 deg}
    source: {label: 0.25, strength: 2}
stimuli:
  point_sources:
    - {id: lamp, position: [10 cm, 0 m, 10 cm], strength: 1}
  light_directions:
    - {id: sun, towards: [1, 0, 0], strength: 1}
protocol:
  - {at: 2 h, change: {light_direction: {id: sun, towards: [0, 1, 0], strength: 1}}}
  - {at: 3 h, remove: {point_source: {id: lamp}}}
  - {at: 4 h, set: {parameter: {organ: first, name: growth.rate, value: 2 %/h}}}
  - {at: 4 h, set: {gravity: {direction: [1, 0, 1], acceleration: 3 m/s^2}}}
)";

/// The valid scenario with each first piece replaced by the second.
inline std::string changed(const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string yaml = valid;
  for (const auto& [piece, replacement] : changes) yaml.replace(yaml.find(piece), piece.size(), replacement);
  return yaml;
}

}  // namespace sensory_growth::support
