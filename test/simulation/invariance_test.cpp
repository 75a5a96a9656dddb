// What must not matter (model.md 17): how the world is turned, how the base is rolled, how frames are labelled, from
// which end the organ is read; on organs that sense by every kind of route, bend under loads and by all growth laws
// together, circumnutate, feel stress, age and divide.

#include <cmath>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using growth::Cue;
using rod::Quaternion;
using rod::Vector3;
using support::order;

/// Routes that hand on what a bend senses to that bend alone, later.
std::vector<growth::Route> localRoutes() {
  growth::Route gravity;
  gravity.cues = {Cue::gravity};
  gravity.memory = growth::LinearOde{0.1, 0.2, {1.8, 1.0}};
  gravity.receivers = {growth::Coordinate::distance_from_apex, {0.0, 1.0}, {1.0, 0.3}};
  growth::Route light;
  light.cues = {Cue::light_direction};
  light.memory = growth::Delay{0.15};
  growth::Route lamp;
  lamp.cues = {Cue::point_source};
  lamp.memory = growth::SampledKernel{{0.0, 0.1, 0.4}, {4.0, 4.0, 0.0}};
  lamp.before_start = growth::BeforeStart::zero;
  return {gravity, light, lamp};
}

/// Routes along the organ besides.
std::vector<growth::Route> allRoutes() {
  std::vector<growth::Route> routes = localRoutes();
  growth::Route apical;
  apical.cues = {Cue::light_direction};
  apical.sensor = growth::Sensor{};
  apical.memory = growth::exponentialKernel(0.3);
  growth::Route material;
  material.cues = {Cue::gravity};
  material.sensor = growth::Sensor{growth::Coordinate::label, 0.6};
  growth::Route fading;
  fading.cues = {Cue::point_source};
  fading.spread = growth::FadingSpread{growth::FadingSpread::Direction::both, 0.3};
  growth::Route sampled;
  sampled.cues = {Cue::light_direction};
  sampled.spread = growth::SampledSpread{{0.0, 1.0}, (Eigen::Matrix2d() << 0.1, 0.5, 0.2, 1.0).finished()};
  routes.insert(routes.end(), {apical, material, fading, sampled});
  return routes;
}

/// Tissue that yields to stress, stiffens and thickens, and follows all growth laws at once while its bend turns.
void giveEveryLaw(OrganScenario& organ) {
  organ.stress_coupling = growth::StressCoupling{};
  organ.stress_coupling->yield_margin = 0.01 * organ.section.young_modulus;
  organ.aging = growth::Aging{};
  organ.aging->young_modulus = growth::Maturation{3.0 * organ.section.young_modulus, 0.5};
  organ.aging->radius = growth::Maturation{1.2 * organ.section.radius, 1.0};
  organ.bending.proprioception.intrinsic_length = 0.02;
  organ.bending.proprioception.actual_length = 0.01;
  organ.bending.proprioception.relaxation_length = 0.015;
  organ.bending.rotation = growth::RestRotation{3.0, 1e-3};
}

/// A heavy organ in a world that is turned as a whole, with its base rolled in it.
Scenario heavyOrgan(const Quaternion& turn, double roll) {
  Scenario scenario = support::kinematicScenario(0.05, 20);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-13;
  scenario.weight = true;
  scenario.gravity = turn * Vector3(0.1, 0.2, -1.0);
  scenario.protocol = {
      {0.0,
       StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", turn * Vector3(1.0, 1.0, 0.3), 1.0}},
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun",
                            turn * Vector3(0.2, -1.0, 0.5), 1.0}},
      {0.2, StimulusCommand{StimulusKind::light_direction, StimulusOperation::remove, "sun", Vector3::Zero(), 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  organ.base = {turn * Vector3(0.3, 0.1, -0.2), turn * support::rolled(support::alongX(), roll)};
  organ.section = support::section(0.05, 1.0, 2.0);
  organ.loads.tip_force = turn * Vector3(0.1, -0.2, 0.1);
  organ.loads.line_force = turn * Vector3(0.0, 0.1, 0.1);
  organ.loads.surroundings.springs = {{0.5, turn * Vector3(0.8, 0.0, -0.1), 3.0}};
  organ.loads.surroundings.walls = {{turn * Vector3(0.0, 0.0, -0.4), turn * Vector3(0.0, 0.0, 1.0), 20.0}};
  organ.profile = growth::LogisticProfile{1.0, 0.5, 10.0};
  organ.senses.gravity = organ.senses.light_direction = 0.1;
  organ.senses.point_source = 0.05;
  organ.senses.softening_length = 0.01;
  organ.longest_element = 0.055;
  organ.sensing = allRoutes();
  giveEveryLaw(organ);
  return scenario;
}

rod::Rod grown(const Scenario& scenario, int steps) {
  Simulation simulation(scenario);
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.ok) << report.message;
    if (!report.ok) break;
  }
  return simulation.organs().front().rod();
}

/// Largest distance between the vertices of `a`, turned, and those of `b`.
double distance(const Quaternion& turn, const rod::Rod& a, const rod::Rod& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t v = 0; v < std::min(a.vertices.size(), b.vertices.size()); ++v) {
    largest = std::max(largest, (turn * a.vertices[v].position - b.vertices[v].position).norm());
  }
  return largest;
}

TEST(Invariance, ATurnOfTheWorldTurnsTheOrgan) {
  const auto turned = [](const Quaternion& turn) {
    Scenario scenario = heavyOrgan(turn, 0.0);
    OrganScenario& organ = scenario.organs.front();
    organ.senses.oscillator = {0.1, 0.7, 0.3, 1.0};
    organ.bending.proprioception.set_point = {0.2, -0.4};
    organ.rest_curvature = {0.2, -0.1, 0.6};
    return grown(scenario, 12);
  };
  const rod::Rod reference = turned(Quaternion::Identity());
  EXPECT_GT(reference.size(), 25u);  // some elements have divided
  for (const Vector3& theta : {Vector3(0.7, -1.1, 0.4), Vector3(0.0, 0.0, 3.0)}) {
    const Quaternion turn = rod::exp(theta);
    EXPECT_LT(distance(turn, reference, turned(turn)), 1e-11);
  }
}

TEST(Invariance, RollOfTheBaseDoesNotMatter) {
  const rod::Rod reference = grown(heavyOrgan(Quaternion::Identity(), 0.0), 12);
  for (const double roll : {0.6, M_PI_2, -2.5}) {
    EXPECT_LT(distance(Quaternion::Identity(), reference, grown(heavyOrgan(Quaternion::Identity(), roll), 12)), 1e-12);
  }
}

TEST(Invariance, LabellingFramesByATwistDoesNotMatterToSecondOrder) {
  // A straight organ whose frames turn by 3 rad from base to apex is the same organ, as long as nothing is handed along
  // its fibres: what is handed on from one place to another then turns with them.
  const auto effect = [](std::size_t n, const std::vector<growth::Route>& routes) {
    Scenario scenario = heavyOrgan(Quaternion::Identity(), 0.0);
    OrganScenario& organ = scenario.organs.front();
    organ.elements = n;
    organ.longest_element = 1.1 / static_cast<double>(n);
    organ.sensing = routes;
    const rod::Rod straight = grown(scenario, 8);
    organ.rest_curvature.z() = 3.0;
    return (grown(scenario, 8).vertices.back().position - straight.vertices.back().position).norm();
  };
  EXPECT_NEAR(order(effect(20, localRoutes()), effect(40, localRoutes())), 2.0, 0.2);
  EXPECT_NEAR(order(effect(40, localRoutes()), effect(80, localRoutes())), 2.0, 0.2);
  EXPECT_GT(effect(80, allRoutes()), 10.0 * effect(80, localRoutes()));
}

// Read from its apex to its base, an organ has frames R diag(1, -1, -1) and curvatures (-k1, k2, k3) in reverse order.

/// An organ that is pinned at both ends, closer together than it is long, and the same tissue read from the other end.
Scenario pinnedOrgan(bool reversed) {
  const double sign = reversed ? -1.0 : 1.0;
  Scenario scenario = support::kinematicScenario(0.05, 20);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-12;
  scenario.weight = true;
  scenario.gravity = {0.1, 0.2, -1.0};
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.3, 1.0, 0.4}, 1.0}},
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0.2, -1.0, 0.5}, 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  const Vector3 left = Vector3::Zero(), right(0.95, 0.0, 0.0);
  const Quaternion frame = support::alongX();
  organ.base = reversed ? rod::Pose{right, frame * Quaternion(0.0, 1.0, 0.0, 0.0)} : rod::Pose{left, frame};
  organ.base_support = rod::BaseSupport::hinged;
  organ.loads.surroundings.held_apex = mechanics::HeldApex{reversed ? left : right, std::nullopt};
  organ.loads.surroundings.springs = {{reversed ? 0.7 : 0.3, {0.2, 0.1, -0.3}, 5.0}};
  organ.loads.line_force = {0.0, 0.1, 0.1};
  organ.section = support::section(0.05, 1.0, 2.0);
  organ.longest_element = 0.055;
  organ.rest_curvature = {sign * 0.3, -0.4, 0.5};
  giveEveryLaw(organ);
  organ.bending.proprioception.set_point = {sign * 0.2, -0.4};
  organ.bending.rotation->period *= sign;
  organ.senses.gravity = organ.senses.light_direction = organ.senses.point_source = 0.1;
  organ.senses.softening_length = 0.01;
  organ.senses.oscillator = {0.1, sign * 0.7, sign * 0.3, 0.0};
  growth::Route gravity;
  gravity.cues = {Cue::gravity, Cue::oscillator};
  gravity.memory = growth::LinearOde{0.1, 0.2, {1.8, 1.0}};
  gravity.spread = growth::FadingSpread{
      reversed ? growth::FadingSpread::Direction::acropetal : growth::FadingSpread::Direction::basipetal, 0.3};
  gravity.receivers = {growth::Coordinate::label, {0.0, 1.0}, {reversed ? 0.3 : 1.0, reversed ? 1.0 : 0.3}};
  organ.sensing = {gravity};
  return scenario;
}

TEST(Invariance, ReadingAnOrganFromItsApexDoesNotMatter) {
  const rod::Rod forwards = grown(pinnedOrgan(false), 8);
  const rod::Rod backwards = grown(pinnedOrgan(true), 8);
  ASSERT_EQ(forwards.size(), backwards.size());
  EXPECT_GT(forwards.size(), 25u);
  const std::size_t n = forwards.size();
  for (std::size_t e = 0; e < n; ++e) {
    EXPECT_NEAR(forwards.elements[e].rest_length, backwards.elements[n - 1 - e].rest_length, 1e-11) << e;
    EXPECT_NEAR(forwards.elements[e].age, backwards.elements[n - 1 - e].age, 1e-11) << e;
  }
  for (std::size_t v = 0; v <= n; ++v) {
    EXPECT_LT((forwards.vertices[v].position - backwards.vertices[n - v].position).norm(), 1e-10) << v;
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
