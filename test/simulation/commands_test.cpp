// What changes while a simulation runs: numbers of organs and gravity.

#include "sensory_growth/simulation/commands.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::kinematicScenario;
using testing::HasSubstr;
using testing::StartsWith;

void takeSteps(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

Vector3 tip(const Simulation& simulation, std::size_t organ = 0) {
  return simulation.organs()[organ].rod().vertices.back().position;
}

void expectSameBits(const Simulation& a, const Simulation& b) {
  ASSERT_EQ(a.organs().size(), b.organs().size());
  EXPECT_EQ(a.stepIndex(), b.stepIndex());
  for (std::size_t i = 0; i < a.organs().size(); ++i) {
    const rod::Rod& x = a.organs()[i].rod();
    const rod::Rod& y = b.organs()[i].rod();
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t e = 0; e < x.size(); ++e) EXPECT_EQ(x.vertices[e + 1].position, y.vertices[e + 1].position);
  }
}

/// Two organs that sense everything, heavy but for kinematic relaxation.
Scenario couple(RelaxationMethod relaxation = RelaxationMethod::statics) {
  Scenario scenario = kinematicScenario(0.05, 20);
  scenario.relaxation = relaxation;
  scenario.weight = relaxation != RelaxationMethod::kinematics;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(0.03, 1.0, 1.0);
  organ.senses = {0.05, 0.1, 0.1, 0.01};
  organ.bending.proprioception.intrinsic_length = 0.01;
  scenario.organs.push_back(organ);
  scenario.organs.back().id = "second";
  scenario.organs.back().base.position = {0.0, 1.0, 0.0};
  scenario.organs.back().source = OrganSource{1.0, 1.0};
  return scenario;
}

/// A horizontal cantilever that does not grow; rho g A L^3 / (E I) = 5 at gravity 1.
Scenario cantilever(const Vector3& gravity) {
  Scenario scenario = kinematicScenario(0.1, 100);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = gravity;
  scenario.organs.front().profile = growth::UniformProfile{0.0};
  scenario.organs.front().section = support::inextensibleSection(1.0, 5.0);
  return scenario;
}

TEST(GravityCommand, BringsAnOrganToItsNewEquilibriumInTheNextStep) {
  // Heavy elastica, beta = 5 (model.md V1).
  Simulation simulation(cantilever(Vector3::UnitX()));
  EXPECT_LT((tip(simulation) - Vector3::UnitX()).norm(), 1e-12);
  EXPECT_EQ(simulation.apply(GravityCommand{-Vector3::UnitZ()}).refusal, "");
  EXPECT_LT((tip(simulation) - Vector3::UnitX()).norm(), 1e-12);
  takeSteps(simulation, 1);
  EXPECT_NEAR(tip(simulation).x(), 0.846657180, 2e-4);
  EXPECT_NEAR(tip(simulation).z(), -0.495905045, 2e-4);
  const Vector3 there = tip(simulation);
  takeSteps(simulation, 1);
  EXPECT_LT((tip(simulation) - there).norm(), 1e-9);
  simulation.apply(GravityCommand{Vector3::Zero()});
  takeSteps(simulation, 1);
  EXPECT_LT((tip(simulation) - Vector3::UnitX()).norm(), 1e-9);
}

TEST(GravityCommand, TurnsWhatIsSensedAndWhatIsWeighedTogether) {
  // An organ and its world turned, against an organ that the world turns about.
  const rod::Quaternion turn = rod::exp(Vector3(0.4, 0.7, -0.2));
  Scenario turned = couple();
  turned.organs.pop_back();
  Scenario straight = turned;
  turned.gravity = turn * turned.gravity;
  straight.protocol = {{0.0, GravityCommand{turned.gravity}}};
  Simulation a(turned), b(straight);
  EXPECT_LT((b.environment().down - turned.gravity.normalized()).norm(), 1e-15);
  EXPECT_EQ(b.gravity(), turned.gravity);
  takeSteps(a, 6);
  takeSteps(b, 6);
  EXPECT_LT((tip(a) - tip(b)).norm(), 1e-8);
}

TEST(GravityCommand, LeavesUnsensedWhatHasNoWeight) {
  Scenario scenario = couple(RelaxationMethod::kinematics);
  Simulation simulation(scenario);
  simulation.apply(GravityCommand{Vector3::Zero()});
  takeSteps(simulation, 5);
  EXPECT_EQ(simulation.environment().down, Vector3::Zero());
  EXPECT_LT(std::abs(tip(simulation, 1).z()), 1e-14);
  simulation.apply(GravityCommand{Vector3::UnitZ()});  // upside down: a shoot grows against it
  takeSteps(simulation, 5);
  EXPECT_LT(tip(simulation, 1).z(), -0.01);
}

TEST(GravityCommand, KeepsAStepSecondOrder) {
  std::vector<rod::Rod> shapes;
  for (const int steps : {20, 40, 80, 160}) {
    Scenario scenario = couple();
    scenario.organs.pop_back();
    scenario.relaxation_settings.tolerance = 1e-12;
    scenario.stepping.step = 1.0 / steps;
    scenario.organs.front().section = support::section(0.05, 1.0, 0.2);
    scenario.protocol = {{0.5, GravityCommand{Vector3(-0.6, 0.0, -0.8)}}};
    Simulation simulation(scenario);
    takeSteps(simulation, steps);
    shapes.push_back(simulation.organs().front().rod());
  }
  const auto distance = [&](std::size_t i) {  // of all vertices: that of the tip passes through zero
    double sum = 0.0;
    for (std::size_t v = 0; v < shapes[i].vertices.size(); ++v) {
      sum += (shapes[i].vertices[v].position - shapes[i + 1].vertices[v].position).norm();
    }
    return sum;
  };
  EXPECT_NEAR(std::log2(distance(1) / distance(2)), 2.0, 0.1);
}

TEST(GravityCommand, MovesOrgansInMotionWithoutJump) {
  Scenario scenario = cantilever(Vector3::UnitX());
  scenario.relaxation = RelaxationMethod::continuous;
  scenario.growth_per_second = 1.0;
  scenario.stepping.step = 0.01;
  scenario.organs.front().section = support::section(0.05, 1.0, 5.0);
  scenario.organs.front().elements = 20;
  Simulation simulation(scenario);
  simulation.apply(GravityCommand{-Vector3::UnitZ()});
  takeSteps(simulation, 1);
  // Free fall for 0.01 s, g t^2 / 2, but where the clamp holds it.
  EXPECT_NEAR(tip(simulation).z(), -0.5e-4, 1e-6);
}

TEST(ParameterCommand, ChangesTheRateFromTheNextStepOn) {
  Scenario scenario = kinematicScenario(0.05, 10);
  Simulation simulation(scenario);
  takeSteps(simulation, 10);
  EXPECT_EQ(simulation.apply(ParameterCommand{"organ", "growth.rate", 0.4}).refusal, "");
  takeSteps(simulation, 10);
  EXPECT_NEAR(simulation.organs().front().rod().restLength(), std::exp(0.5 + 0.2), 1e-12);
}

TEST(ParameterCommand, MeansOneOrganOrAll) {
  Scenario scenario = kinematicScenario(0.05, 10);
  scenario.organs.push_back(scenario.organs.front());
  scenario.organs.back().id = "second";
  Simulation simulation(scenario);
  simulation.apply(ParameterCommand{"second", "growth.rate", 0.5});
  takeSteps(simulation, 10);
  EXPECT_NEAR(simulation.organs()[0].rod().restLength(), std::exp(0.5), 1e-12);
  EXPECT_NEAR(simulation.organs()[1].rod().restLength(), std::exp(0.25), 1e-12);
  simulation.apply(ParameterCommand{"all", "growth.rate", 0.0});
  takeSteps(simulation, 10);
  EXPECT_NEAR(simulation.organs()[0].rod().restLength(), std::exp(0.5), 1e-12);
  EXPECT_NEAR(simulation.organs()[1].rod().restLength(), std::exp(0.25), 1e-12);
}

TEST(ParameterCommand, GivesTheBitsOfAScenarioWithTheValue) {
  for (const Parameter& parameter : parameters()) {
    SCOPED_TRACE(parameter.name);
    const bool is_stress = parameter.name == "growth.stress_coupling.yield_margin";
    const double value = is_stress ? 500.0 : 0.07;
    Scenario scenario = couple(is_stress ? RelaxationMethod::statics : RelaxationMethod::kinematics);
    if (is_stress) {
      for (OrganScenario& organ : scenario.organs) organ.stress_coupling = growth::StressCoupling{1e4};
    }
    scenario.protocol = {
        {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0, 1, 1}, 2.0}},
        {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0, 1, 1}, 1.0}}};
    Scenario changed = scenario;
    parameter.set(changed.organs[1], value);
    EXPECT_EQ(parameter.get(changed.organs[1]), value);
    EXPECT_NE(parameter.get(scenario.organs[1]), value);

    Simulation without(scenario), with(changed), live(scenario);
    EXPECT_EQ(live.apply(ParameterCommand{"second", parameter.name, value}).refusal, "");
    for (Simulation* simulation : {&without, &with, &live}) takeSteps(*simulation, 5);
    expectSameBits(live, with);
    const std::size_t affected = parameter.name == "source.strength" ? 0 : 1;
    EXPECT_GT((tip(without, affected) - tip(live, affected)).norm(), 1e-6);
  }
}

TEST(Commands, OfTheProtocolDoWhatThoseByHandDo) {
  const std::vector<TimedCommand> protocol = {
      {0.1, ParameterCommand{"all", "sensitivities.gravity", -0.1}},
      {0.2, GravityCommand{Vector3(0.3, 0.0, -0.6)}},
      {0.2, ParameterCommand{"second", "proprioception.intrinsic_length", 0.03}},
  };
  Scenario scenario = couple();
  Simulation by_hand(scenario);
  scenario.protocol = protocol;
  Simulation by_protocol(scenario);
  std::size_t next = 0;
  for (int i = 0; i < 8; ++i) {
    while (next < protocol.size() && protocol[next].time < by_hand.time() + 1e-9) {
      EXPECT_EQ(by_hand.apply(protocol[next++].command).refusal, "");
    }
    takeSteps(by_hand, 1);
    takeSteps(by_protocol, 1);
  }
  expectSameBits(by_hand, by_protocol);
  const std::vector<AppliedCommand> applied = by_protocol.takeApplied();
  ASSERT_EQ(applied.size(), 3u);
  EXPECT_EQ(applied[0].step, 2u);
  EXPECT_EQ(std::get<ParameterCommand>(applied[0].command).value, -0.1);
  EXPECT_EQ(applied[1].step, 4u);
  EXPECT_EQ(std::get<GravityCommand>(applied[1].command).acceleration, Vector3(0.3, 0.0, -0.6));
  EXPECT_EQ(std::get<ParameterCommand>(applied[2].command).organ, "second");
}

TEST(Commands, AreForgottenByReset) {
  Simulation simulation(couple());
  simulation.apply(GravityCommand{Vector3(1.0, 0.0, 0.0)});
  simulation.apply(ParameterCommand{"all", "sensitivities.gravity", 1.0});
  simulation.apply(ParameterCommand{"second", "source.strength", -3.0});
  takeSteps(simulation, 3);
  simulation.apply(GravityCommand{Vector3(0.0, 1.0, 0.0)});  // not yet in effect when the reset comes
  simulation.reset();
  EXPECT_TRUE(simulation.takeApplied().empty());
  EXPECT_EQ(simulation.gravity(), -Vector3::UnitZ());
  takeSteps(simulation, 3);
  Simulation fresh(couple());
  takeSteps(fresh, 3);
  expectSameBits(simulation, fresh);
}

TEST(Commands, ThatAreRefusedSayWhyAndChangeNothing) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Simulation simulation(couple());
  const auto refusal = [&](const Command& command) {
    const AppliedCommand applied = simulation.apply(command);
    EXPECT_EQ(applied.step, 0u);
    return applied.refusal;
  };
  const auto refusalOf = [&](const std::string& organ, const std::string& name, double value) {
    return refusal(ParameterCommand{organ, name, value});
  };
  EXPECT_EQ(refusalOf("first", "growth.rate", 1.0), "there is no organ 'first'; give its id, or 'all'");
  EXPECT_EQ(refusalOf("", "growth.rate", 1.0), "there is no organ ''; give its id, or 'all'");
  EXPECT_EQ(refusalOf("all", "growth.rate", -1.0), "growth.rate -1 1/s is out of range; must be >= 0 1/s");
  EXPECT_EQ(refusalOf("all", "sensitivities.gravity", nan),
            "sensitivities.gravity nan is out of range; must be finite");
  EXPECT_THAT(refusalOf("all", "sensitivities.point_source", infinity), HasSubstr("must be finite"));
  EXPECT_EQ(refusalOf("all", "source.strength", 0.0), "organ 'organ' has no source.strength");
  EXPECT_EQ(refusalOf("organ", "source.strength", 0.0), "organ 'organ' has no source.strength");
  EXPECT_EQ(refusalOf("all", "sensitivities.gravty", 0.0),
            "'sensitivities.gravty' is no parameter; did you mean 'sensitivities.gravity'?");
  for (const char* structural : {"id", "base.position", "length", "elements", "radius", "material.young_modulus",
                                 "growth.profile", "growth.elongation", "division.longest_element", "source.label",
                                 "relaxation.method", "stepping.step", "weight", "springs[0].stiffness"}) {
    EXPECT_EQ(refusalOf("all", structural, 1.0),
              std::string("'") + structural +
                  "' is structural: organs are built with it; change it in the scenario and start again");
  }
  EXPECT_THAT(refusalOf("all", "", 1.0), StartsWith("'' is no parameter; known are 'sensitivities.gravity', "));
  EXPECT_EQ(refusal(GravityCommand{Vector3(0.0, nan, 1.0)}), "gravity (0, nan, 1) m/s^2 is not finite");
  EXPECT_EQ(refusal(GravityCommand{Vector3(0.0, 0.0, 2e6)}), "gravity (0, 0, 2e+06) m/s^2 is more than 1e+06 m/s^2");
  EXPECT_EQ(simulation.takeApplied().size(), 25u);
  Simulation untouched(couple());
  takeSteps(simulation, 2);
  takeSteps(untouched, 2);
  expectSameBits(simulation, untouched);
}

TEST(Commands, OutliveAStepThatFails) {
  // An upright column 100 times as heavy as it can carry would hang after the turn; its three elements cannot show it.
  Scenario scenario = couple();
  OrganScenario& weak = scenario.organs.back();
  weak.elements = 3;
  Simulation simulation(scenario);
  const Vector3 before = tip(simulation, 1);
  EXPECT_EQ(simulation.apply(GravityCommand{Vector3(-300.0, 0.0, 0.0)}).refusal, "");
  for (int i = 0; i < 2; ++i) {  // the second time as the first
    const StepReport report = simulation.step();
    ASSERT_FALSE(report.ok);
    EXPECT_THAT(report.message, HasSubstr("relaxation failed"));
    EXPECT_EQ(simulation.stepIndex(), 0u);
    EXPECT_EQ(tip(simulation, 1), before);
  }
  EXPECT_EQ(simulation.gravity(), Vector3(-300.0, 0.0, 0.0));
  simulation.apply(GravityCommand{Vector3(0.0, 0.0, -0.5)});
  takeSteps(simulation, 2);
  scenario.protocol = {{0.0, GravityCommand{Vector3(0.0, 0.0, -0.5)}}};
  Simulation straight_on(scenario);
  takeSteps(straight_on, 2);
  expectSameBits(simulation, straight_on);
}

TEST(Commands, LeaveNothingBehindWhereAStepFailsHalfWay) {
  // A heavy organ of four elements curls beyond what they resolve, after it has taken the new weight, and some parts
  // that made it expect to turn more than its rest state does and that it remembers.
  Scenario scenario = kinematicScenario(0.05, 4);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  scenario.stepping.limits.total_angle = 0.01;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame = rod::exp({0.0, 0.3, 0.0});
  organ.section = support::section(0.05, 1.0, 3.0);
  organ.senses.gravity = 0.1;
  organ.senses.point_source = 0.1;
  organ.sensing.resize(1);
  organ.sensing[0].cues = {growth::Cue::point_source};
  organ.sensing[0].memory = growth::exponentialKernel(0.2);
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", Vector3(1.0, 1.0, 1.0), 1.0}}};
  const ParameterCommand wild{"organ", "sensitivities.gravity", -10.0}, calm{"organ", "sensitivities.gravity", 0.1};
  const auto run = [&](bool tries_in_vain) {
    Simulation simulation(scenario);
    takeSteps(simulation, 2);
    simulation.apply(GravityCommand{Vector3(0.3, 0.0, -1.0)});
    if (tries_in_vain) {
      simulation.apply(wild);
      EXPECT_FALSE(simulation.step().ok);
      EXPECT_GT(simulation.organs().front().report().substeps, 0);
      simulation.apply(calm);
    }
    takeSteps(simulation, 2);
    return simulation;
  };
  expectSameBits(run(true), run(false));
}

}  // namespace
}  // namespace sensory_growth::simulation
