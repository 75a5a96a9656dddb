// The step as its users meet it: stimuli, protocol, step limits, division, faults, reset.

#include "sensory_growth/simulation/simulation.h"

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tbb/global_control.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;
using support::kUnlimited;
using testing::HasSubstr;

StimulusCommand lamp(const std::string& id, const Vector3& position, double strength = 1.0,
                     StimulusOperation operation = StimulusOperation::add) {
  return {StimulusKind::point_source, operation, id, position, strength};
}

/// A weighted shoot that senses everything, with the default step limits.
Scenario shoot() {
  Scenario scenario = kinematicScenario(0.1, 20);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  scenario.stepping.limits = {};
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.03, 1.0, 1.0);
  organ.senses = {0.05, 0.1, 0.1, 0.01};
  organ.bending.proprioception.intrinsic_length = 0.01;
  organ.longest_element = 0.06;
  return scenario;
}

void expectSameBits(const Simulation& a, const Simulation& b) {
  ASSERT_EQ(a.organs().size(), b.organs().size());
  for (std::size_t i = 0; i < a.organs().size(); ++i) {
    const rod::Rod& x = a.organs()[i].rod();
    const rod::Rod& y = b.organs()[i].rod();
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t e = 0; e < x.size(); ++e) {
      EXPECT_EQ(x.vertices[e + 1].position, y.vertices[e + 1].position);
      EXPECT_EQ(x.elements[e].frame.coeffs(), y.elements[e].frame.coeffs());
      EXPECT_EQ(x.bends[e].rest_curvature, y.bends[e].rest_curvature);
    }
  }
}

TEST(Simulation, TurnsTheTipTowardsALampAndFollowsWhenItMoves) {
  Scenario scenario = shoot();
  scenario.organs.front().base.frame = rod::Quaternion::Identity();
  scenario.organs.front().section = support::section(0.03, 1.0, 0.0);
  scenario.organs.front().senses.point_source = 0.3;
  Simulation simulation(scenario);
  const auto tipX = [&] { return (simulation.organs().front().rod().apex().frame * Vector3::UnitZ()).x(); };

  EXPECT_EQ(simulation.apply(lamp("lamp", {5.0, 0.0, 1.0})).refusal, "");
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(simulation.step().ok);
  const double towards = tipX();
  EXPECT_GT(towards, 0.3);

  simulation.apply(lamp("lamp", {-5.0, 0.0, 1.0}, 1.0, StimulusOperation::change));
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(simulation.step().ok);
  EXPECT_LT(tipX(), -0.3);
}

TEST(Simulation, RefusesWhatMakesNoSenseAndChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Simulation simulation(shoot());
  Simulation untouched(shoot());
  EXPECT_THAT(simulation.apply(lamp("", {1, 0, 0})).refusal, HasSubstr("id is empty"));
  EXPECT_THAT(simulation.apply(lamp("a", {nan, 0, 0})).refusal, HasSubstr("not finite"));
  EXPECT_THAT(simulation.apply(lamp("a", {2e6, 0, 0})).refusal, HasSubstr("beyond"));
  EXPECT_THAT(simulation.apply(lamp("a", {1, 0, 0}, nan)).refusal, HasSubstr("strength nan is not in [-1000, 1000]"));
  EXPECT_THAT(simulation.apply(lamp("a", {1, 0, 0}, -1e4)).refusal, HasSubstr("strength -10000"));
  EXPECT_THAT(simulation.apply(lamp("a", {1, 0, 0}, 1.0, StimulusOperation::change)).refusal,
              HasSubstr("there is no point_source 'a' to change"));
  EXPECT_THAT(simulation.apply(lamp("a", {1, 0, 0}, 1.0, StimulusOperation::remove)).refusal,
              HasSubstr("there is no point_source 'a' to remove"));
  EXPECT_THAT(
      simulation
          .apply(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", Vector3::Zero(), 1.0})
          .refusal,
      HasSubstr("zero length"));
  EXPECT_EQ(simulation.takeApplied().size(), 8u);
  ASSERT_TRUE(simulation.step().ok);
  ASSERT_TRUE(untouched.step().ok);
  expectSameBits(simulation, untouched);
}

TEST(Simulation, BoundsTheNumberOfStimuli) {
  Simulation simulation(shoot());
  for (int i = 0; i < 256; ++i) EXPECT_EQ(simulation.apply(lamp(std::to_string(i), {1, 0, 0})).refusal, "");
  EXPECT_THAT(simulation.apply(lamp("one more", {1, 0, 0})).refusal, HasSubstr("256 point_sources already"));
  EXPECT_EQ(simulation.apply(lamp("7", {2, 0, 0})).refusal, "");
  EXPECT_EQ(simulation.environment().point_sources.size(), 256u);
}

TEST(Simulation, NormalisesLightDirections) {
  Simulation simulation(shoot());
  simulation.apply(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {3.0, 0.0, 4.0}, 1.0});
  const Vector3 towards = simulation.environment().light_directions.front().towards;
  EXPECT_LT((towards - Vector3(0.6, 0.0, 0.8)).norm(), 1e-15);
}

TEST(Simulation, KeepsPointSourcesAndLightsOfOneIdApart) {
  Simulation simulation(shoot());
  simulation.apply(lamp("a", {1, 0, 0}));
  simulation.apply(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "a", {1.0, 0.0, 0.0}, 1.0});
  simulation.apply(lamp("a", {2, 0, 0}));
  EXPECT_EQ(simulation.environment().point_sources.size(), 1u);
  EXPECT_EQ(simulation.environment().point_sources.front().position.x(), 2.0);
  simulation.apply(lamp("a", Vector3::Zero(), 1.0, StimulusOperation::remove));
  EXPECT_TRUE(simulation.environment().point_sources.empty());
  EXPECT_EQ(simulation.environment().light_directions.size(), 1u);
}

TEST(Simulation, TakesTheProtocolAtTheFirstStepBoundaryThatIsNotTooEarly) {
  Scenario scenario = shoot();
  scenario.protocol = {{0.0, lamp("first", {1, 0, 0})},
                       {0.3, lamp("on_boundary", {2, 0, 0})},
                       {0.31, lamp("between", {3, 0, 0})},
                       {0.31, lamp("first", Vector3::Zero(), 1.0, StimulusOperation::remove)}};
  Simulation simulation(scenario);
  std::vector<AppliedCommand> applied = simulation.takeApplied();
  ASSERT_EQ(applied.size(), 1u);
  EXPECT_EQ(applied[0].step, 0u);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  applied = simulation.takeApplied();
  ASSERT_EQ(applied.size(), 3u);
  EXPECT_EQ(std::get<StimulusCommand>(applied[0].command).id, "on_boundary");
  EXPECT_EQ(applied[0].step, 3u);
  EXPECT_EQ(std::get<StimulusCommand>(applied[1].command).id, "between");
  EXPECT_EQ(applied[1].step, 4u);
  EXPECT_EQ(applied[2].step, 4u);
  EXPECT_EQ(simulation.environment().point_sources.size(), 2u);
  EXPECT_TRUE(simulation.takeApplied().empty());
}

TEST(Simulation, EqualCommandsGiveEqualBitsAlsoAfterReset) {
  const auto run = [](Simulation& simulation) {
    for (int i = 0; i < 12; ++i) {
      if (i == 3) simulation.apply(lamp("lamp", {1.0, 2.0, 0.5}));
      if (i == 7) simulation.apply(lamp("lamp", {1.0, -2.0, 0.5}, 0.5, StimulusOperation::change));
      ASSERT_TRUE(simulation.step().ok);
    }
  };
  Scenario scenario = shoot();
  scenario.protocol = {{0.2, lamp("late", {-1.0, 1.0, 0.0})}};
  Simulation once(scenario);
  Simulation again(scenario);
  run(once);
  run(again);
  expectSameBits(once, again);
  again.reset();
  EXPECT_EQ(again.stepIndex(), 0u);
  EXPECT_TRUE(again.environment().point_sources.empty());
  run(again);
  expectSameBits(once, again);
}

/// Organs that differ in size and direction under a lamp.
Scenario meadow(std::size_t organs) {
  Scenario scenario = shoot();
  const OrganScenario first = scenario.organs.front();
  scenario.organs.clear();
  for (std::size_t i = 0; i < organs; ++i) {
    OrganScenario organ = first;
    organ.id = "organ_" + std::to_string(i);
    organ.elements = 10 + 3 * i;
    organ.base.frame = rod::exp(Vector3(0.0, 0.0, 0.4 * static_cast<double>(i))) * first.base.frame;
    scenario.organs.push_back(organ);
  }
  scenario.protocol = {{0.0, lamp("lamp", {2.0, 1.0, 1.0})}};
  return scenario;
}

TEST(Simulation, TheNumberOfThreadsChangesNoBit) {
  const tbb::global_control enough_threads(tbb::global_control::max_allowed_parallelism, 8);
  Simulation alone(meadow(12));
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(alone.step().ok);
  for (const int threads : {0, 2, 5}) {
    Simulation together(meadow(12), threads);
    for (int i = 0; i < 8; ++i) ASSERT_TRUE(together.step().ok);
    expectSameBits(alone, together);
  }
}

TEST(Simulation, AFailedStepChangesNothingWithThreadsEither) {
  const tbb::global_control enough_threads(tbb::global_control::max_allowed_parallelism, 8);
  Scenario scenario = meadow(6);
  scenario.stepping.limits.bend_angle = scenario.stepping.limits.total_angle = kUnlimited;
  for (const std::size_t weak : {2u, 4u}) {  // they curl far beyond what three elements resolve
    scenario.organs[weak].elements = 3;
    scenario.organs[weak].longest_element = kUnlimited;
    scenario.organs[weak].senses = {0.0, 0.0, 20.0, 0.0};
  }
  const auto run = [&](int threads) {
    Simulation simulation(scenario, threads);
    StepReport report;
    for (int i = 0; i < 50 && report.ok; ++i) report = simulation.step();
    EXPECT_FALSE(report.ok);
    return std::make_pair(std::move(simulation), report.message);
  };
  const auto [alone, alone_message] = run(1);
  const auto [together, together_message] = run(4);
  EXPECT_THAT(alone_message, HasSubstr("organ 'organ_"));
  EXPECT_EQ(alone_message, together_message);
  EXPECT_EQ(alone.stepIndex(), together.stepIndex());
  expectSameBits(alone, together);
  Simulation before(scenario);
  for (std::uint64_t i = 0; i < alone.stepIndex(); ++i) ASSERT_TRUE(before.step().ok);
  expectSameBits(before, together);
}

TEST(Simulation, TimeIsTheStepIndexTimesTheStep) {
  Simulation simulation(shoot());
  for (int i = 0; i < 7; ++i) ASSERT_TRUE(simulation.step().ok);
  EXPECT_EQ(simulation.stepIndex(), 7u);
  EXPECT_EQ(simulation.time(), 7 * 0.1);
}

TEST(Simulation, FinishesAfterItsDuration) {
  Scenario scenario = shoot();
  scenario.duration = 0.3;
  Simulation simulation(scenario);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(simulation.finished());
    ASSERT_TRUE(simulation.step().ok);
  }
  EXPECT_TRUE(simulation.finished());
  scenario.duration = 0.0;
  EXPECT_FALSE(Simulation(scenario).finished());
}

TEST(Simulation, DividesElementsAsTheyGrow) {
  Simulation simulation(shoot());
  for (int i = 0; i < 15; ++i) ASSERT_TRUE(simulation.step().ok);
  const rod::Rod& rod = simulation.organs().front().rod();
  EXPECT_GT(rod.size(), 60u);
  for (const rod::Element& e : rod.elements) EXPECT_LE(e.rest_length, 0.06);
  EXPECT_NEAR(rod.restLength(), std::exp(1.5), 1e-9);
  double reference = 0.0;
  for (const rod::Element& e : rod.elements) reference += e.reference_length;
  EXPECT_NEAR(reference, 1.0, 1e-12);
}

TEST(Simulation, IsInEquilibriumAfterDivisions) {
  Scenario scenario = shoot();
  Simulation simulation(scenario);
  bool divided = false;
  for (int i = 0; i < 6 && !divided; ++i) {
    ASSERT_TRUE(simulation.step().ok);
    const Organ& organ = simulation.organs().front();
    if (organ.report().divisions == 0) continue;
    divided = true;
    rod::Rod copy = organ.rod();
    mechanics::Loads loads;
    loads.gravity = scenario.gravity;
    EXPECT_EQ(mechanics::StaticEquilibrium().relax(copy, loads).iterations, 0);
  }
  EXPECT_TRUE(divided);
}

TEST(Simulation, SensesGravityWithoutWeight) {
  Scenario scenario = shoot();
  scenario.weight = false;
  scenario.organs.front().senses = {};
  Simulation still(scenario);
  ASSERT_TRUE(still.step().ok);
  EXPECT_NEAR(still.organs().front().rod().vertices.back().position.z(), 0.0, 1e-12);
  scenario.organs.front().senses.gravity = 0.1;
  Simulation lifting(scenario);
  ASSERT_TRUE(lifting.step().ok);
  EXPECT_GT(lifting.organs().front().rod().vertices.back().position.z(), 0.05);
}

TEST(Simulation, ReportsDifferentialGrowthThatTissueCannotGive) {
  Scenario scenario = kinematicScenario(0.001, 20);
  scenario.organs.front().senses.gravity = 1.5;
  Simulation simulation(scenario);
  ASSERT_TRUE(simulation.step().ok);
  EXPECT_NEAR(simulation.organs().front().report().largest_differential_growth, 1.5, 1e-9);
}

TEST(Simulation, KinematicOrgansFailLikeElasticOnes) {
  Scenario scenario = kinematicScenario(0.1, 4);
  scenario.organs.front().rest_curvature = {0.0, 6.0, 0.0};  // 1.5 rad between neighbours, more as they grow
  Simulation curling(scenario);
  EXPECT_THAT(curling.step().message, HasSubstr("unresolved_bend"));

  scenario = kinematicScenario(1e3, 4);
  scenario.organs.front().rest_curvature = {0.0, 0.1, 0.0};
  Simulation exploding(scenario);
  const StepReport report = exploding.step();
  EXPECT_FALSE(report.ok);
  EXPECT_TRUE(std::isfinite(exploding.organs().front().rod().restLength()));

  scenario.organs.front().rest_curvature = {0.0, 20.0, 0.0};  // 5 rad between neighbours
  EXPECT_THROW(Simulation{scenario}, std::invalid_argument);
}

TEST(Simulation, StopsBeforeElementsFillTheMemory) {
  Scenario scenario = kinematicScenario(0.5, 100);
  scenario.organs.front().longest_element = 1e-2 * (1.0 + 1e-9);
  Simulation simulation(scenario);
  StepReport report;
  for (int i = 0; i < 30 && report.ok; ++i) report = simulation.step();
  EXPECT_THAT(report.message, HasSubstr("more than 100000 elements"));
  EXPECT_LE(simulation.organs().front().rod().size(), 100000u);
}

TEST(Simulation, AFailedStepChangesNothingAndSaysWhy) {
  Scenario scenario = shoot();
  scenario.organs.push_back(scenario.organs.front());
  OrganScenario& weak = scenario.organs.back();
  weak.id = "weak";
  weak.elements = 3;
  weak.longest_element = kUnlimited;
  weak.senses = {0.0, 20.0, 0.0, 0.0};  // curls far beyond what three elements resolve
  scenario.stepping.limits.bend_angle = scenario.stepping.limits.total_angle = kUnlimited;
  Simulation simulation(scenario);
  simulation.apply(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0.0, 1.0, 0.0}, 1.0});
  StepReport report;
  std::uint64_t good = 0;
  std::vector<Vector3> tips;
  for (int i = 0; i < 50 && report.ok; ++i) {
    good = simulation.stepIndex();
    tips.clear();
    for (const Organ& organ : simulation.organs()) tips.push_back(organ.rod().vertices.back().position);
    report = simulation.step();
  }
  ASSERT_FALSE(report.ok);
  EXPECT_THAT(report.message, HasSubstr("organ 'weak'"));
  EXPECT_THAT(report.message, HasSubstr("unresolved_bend"));
  EXPECT_EQ(simulation.stepIndex(), good);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    EXPECT_EQ(simulation.organs()[i].rod().vertices.back().position, tips[i]);
  }
  simulation.reset();
  EXPECT_TRUE(simulation.step().ok);
}

TEST(Simulation, RefusesStepsThatAreFarTooLong) {
  Scenario scenario = shoot();
  scenario.stepping.step = 1e4;
  Simulation simulation(scenario);
  const StepReport report = simulation.step();
  EXPECT_FALSE(report.ok);
  EXPECT_THAT(report.message, HasSubstr("shorten the step"));
}

TEST(Simulation, RefusesOrgansThatCannotBeBuilt) {
  Scenario scenario = shoot();
  scenario.organs.front().length = -1.0;
  EXPECT_THROW(Simulation{scenario}, std::invalid_argument);
  scenario = shoot();
  for (const double step : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    scenario.stepping.step = step;
    EXPECT_THROW(Simulation{scenario}, std::invalid_argument);
  }
  scenario = shoot();
  scenario.protocol = {{1.0, lamp("late", {1, 0, 0})}, {0.5, lamp("early", {1, 0, 0})}};
  EXPECT_THROW(Simulation{scenario}, std::invalid_argument);
}

TEST(Simulation, KinematicOrgansIgnoreTheirWeight) {
  Scenario scenario = shoot();
  scenario.relaxation = RelaxationMethod::kinematics;
  scenario.organs.front().senses = {};
  Simulation simulation(scenario);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  EXPECT_NEAR(simulation.organs().front().rod().vertices.back().position.z(), 0.0, 1e-14);
}

}  // namespace
}  // namespace sensory_growth::simulation
