// A steady growth step takes no memory from the heap. An executable of its own, because it replaces operator new.

#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace {

std::atomic<long> allocations{0};

void* countedAllocation(std::size_t size, std::size_t alignment) {
  ++allocations;
  // aligned_alloc wants a multiple of the alignment.
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return countedAllocation(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return countedAllocation(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

/// A leaning shoot under its weight that senses gravity, a light direction and a lamp.
Simulation shoot(RelaxationMethod relaxation) {
  Scenario scenario = support::kinematicScenario(0.02, 100);
  scenario.relaxation = relaxation;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.03, 1.0, 1.0);
  organ.profile = growth::LogisticProfile{1.0, 0.4, 15.0};
  organ.senses = {0.05, 0.1, 0.1, 0.01};
  organ.bending.proprioception.intrinsic_length = 0.01;
  Simulation simulation(scenario);
  simulation.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 2.0, 0.5}, 1.0});
  simulation.apply(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0.0, 1.0, 1.0}, 1.0});
  return simulation;
}

/// Allocations in ten steps after the first few.
long allocationsOfSteadySteps(Simulation& simulation) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(simulation.step().ok);
  const long before = allocations;
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(simulation.step().ok);
  return allocations - before;
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  Simulation simulation = shoot(RelaxationMethod::kinematics);
  EXPECT_GT(allocations - before, 10);
}

TEST(Allocations, AreNotNeededByASteadyStepInEquilibrium) {
  Simulation simulation = shoot(RelaxationMethod::statics);
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
  EXPECT_GT(simulation.organs().front().report().iterations, 0);
  EXPECT_EQ(simulation.organs().front().report().divisions, 0u);
}

TEST(Allocations, AreNotNeededByAStepOfAgingTissueUnderStress) {
  Scenario scenario = shoot(RelaxationMethod::statics).scenario();
  OrganScenario& organ = scenario.organs.front();
  organ.profile = growth::SampledProfile({0.0, 0.2, 0.4}, {1.0, 0.5, 0.0});
  organ.stress_coupling = growth::StressCoupling{};
  organ.stress_coupling->yield_margin = 1e3;
  organ.aging = growth::Aging{};
  organ.aging->young_modulus = growth::Maturation{2.0 * organ.section.young_modulus, 1.0};
  organ.aging->radius = growth::Maturation{0.04, 1.0};
  Simulation simulation(scenario);
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
  EXPECT_GT(simulation.organs().front().rod().elements.front().section.radius, 0.03);
}

TEST(Allocations, AreNotNeededByASteadyKinematicStep) {
  Simulation simulation = shoot(RelaxationMethod::kinematics);
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
}

TEST(Allocations, AreNotNeededByAStepThatRemembers) {
  Scenario scenario = shoot(RelaxationMethod::kinematics).scenario();
  growth::Route late;
  late.cues = {growth::Cue::gravity};
  late.memory = growth::LinearOde{0.04, 0.1, {2.0, 1.0}};
  growth::Route apical;
  apical.cues = {growth::Cue::gravity};
  apical.sensor = growth::Sensor{};
  apical.memory = growth::Delay{0.04};
  growth::Route fading;
  fading.cues = {growth::Cue::gravity};
  fading.spread = growth::FadingSpread{growth::FadingSpread::Direction::both, 0.2};
  scenario.organs.front().sensing = {late, apical, fading};
  Simulation simulation(scenario);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);  // until the past is as long as it gets
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
}

TEST(Allocations, AreNotNeededByOrgansThatSenseEachOther) {
  Scenario scenario = shoot(RelaxationMethod::statics).scenario();
  scenario.organs.front().id = "an_organ_whose_name_is_too_long_for_a_short_string";
  scenario.organs.front().source = OrganSource{0.9, 1.0};
  scenario.organs.push_back(scenario.organs.front());
  scenario.organs.back().id = "another_organ_whose_name_is_long";
  scenario.organs.back().base.position.y() = 1.0;
  Simulation simulation(scenario);
  simulation.apply(
      StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "a_lamp_with_a_long_name", {1, 2, 0}, 1.0});
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
}

TEST(Allocations, AreNotNeededWithAnyCueAndGrowthLaw) {
  Scenario scenario = shoot(RelaxationMethod::statics).scenario();
  OrganScenario& organ = scenario.organs.front();
  organ.senses.intensity_exponent = 0.5;
  organ.senses.distance = growth::SampledPull{{0.1, 2.0}, {1.0, 0.5}};
  organ.senses.oscillator = {0.1, 0.5, 0.2, 1.0};
  organ.bending.proprioception = {0.01, 0.01, 0.01, {0.1, 0.2}};
  organ.bending.rotation = growth::RestRotation{1.0, 1e-3};
  organ.bending.saturation = true;
  Simulation simulation(scenario);
  simulation.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 2.0, 0.5}, 1.0});
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
}

TEST(Allocations, AreNotNeededByAStepOfSeveralParts) {
  Simulation one = shoot(RelaxationMethod::kinematics);
  Scenario scenario = one.scenario();
  scenario.stepping.limits.growth_strain = 0.006;
  Simulation simulation(scenario);
  EXPECT_EQ(allocationsOfSteadySteps(simulation), 0);
  EXPECT_EQ(simulation.organs().front().report().substeps, 4);
}

}  // namespace
}  // namespace sensory_growth::simulation
