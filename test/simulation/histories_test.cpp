// Histories of what was sensed survive what happens to an organ: division, steps that vary, fail or are taken back,
// pause and reset.

#include <cmath>

#include <gtest/gtest.h>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using growth::BeforeStart;
using growth::Cue;
using growth::Route;
using rod::Vector3;
using support::grown;
using support::kinematicScenario;
using support::onlyRod;
using support::order;

/// A growing organ that bends towards a light by every kind of route.
Scenario everyRoute(double step, std::size_t elements) {
  Scenario scenario = kinematicScenario(step, elements);
  scenario.gravity = {0.0, 0.0, -1.0};
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", Vector3(0.3, 1.0, 0.5), 1.0}},
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", Vector3(1.0, -0.5, 1.0), 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  organ.senses.gravity = organ.senses.light_direction = organ.senses.point_source = 0.03;
  organ.senses.softening_length = 0.01;
  organ.bending.proprioception.intrinsic_length = 0.01;
  Route local;
  local.cues = {Cue::gravity};
  local.memory = growth::LinearOde{0.1, 0.2, {1.8, 1.0}};
  Route spread;
  spread.cues = {Cue::light_direction, Cue::point_source};
  spread.memory = growth::exponentialKernel(0.3);
  spread.spread = growth::FadingSpread{growth::FadingSpread::Direction::basipetal, 0.4};
  Route sampled;
  sampled.cues = {Cue::point_source};
  sampled.sensor = growth::Sensor{growth::Coordinate::label, 0.7};
  sampled.memory = growth::SampledKernel{{0.0, 0.1, 0.4}, {4.0, 4.0, 0.0}};
  sampled.before_start = BeforeStart::zero;
  Route apical;
  apical.cues = {Cue::light_direction};
  apical.sensor = growth::Sensor{};
  apical.memory = growth::Delay{0.15};
  apical.receivers = {growth::Coordinate::distance_from_base, {0.0, 1.0}, {0.0, 1.0}};
  organ.sensing = {local, spread, sampled, apical};
  return scenario;
}

TEST(Histories, SurviveDivisionToSecondOrderInTheLengthOfElements) {
  const auto difference = [](std::size_t n) {
    Scenario scenario = everyRoute(0.02, n);
    const rod::Rod undivided = grown(scenario, 40);
    scenario.organs.front().longest_element = 1.5 / static_cast<double>(n);
    const rod::Rod divided = grown(scenario, 40);
    EXPECT_EQ(undivided.size(), n);
    EXPECT_EQ(divided.size(), 2 * n);
    return (divided.vertices.back().position - undivided.vertices.back().position).norm();
  };
  EXPECT_LT(difference(40), 6.25e-4);  // model.md 18: 1e-4 at n = 100
  EXPECT_NEAR(order(difference(10), difference(20)), 2.0, 0.15);
  EXPECT_NEAR(order(difference(20), difference(40)), 2.0, 0.15);
}

TEST(Histories, MakeTheStepSecondOrderInTime) {
  const auto tip = [](double step) {
    return grown(everyRoute(step, 20), std::lround(0.8 / step)).vertices.back().position;
  };
  const Vector3 coarse = tip(0.04), middle = tip(0.02), fine = tip(0.01), finest = tip(0.005);
  EXPECT_NEAR(order((middle - coarse).norm(), (fine - middle).norm()), 2.0, 0.2);
  EXPECT_NEAR(order((fine - middle).norm(), (finest - fine).norm()), 2.0, 0.2);
}

bool sameBits(const rod::Rod& a, const rod::Rod& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (a.bends[j].rest_curvature != b.bends[j].rest_curvature) return false;
    if (a.elements[j].rest_length != b.elements[j].rest_length) return false;
    if (a.vertices[j + 1].position != b.vertices[j + 1].position) return false;
  }
  return true;
}

TEST(Histories, AreTakenBackWithTheStepsThatAre) {
  Scenario scenario = everyRoute(0.1, 10);
  scenario.organs.front().longest_element = 0.15;
  scenario.stepping.limits.growth_strain = 0.03;
  growth::Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitY(), 1.0}};
  growth::Environment dark;
  Organ plain(scenario.organs.front(), scenario);
  Organ tried(scenario.organs.front(), scenario);
  for (int i = 0; i < 12; ++i) {
    environment.time = dark.time = 0.1 * i;
    ASSERT_TRUE(tried.advance(0.1, dark).ok());
    tried.undo();
    ASSERT_FALSE(tried.advance(1e4, environment).ok());
    ASSERT_TRUE(tried.advance(0.1, environment).ok());
    ASSERT_TRUE(plain.advance(0.1, environment).ok());
    EXPECT_TRUE(sameBits(plain.rod(), tried.rod())) << i;
  }
  EXPECT_GT(plain.rod().size(), 10u);
}

TEST(Histories, AreThoseOfThePartsThatSucceeded) {
  Scenario scenario = everyRoute(0.4, 20);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.05, 1.0, 2.0);
  for (Route& route : organ.sensing) route.memory = growth::exponentialKernel(0.5);
  growth::Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitY(), 1.0}};
  // With so few iterations that a whole step fails, but two halves do not.
  const auto needsTwoParts = [&](int iterations) {
    scenario.relaxation_settings.max_iterations = iterations;
    Organ organ_once(organ, scenario);
    const OrganReport report = organ_once.advance(0.4, environment);
    return report.ok() && report.retries == 1 && report.substeps == 2;
  };
  int iterations = 2;
  while (!needsTwoParts(iterations)) ASSERT_LT(++iterations, 10);
  Organ retried(organ, scenario);
  Organ plain(organ, scenario);
  retried.advance(0.4, environment);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(plain.advance(0.2, environment).ok());
    ASSERT_EQ(plain.report().retries, 0);
    environment.time += 0.2;
  }
  EXPECT_TRUE(sameBits(plain.rod(), retried.rod()));
}

TEST(Histories, EndWithAReset) {
  Scenario scenario = everyRoute(0.1, 10);
  Simulation simulation(scenario);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  const rod::Rod first = onlyRod(simulation);
  simulation.reset();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  EXPECT_TRUE(sameBits(first, onlyRod(simulation)));
}

TEST(Histories, AreThoseOfAPauseWithoutSteps) {
  // Between two steps nothing passes: a stimulus that comes and goes there is never perceived.
  Simulation plain(everyRoute(0.1, 10));
  Simulation paused(everyRoute(0.1, 10));
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(plain.step().ok);
    ASSERT_TRUE(paused.step().ok);
    paused.apply(
        StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "flash", Vector3::UnitZ(), 100.0});
    paused.apply(
        StimulusCommand{StimulusKind::light_direction, StimulusOperation::remove, "flash", Vector3::Zero(), 1.0});
  }
  EXPECT_TRUE(sameBits(onlyRod(plain), onlyRod(paused)));
}

}  // namespace
}  // namespace sensory_growth::simulation
