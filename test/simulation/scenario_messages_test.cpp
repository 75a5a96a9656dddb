// What is wrong with a scenario is said with its key, its line, the value and what is allowed.

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using support::bad;
using support::list;
using support::problemsOf;
using support::valid;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST(ScenarioYaml, TheUnspoiltScenarioIsValid) { EXPECT_EQ(list(problemsOf(valid)), "no problem"); }

/// `piece` of the valid scenario is replaced; one problem is expected, on the line of the piece.
struct Spoilt {
  const char* piece;
  const char* replacement;
  const char* key;
  const char* message;
};

void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.replacement; }

class SpoiltScenario : public testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltScenario, IsRefusedWithKeyLineAndReason) {
  const Spoilt& spoilt = GetParam();
  const std::string piece = spoilt.piece;
  const std::size_t at = valid.find(piece);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(valid.find(piece, at + 1), std::string::npos) << "the piece is not unique";
  const std::vector<Problem> problems = problemsOf(std::string(valid).replace(at, piece.size(), spoilt.replacement));
  ASSERT_EQ(problems.size(), 1u) << list(problems);
  EXPECT_EQ(problems[0].key, spoilt.key);
  EXPECT_EQ(problems[0].line, 1 + std::count(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  EXPECT_THAT(problems[0].message, ContainsRegex(spoilt.message));
}

INSTANTIATE_TEST_SUITE_P(
    Units, SpoiltScenario,
    testing::Values(
        Spoilt{"radius: 0.8 mm", "radius: 0.8", "organs[0].radius",
               "^'0.8' has no unit; give a length such as '0.8 mm'$"},
        Spoilt{"radius: 0.8 mm", "radius: 0.8 s", "organs[0].radius", "^'0.8 s' is a time; give a length such as"},
        Spoilt{"radius: 0.8 mm", "radius: 0.8 mmm", "organs[0].radius", "unknown unit 'mmm'"},
        Spoilt{"radius: 0.8 mm", "radius: 1,5 mm", "organs[0].radius", "^'1,5 mm' does not begin with a finite number"},
        Spoilt{"radius: 0.8 mm", "radius: 0x10 m", "organs[0].radius", "^'0x10 m' does not begin with"},
        Spoilt{"radius: 0.8 mm", "radius: 1 2 mm", "organs[0].radius", "unknown unit '2 mm'"},
        Spoilt{"radius: 0.8 mm", "radius: .nan", "organs[0].radius", "does not begin with a finite number"},
        Spoilt{"radius: 0.8 mm", "radius: inf", "organs[0].radius", "does not begin with a finite number"},
        Spoilt{"rate: 0.05 1/h", "rate: 20 h", "organs[0].growth.rate", "^'20 h' is a time; give a rate"},
        Spoilt{"gravity: 0.1", "gravity: 0.1 mm", "organs[0].sensitivities.gravity", "not a number without a unit"},
        Spoilt{"gravity: 0.1", "gravity: nan", "organs[0].sensitivities.gravity", "not a finite number"},
        Spoilt{"gravity: 0.1", "gravity: inf", "organs[0].sensitivities.gravity", "not a finite number"},
        Spoilt{"9.81 m/s^2", "9.81 m/s", "gravity.acceleration", "in units of m.s-1; give an acceleration"},
        Spoilt{"bend_angle: 0.02 rad", "bend_angle: 2 %", "stepping.limits.bend_angle", "give an angle"},
        Spoilt{"[0 N, 0 N, 0 N]", "[0 N, 0, 0 N]", "organs[0].tip_force[1]", "^'0' has no unit; give a force"}));

INSTANTIATE_TEST_SUITE_P(
    Loads, SpoiltScenario,
    testing::Values(
        Spoilt{"roll: 0 deg", "support: pinned", "organs[0].base.support",
               "^'pinned' is not known; give 'clamped', 'frozen_first_element' or 'hinged'$"},
        Spoilt{"[0 N/m, 0 N/m, 0 N/m]", "[0 N/m, 0 N, 0 N/m]", "organs[0].line_force[1]",
               "^'0 N' is a force; give a force per length such as '5 mN/m'$"},
        Spoilt{"[0 N m, 0 N m, 0 N m]", "[0 N m, 0 N/m, 0 N m]", "organs[0].tip_couple[1]",
               "^'0 N/m' is a force per length; give a couple such as '3 uN.m'$"},
        Spoilt{"[0 N m, 0 N m, 0 N m]", "3 N m", "organs[0].tip_couple", "^is '3 N m'; give a sequence of three"},
        Spoilt{"label: 0.5", "labl: 0.5, label: 0.5", "organs[0].springs[0].labl", "did you mean 'label'\\?$"},
        Spoilt{"label: 0.5, ", "", "organs[0].springs[0].label", "^is missing; give a number without a unit$"},
        Spoilt{"label: 0.5", "label: 0", "organs[0].springs[0].label", "^'0' is out of range; must be > 0 and <= 1$"},
        Spoilt{"label: 0.5", "label: 1.1", "organs[0].springs[0].label", "must be > 0 and <= 1$"},
        Spoilt{"stiffness: 2 N/m", "stiffness: 0 N/m", "organs[0].springs[0].stiffness", "must be > 0 N/m$"},
        Spoilt{"stiffness: 2 N/m", "stiffness: rigid", "organs[0].springs[0].stiffness",
               "^'rigid' does not begin with .* a stiffness such as '20 N/m'$"},
        Spoilt{"anchor: [5 mm, 0 m, 15 mm], ", "", "organs[0].springs[0].anchor", "^is missing; give a sequence of"},
        Spoilt{"stiffness: rigid", "stiffness: stiff", "organs[0].walls[0].stiffness",
               "^'stiff' is not known; give a stiffness such as '20 N/m' or 'rigid'$"},
        Spoilt{"stiffness: rigid", "stiffness: inf", "organs[0].walls[0].stiffness", "^'inf' is not known; give a sti"},
        Spoilt{"stiffness: rigid", "stiffness: -1 N/m", "organs[0].walls[0].stiffness", "must be > 0 N/m or rigid$"},
        Spoilt{", stiffness: rigid", "", "organs[0].walls[0].stiffness", "^is missing; give .* or 'rigid'$"},
        Spoilt{"normal: [0, 0, 1]", "normal: [0, 0, 0]", "organs[0].walls[0].normal", "zero length"},
        Spoilt{"normal: [0, 0, 1]", "normal: [0, 0, -1]", "organs[0].walls[0].normal", "^points away from the base"},
        Spoilt{"[0 m, 0 m, 29 mm], direction: [0, 0, 1], ", "[0 m, 0 m, 29 mm], ", "organs[0].held_apex.roll",
               "^needs 'direction'"},
        Spoilt{"held_apex: {position: [0 m, 0 m, 29 mm],", "held_apex: {", "organs[0].held_apex.position",
               "^is missing; give a sequence of three"},
        Spoilt{"held_apex: {position: [0 m, 0 m, 29 mm], direction: [0, 0, 1], roll: 10 deg}", "held_apex: true",
               "organs[0].held_apex", "^is 'true'; give a mapping"}));

INSTANTIATE_TEST_SUITE_P(
    Senses, SpoiltScenario,
    testing::Values(
        Spoilt{"law: gaussian", "law: linear", "organs[0].sensitivities.distance.law",
               "^'linear' is not known; give 'constant', 'inverse_power', 'exponential', 'gaussian' or 'sampled'$"},
        Spoilt{"law: gaussian, length: 5 cm", "law: gaussian", "organs[0].sensitivities.distance.length",
               "^is missing; give a length"},
        Spoilt{"law: gaussian, length: 5 cm", "law: constant, length: 5 cm", "organs[0].sensitivities.distance.length",
               "^is an unknown key; known here are 'law'$"},
        Spoilt{"law: gaussian, length: 5 cm", "law: inverse_power, length: 5 cm, exponent: -1",
               "organs[0].sensitivities.distance.exponent", "must be >= 0$"},
        Spoilt{"softening_length: 1 mm, distance: {law: gaussian, length: 5 cm}",
               "softening_length: 0 mm, distance: {law: inverse_power, length: 5 cm, exponent: 2}",
               "organs[0].sensitivities.distance", "^the pull grows inf times .*; give a longer softening_length$"},
        Spoilt{"softening_length: 1 mm, distance: {law: gaussian, length: 5 cm}",
               "softening_length: 1 um, distance: {law: inverse_power, length: 5 cm, exponent: 2}",
               "organs[0].sensitivities.distance", "^the pull grows 2.5e\\+09 times"},
        Spoilt{"law: gaussian, length: 5 cm", "law: sampled, distances: [0 m, 1 m], factors: [1]",
               "organs[0].sensitivities.distance", "^the distance law has 2 distances and 1 factors; give as many"},
        Spoilt{"law: gaussian, length: 5 cm", "law: sampled, distances: [1 m, 1 m], factors: [1, 2]",
               "organs[0].sensitivities.distance", "^distances of the distance law must increase$"},
        Spoilt{"law: gaussian, length: 5 cm", "law: sampled, distances: [0 m, 1], factors: [1, 2]",
               "organs[0].sensitivities.distance.distances[1]", "^'1' has no unit; give a length"},
        Spoilt{"law: gaussian, length: 5 cm", "law: sampled, distances: [0 m], factors: [1 m]",
               "organs[0].sensitivities.distance.factors[0]", "^'1 m' is not a number without a unit"},
        Spoilt{"law: gaussian, length: 5 cm", "law: sampled, distances: [0 m], factors: 1",
               "organs[0].sensitivities.distance.factors", "^is '1'; give a sequence, each a number without a unit$"},
        Spoilt{"softening_length: 1 mm", "softening_length: 1 mm, intensity_exponent: 0",
               "organs[0].sensitivities.intensity_exponent", "must be > 0 and <= 10$"},
        Spoilt{"form: oscillator", "form: spiral", "organs[0].circumnutation.form",
               "^'spiral' is not known; give 'oscillator' or 'rotation'$"},
        Spoilt{"amplitude: 0.1", "amplitude: -0.1", "organs[0].circumnutation.amplitude", "must be >= 0$"},
        Spoilt{"amplitude: 0.1, ", "", "organs[0].circumnutation.amplitude", "^is missing"},
        Spoilt{"period: 2 h", "period: 0 h", "organs[0].circumnutation.period", "^'0 h' is no period; must not be 0 s"},
        Spoilt{"phase: 0 rad", "phase_gradient: 1 rad", "organs[0].circumnutation.phase_gradient",
               "^'1 rad' is an angle; give an angle per length such as '10 deg/cm'$"},
        Spoilt{"oscillator, amplitude: 0.1, period: 2 h, phase: 0 rad", "rotation, period: 2 h, gate: 1",
               "organs[0].circumnutation.gate", "must be >= 0 and < 1$"},
        Spoilt{"{intrinsic_length: 0.06 mm, set_point: [0 1/m, 1 1/m]}", "{}",
               "organs[0].proprioception.intrinsic_length",
               "^is missing; give it, 'actual_length' or 'relaxation_length"},
        Spoilt{"[0 1/m, 1 1/m]", "[0 1/m, 1 1/m, 0 1/m]", "organs[0].proprioception.set_point",
               "^has 3 components; give two, about d1 and d2$"},
        Spoilt{"[0 1/m, 1 1/m]", "[0 1/m, 1 m]", "organs[0].proprioception.set_point[1]", "give a curvature"},
        Spoilt{"zone_length: 10 mm", "zone_length: 10 mm, twist_transport: both", "organs[0].growth.twist_transport",
               "^'both' is not known; give 'angle' or 'rate'$"}));

INSTANTIATE_TEST_SUITE_P(
    Ranges, SpoiltScenario,
    testing::Values(
        Spoilt{"radius: 0.8 mm", "radius: -0.8 mm", "organs[0].radius", "^'-0.8 mm' is out of range; must be > 0 m$"},
        Spoilt{"radius: 0.8 mm", "radius: 0 mm", "organs[0].radius", "must be > 0 m$"},
        Spoilt{"length: 30 mm", "length: 0 mm", "organs[0].length", "must be > 0 m$"},
        Spoilt{"elements: 60", "elements: 0", "organs[0].elements",
               "^'0' is out of range; must be >= 1 and <= 100000$"},
        Spoilt{"elements: 60", "elements: 99999999999", "organs[0].elements", "out of range"},
        Spoilt{"elements: 60", "elements: 60.0", "organs[0].elements", "^'60.0' is not a whole number$"},
        Spoilt{"elements: 60", "elements: many", "organs[0].elements", "^'many' is not a whole number$"},
        Spoilt{"10 MPa", "0 MPa", "organs[0].material.young_modulus", "must be > 0 Pa$"},
        Spoilt{"1000 kg/m^3", "-1 kg/m^3", "organs[0].material.density", "must be > 0 kg/m\\^3$"},
        Spoilt{"poisson_ratio: 0.5", "poisson_ratio: 0.6", "organs[0].material.poisson_ratio",
               "must be > -1 and <= 0.5$"},
        Spoilt{"poisson_ratio: 0.5", "poisson_ratio: -1", "organs[0].material.poisson_ratio", "must be > -1 and"},
        Spoilt{"rate: 0.05 1/h", "rate: -1 1/h", "organs[0].growth.rate", "must be >= 0 1/s$"},
        Spoilt{"zone_length: 10 mm", "zone_length: 0 mm", "organs[0].growth.zone_length", "must be > 0 m$"},
        Spoilt{"softening_length: 1 mm", "softening_length: -1 mm", "organs[0].sensitivities.softening_length",
               "must be >= 0 m$"},
        Spoilt{"0.06 mm", "-1 mm", "organs[0].proprioception.intrinsic_length", "must be >= 0 m$"},
        Spoilt{"longest_element: 1 mm", "longest_element: 0 mm", "organs[0].division.longest_element",
               "must be > 0 m or inf$"},
        Spoilt{"longest_element: 1 mm", "longest_element: 1 nm", "organs[0].division.longest_element",
               "more than 100000 elements"},
        Spoilt{"step: 1 min", "step: 0 s", "stepping.step", "must be > 0 s$"},
        Spoilt{"bend_angle: 0.02 rad", "bend_angle: 0 rad", "stepping.limits.bend_angle", "must be > 0 rad or inf$"},
        Spoilt{"bend_angle: 0.02 rad", "smallest_part: 2", "stepping.limits.smallest_part", "must be > 0 and <= 1$"},
        Spoilt{"max_iterations: 100", "max_iterations: 0", "relaxation.max_iterations", "must be >= 1 and <= 1000000$"},
        Spoilt{"max_iterations: 100", "tolerance: 1", "relaxation.tolerance", "must be > 0 and < 1$"},
        Spoilt{"max_iterations: 100", "max_bend_angle: 180 deg", "relaxation.max_bend_angle", "> 0 rad and < 3.14159"},
        Spoilt{"duration: 8 h", "duration: -8 h", "duration", "must be >= 0 s$"},
        Spoilt{"at: 2 h", "at: -2 h", "protocol[0].at", "must be >= 0 s$"},
        Spoilt{"9.81 m/s^2", "-9.81 m/s^2", "gravity.acceleration", "must be >= 0 m/s\\^2$"},
        Spoilt{"direction: [0, 0, -1]", "direction: [0, 0, 0.0]", "gravity.direction", "zero length"},
        Spoilt{"direction: [0, 0, 1], roll: 0 deg", "direction: [0, 0, -0]", "organs[0].base.direction", "zero length"},
        Spoilt{"towards: [1, 0, 0]", "towards: [0, 0, 0]", "stimuli.light_directions[0].towards", "zero length"},
        Spoilt{"towards: [0, 1, 0]", "towards: [0, inf, 0]", "protocol[0].change.light_direction.towards[1]",
               "not a finite number"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, SpoiltScenario,
    testing::Values(
        Spoilt{"duration:", "durtion:", "durtion", "^is an unknown key; did you mean 'duration'\\?$"},
        Spoilt{"tip_force:", "tip_froce:", "organs[0].tip_froce", "did you mean 'tip_force'\\?$"},
        Spoilt{"tip_force:", "colour: green\n    tip_force:", "organs[0].colour",
               "^is an unknown key; known here are 'id', 'base', .* and 'rest_curvature'$"},
        Spoilt{"zone_length: 10 mm", "zone_length: 10 mm, steepness: 15", "organs[0].growth.steepness",
               "^is an unknown key; known here are 'elongation', 'twist_transport', 'stress_coupling', 'profile', "
               "'rate' and "
               "'zone_length'$"},
        Spoilt{"roll: 0 deg", "roll: 0 deg, roll: 1 deg", "organs[0].base.roll", "^is given twice, first on line 11$"},
        Spoilt{"name: one_organ", "description: nameless", "name", "^is missing; give a letter followed by"},
        Spoilt{"duration: 8 h", "? [a, b]\n: 8 h", "", "has a key that is a sequence; keys are plain words"}));

INSTANTIATE_TEST_SUITE_P(
    MissingKeys, SpoiltScenario,
    testing::Values(
        Spoilt{"direction: [0, 0, -1], acc", "acc", "gravity.direction", "^is missing; give a sequence of three"},
        Spoilt{", acceleration: 9.81 m/s^2", "", "gravity.acceleration", "^is missing; give an acceleration"},
        Spoilt{"young_modulus: 10 MPa, ", "", "organs[0].material.young_modulus",
               "^is missing; give an elastic modulus"},
        Spoilt{", density: 1000 kg/m^3", "", "organs[0].material.density", "^is missing"},
        Spoilt{"poisson_ratio: 0.5, ", "", "organs[0].material", "needs exactly one of 'poisson_ratio' and 'shear_mod"},
        Spoilt{"profile: apical_flat, ", "", "organs[0].growth.profile",
               "^is missing; give 'logistic', 'uniform', 'apical_flat', 'apical_gaussian' or"},
        Spoilt{", zone_length: 10 mm", "", "organs[0].growth.zone_length", "^is missing; give a length"},
        Spoilt{"gravity: 0.1, ", "", "organs[0].sensitivities.gravity", "^is missing; give a number without a unit$"},
        Spoilt{"softening_length: 1 mm, ", "", "organs[0].sensitivities.softening_length", "^is missing"},
        Spoilt{"longest_element: 1 mm, ", "", "organs[0].division.longest_element", "^is missing"},
        Spoilt{"  step: 1 min\n  limits", "  limits", "stepping.step", "^is missing; give a time such as '10 min'$"},
        Spoilt{"{id: lamp, pos", "{pos", "stimuli.point_sources[0].id", "^is missing"},
        Spoilt{"[10 cm, 0 m, 10 cm], strength: 1", "[10 cm, 0 m, 10 cm]", "stimuli.point_sources[0].strength",
               "^is missing"},
        Spoilt{"at: 2 h, ", "", "protocol[0].at", "^is missing; give a time"},
        Spoilt{", remove: {point_source: {id: lamp}}", "", "protocol[1]",
               "^needs exactly one of 'add', 'change', 'remove' and 'set'$"}));

INSTANTIATE_TEST_SUITE_P(
    Types, SpoiltScenario,
    testing::Values(
        Spoilt{"weight: true", "weight: yes", "weight", "^'yes' is not a truth value; give true or false$"},
        Spoilt{"weight: true", "weight:", "weight", "^is empty; give true or false$"},
        Spoilt{"weight: true", "weight: [true]", "weight", "^is a sequence; give true or false$"},
        Spoilt{"{method: static, max_iterations: 100}", "static", "relaxation", "^is 'static'; give a mapping of keys"},
        Spoilt{"{method: static, max_iterations: 100}", "[static]", "relaxation", "^is a sequence; give a mapping"},
        Spoilt{"{method: static, max_iterations: 100}", "", "relaxation", "^is empty; give a mapping"},
        Spoilt{"method: static", "method: elastic", "relaxation.method",
               "^'elastic' is not known; give 'static', 'dynamic', 'continuous' or 'kinematic'$"},
        Spoilt{"profile: apical_flat", "profile: apical", "organs[0].growth.profile",
               "give 'logistic', 'uniform', 'apical_flat', 'apical_gaussian' or"},
        Spoilt{"mode: keep_strain", "mode: keep", "organs[0].division.mode", "'keep_strain' or 'keep_positions'$"},
        Spoilt{"[0 mm, 0 mm, 0 mm]", "[0 mm, 0 mm]", "organs[0].base.position", "^has 2 components; give a sequence"},
        Spoilt{"[0 mm, 0 mm, 0 mm]", "0 mm", "organs[0].base.position",
               "^is '0 mm'; give a sequence of three, each a l"},
        Spoilt{"[0 mm, 0 mm, 0 mm]", "[0 mm, [0 mm], 0 mm]", "organs[0].base.position[1]",
               "^is a sequence; give a len"},
        Spoilt{"radius: 0.8 mm", "radius: {value: 0.8 mm}", "organs[0].radius", "^is a mapping; give a length"},
        Spoilt{"name: one_organ", "name: one organ", "name", "^'one organ' is not a valid name"},
        Spoilt{"name: one_organ", "name: ''", "name", "^'' is not a valid name"},
        Spoilt{"- id: first", "- id: 1st", "organs[0].id", "^'1st' is not a valid name; give a letter"},
        Spoilt{"{id: lamp, pos", "{id: lamp/a, pos", "stimuli.point_sources[0].id", "not a valid name"}));

INSTANTIATE_TEST_SUITE_P(
    Meaning, SpoiltScenario,
    testing::Values(
        Spoilt{"poisson_ratio: 0.5", "poisson_ratio: 0.5, shear_modulus: 3 MPa", "organs[0].material",
               "^needs exactly one of 'poisson_ratio' and 'shear_modulus'$"},
        Spoilt{"at: 3 h", "at: 1 h", "protocol[1].at", "^'1 h' is earlier than the entry before it, on line 36;"},
        Spoilt{"remove: {point_source: {id: lamp}}", "add: {}, remove: {}", "protocol[1]", "needs exactly one of"},
        Spoilt{"remove: {point_source: {id: lamp}}", "remove: {}", "protocol[1].remove",
               "^needs exactly one of 'point_source' and 'light_direction'$"},
        Spoilt{"remove: {point_source: {id: lamp}}", "remove: {point_source: {id: lamp, strength: 1}}",
               "protocol[1].remove.point_source.strength", "unknown key; known here are 'id'$"},
        Spoilt{"remove: {point_source: {id: lamp}}", "remove: {light_direction: {id: lamp}}", "protocol[1].remove",
               "no light_direction 'lamp'"},
        Spoilt{"change: {light_direction: {id: sun,", "change: {light_direction: {id: moon,", "protocol[0].change",
               "no light_direction 'moon'"},
        Spoilt{"organ: first", "organ: last", "protocol[2].set", "^there is no organ 'last'; give its id, or 'all'$"},
        Spoilt{"- id: first", "- id: all", "organs[0].id", "^'all' means every organ in commands; give another id$"},
        Spoilt{"{organ: first, name: growth.rate, value: 2 %/h}", "{organ: first, name: source.strength, value: 2 m}",
               "protocol[2].set.parameter.value", "'2 m' is not a number without a unit"},
        Spoilt{"value: 2 %/h", "value: -2 %/h", "protocol[2].set.parameter.value", "must be >= 0 1/s$"},
        Spoilt{"value: 2 %/h", "value: 2 h", "protocol[2].set.parameter.value", "^'2 h' is a time; give a rate"},
        Spoilt{"value: 2 %/h", "", "protocol[2].set.parameter.value", "^is missing; give a rate"},
        Spoilt{"name: growth.rate", "name: growth.rat", "protocol[2].set.parameter.name",
               "^'growth.rat' is no parameter; did you mean 'growth.rate'\\?$"},
        Spoilt{"name: growth.rate", "name: growth.profile", "protocol[2].set.parameter.name",
               "^'growth.profile' is structural: organs are built with it; change it in the scenario and start again$"},
        Spoilt{"name: growth.rate", "name: elements", "protocol[2].set.parameter.name", "^'elements' is structural:"},
        Spoilt{"name: growth.rate", "name: colour", "protocol[2].set.parameter.name",
               "^'colour' is no parameter; known are 'sensitivities.gravity', .*'growth.rate'"},
        Spoilt{"acceleration: 3 m/s^2", "acceleration: 3 m/s", "protocol[3].set.gravity.acceleration",
               "give an acceleration"},
        Spoilt{"acceleration: 3 m/s^2", "acceleration: 1e7 m/s^2", "protocol[3].set", "is more than 1e\\+06 m/s\\^2$"},
        Spoilt{"{direction: [1, 0, 1], ", "{", "protocol[3].set.gravity.direction", "^is missing"},
        Spoilt{"set: {gravity: {direction: [1, 0, 1], acceleration: 3 m/s^2}}", "set: {}", "protocol[3].set",
               "^needs exactly one of 'parameter' and 'gravity'$"},
        Spoilt{"source: {label: 0.25", "source: {label: 1.5", "organs[0].source.label", "must be >= 0 and <= 1$"},
        Spoilt{"source: {label: 0.25, strength: 2}", "source: {label: 0.25}", "organs[0].source.strength",
               "^is missing"}));

TEST(ScenarioYaml, IdsAreUniqueWithinTheirKind) {
  std::string twice = valid;
  const std::string lamp = "    - {id: lamp, position: [10 cm, 0 m, 10 cm], strength: 1}\n";
  twice.insert(twice.find(lamp), lamp);
  EXPECT_EQ(list(problemsOf(twice)),
            "test:33: stimuli.point_sources[1].id: 'lamp' is already used on line 32; ids are unique");

  std::string same_id_of_another_kind = valid;
  same_id_of_another_kind.replace(same_id_of_another_kind.find("id: lamp, pos"), 8, "id: sun");
  EXPECT_THAT(list(problemsOf(same_id_of_another_kind)), HasSubstr("protocol[1].remove: there is no"));

  const std::size_t begin = valid.find("  - id: first"), end = valid.find("stimuli:");
  std::string two_organs = valid;
  two_organs.insert(end, valid.substr(begin, end - begin));
  EXPECT_EQ(list(problemsOf(two_organs)), "test:30: organs[1].id: 'first' is already used on line 10; ids are unique");
}

TEST(ScenarioYaml, DuplicateKeyNamesBothLines) {
  std::string twice = valid;
  twice.insert(twice.find("organs:"), "duration: 9 h\n");
  EXPECT_EQ(list(problemsOf(twice)), "test:9: duration: is given twice, first on line 4");
}

TEST(ScenarioYaml, AtLeastOneOrganIsNeeded) {
  std::string without = valid;
  const std::size_t begin = without.find("organs:"), end = without.find("stimuli:");
  without.replace(begin, end - begin, "organs: []\n");
  EXPECT_EQ(list(problemsOf(without)), "test:9: organs: is empty; give one entry at least");
}

TEST(ScenarioYaml, AllProblemsOfAFileAreReportedInOrderOfLine) {
  const std::string file = bad + "many_problems.yaml";
  try {
    loadScenario(file);
    FAIL() << "no error";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        file + ":1: name: 'wheat coleoptile' is not a valid name; give a letter followed by letters, digits and '_'\n" +
            file + ":1: weight: is missing; give true or false\n" + file +
            ":2: gravity.direction: has zero length; a direction needs a component that is not 0\n" + file +
            ":2: gravity.acceleration: '9.81 m/s' is in units of m.s-1; give an acceleration such as '9.81 m/s^2'\n" +
            file + ":3: wieght: is an unknown key; did you mean 'weight'?\n" + file +
            ":4: stepping.step: '0 min' is out of range; must be > 0 s\n" + file +
            ":7: organs[0].base.position: has 2 components; give a sequence of three, each a length such as '0.8 "
            "mm'\n" +
            file + ":10: organs[0].radius: '0.8' has no unit; give a length such as '0.8 mm'\n" + file +
            ":11: organs[0].material: needs exactly one of 'poisson_ratio' and 'shear_modulus'\n" + file +
            ":12: organs[0].growth.zone_length: is an unknown key; known here are 'elongation', 'twist_transport', "
            "'stress_coupling', "
            "'profile' and "
            "'rate'\n" +
            file + ":13: organs[0].sensitivities.softening_length: is missing; give a length such as '0.8 mm'\n" +
            file +
            ":14: organs[0].proprioception.intrinsic_length: '1,5 mm' does not begin with a finite number and a blank; "
            "give a "
            "length such as '0.8 mm'");
    EXPECT_EQ(error.problems().size(), 12u);
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
