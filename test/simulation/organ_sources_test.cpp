// Organs that sense each other (model.md 14).

#include "sensory_growth/simulation/organ_sources.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

/// Two organs of different size that stand upright, attract each other, and bend without growing longer.
Scenario pair(double step) {
  Scenario scenario = support::kinematicScenario(step, 40);
  OrganScenario& left = scenario.organs.front();
  left.id = "left";
  left.base.frame = rod::Quaternion::Identity();
  left.elongation = false;
  left.senses.point_source = 0.1;
  left.senses.softening_length = 0.05;
  left.bending.proprioception.intrinsic_length = 0.02;
  left.source = OrganSource{1.0, 1.0};
  OrganScenario right = left;
  right.id = "right";
  right.base.position = {0.8, 0.0, 0.0};
  right.length = 0.7;
  right.elements = 30;
  right.senses.point_source = 0.08;
  right.source = OrganSource{0.75, 1.5};
  scenario.organs.push_back(right);
  return scenario;
}

void takeSteps(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

Vector3 tip(const Simulation& simulation, std::size_t organ) {
  return simulation.organs()[organ].rod().vertices.back().position;
}

void expectSameBits(const Organ& a, const Organ& b) {
  ASSERT_EQ(a.rod().size(), b.rod().size());
  for (std::size_t e = 0; e < a.rod().size(); ++e) {
    EXPECT_EQ(a.rod().vertices[e + 1].position, b.rod().vertices[e + 1].position);
    EXPECT_EQ(a.rod().bends[e].rest_curvature, b.rod().bends[e].rest_curvature);
  }
}

TEST(OrganSources, ArriveAtAnIndependentIntegrationWithSecondOrder) {
  // All curvatures of both planar chains as one system of ordinary differential equations, each place taken at the
  // time it is needed; scipy's DOP853 at a relative tolerance of 1e-12.
  const Vector3 left(0.7040899102407, 0.0, 0.5059588870492), right(0.6728462666031, 0.0, 0.6832867752455);
  std::vector<double> errors;
  for (const int steps : {20, 40, 80, 160}) {
    Simulation simulation(pair(1.0 / steps));
    takeSteps(simulation, steps);
    errors.push_back((tip(simulation, 0) - left).norm() + (tip(simulation, 1) - right).norm());
  }
  EXPECT_LT(errors.back(), 2e-5);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(errors[2] / errors[3]), 2.0, 0.1);
}

TEST(OrganSources, KeepTheOrderWhenAStepIsCutIntoParts) {
  std::vector<Vector3> tips;
  for (const int steps : {20, 40, 80}) {
    Scenario scenario = pair(1.0 / steps);
    scenario.stepping.limits.growth_strain = 0.26 / steps;  // four parts
    Simulation simulation(scenario);
    takeSteps(simulation, steps);
    EXPECT_EQ(simulation.organs()[0].report().substeps, 4);
    tips.push_back(tip(simulation, 0));
  }
  EXPECT_GT(std::log2((tips[0] - tips[1]).norm() / (tips[1] - tips[2]).norm()), 1.9);
}

TEST(OrganSources, KeepTheOrderWhenGravityTurns) {
  std::vector<Vector3> tips;
  for (const int steps : {20, 40, 80, 160}) {
    Scenario scenario = pair(1.0 / steps);
    scenario.relaxation = RelaxationMethod::statics;
    scenario.relaxation_settings.tolerance = 1e-12;
    scenario.weight = true;
    scenario.gravity = -Vector3::UnitZ();
    for (OrganScenario& organ : scenario.organs) organ.section = support::section(0.05, 1.0, 1.0);
    scenario.protocol = {{0.5, GravityCommand{Vector3(-0.6, 0.0, -0.8)}}};
    Simulation simulation(scenario);
    takeSteps(simulation, steps);
    tips.push_back(tip(simulation, 0));
  }
  EXPECT_NEAR(std::log2((tips[1] - tips[2]).norm() / (tips[2] - tips[3]).norm()), 2.0, 0.15);
}

/// What the plane x = 0 shows of a frame: the two agree but for the sign of d1.
rod::Quaternion mirrored(const rod::Quaternion& frame) {
  const rod::Matrix3 mirror = Vector3(-1.0, 1.0, 1.0).asDiagonal();
  return rod::Quaternion(rod::Matrix3(mirror * frame.toRotationMatrix() * mirror));
}

TEST(OrganSources, MirroredOrgansStayMirrored) {
  Scenario scenario = support::kinematicScenario(0.05, 12);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-13;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& left = scenario.organs.front();
  left.base.position = {-0.7, 0.0, 0.0};
  left.base.frame = rod::exp(Vector3(0.3, 0.2, 0.5));
  left.section = support::section(0.05, 1.0, 1.0);
  left.senses = {0.05, 0.1, 0.1, 0.05};
  left.bending.proprioception.intrinsic_length = 0.02;
  left.longest_element = 0.1;
  left.source = OrganSource{1.0, 1.0};
  OrganScenario right = left;
  right.id = "right";
  right.base.position.x() = 0.7;
  right.base.frame = mirrored(left.base.frame);
  scenario.organs.push_back(right);
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {0.0, 1.0, 1.0}, 1.0}}};
  Simulation simulation(scenario);
  takeSteps(simulation, 20);
  const rod::Rod& a = simulation.organs()[0].rod();
  const rod::Rod& b = simulation.organs()[1].rod();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 20u);
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    const Vector3& p = a.vertices[v].position;
    EXPECT_LT((b.vertices[v].position - Vector3(-p.x(), p.y(), p.z())).norm(), 1e-12);
  }
  EXPECT_GT(a.vertices.back().position.x(), -0.5);  // towards each other
}

TEST(OrganSources, AreSensedLikeALampInTheirPlace) {
  Scenario scenario = pair(0.05);
  scenario.organs[1].profile = growth::UniformProfile{0.0};
  Simulation beside_an_organ(scenario);
  scenario.organs.pop_back();
  const Vector3 place(0.8, 0.0, 0.75 * 0.7);
  scenario.protocol = {{0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", place, 1.5}}};
  Simulation beside_a_lamp(scenario);
  takeSteps(beside_an_organ, 10);
  takeSteps(beside_a_lamp, 10);
  EXPECT_LT((tip(beside_an_organ, 0) - tip(beside_a_lamp, 0)).norm(), 1e-14);
  const auto cue = [](const Simulation& simulation) {
    const growth::CueFields cues = simulation.organs()[0].cues(simulation.seenBy(0));
    return cues[static_cast<std::size_t>(growth::Cue::point_source)].back();
  };
  EXPECT_LT((cue(beside_an_organ) - cue(beside_a_lamp)).norm(), 1e-14);
  EXPECT_GT(cue(beside_a_lamp).norm(), 0.01);
  EXPECT_GT(tip(beside_a_lamp, 0).x(), 0.3);
}

TEST(OrganSources, AreNotSensedByThemselves) {
  Scenario scenario = pair(0.05);
  scenario.organs[1].source.reset();
  Simulation simulation(scenario);
  takeSteps(simulation, 10);
  EXPECT_EQ(tip(simulation, 0).head<2>(), Eigen::Vector2d::Zero());
  EXPECT_LT(tip(simulation, 1).x(), 0.7);
}

/// Three that sense each other, a lamp and gravity, in the given order.
Scenario trio(const std::vector<std::size_t>& order) {
  const Scenario two = pair(0.05);
  std::vector<OrganScenario> organs = {two.organs[0], two.organs[1], two.organs[1]};
  organs[2].id = "behind";
  organs[2].base.position = {0.3, 0.9, 0.1};
  Scenario scenario = two;
  scenario.organs.clear();
  for (const std::size_t i : order) scenario.organs.push_back(organs[i]);
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.4, 0.5, 2.0}, 0.7}}};
  return scenario;
}

TEST(OrganSources, NeitherOrderNorThreadsChangeABit) {
  const tbb::global_control enough_threads(tbb::global_control::max_allowed_parallelism, 8);
  Simulation first(trio({0, 1, 2}));
  takeSteps(first, 12);
  for (const int threads : {1, 3}) {
    const std::vector<std::size_t> order = {2, 0, 1};
    Simulation second(trio(order), threads);
    takeSteps(second, 12);
    for (std::size_t i = 0; i < order.size(); ++i) expectSameBits(second.organs()[i], first.organs()[order[i]]);
  }
}

TEST(OrganSources, MoveAsIfAFailedStepHadNotBeenTried) {
  Scenario scenario = pair(0.05);
  scenario.organs[1].elements = 4;
  scenario.organs[1].senses.gravity = -40.0;  // curls beyond what four elements resolve
  const ParameterCommand calm{"right", "sensitivities.gravity", 0.0};
  const auto run = [&](bool tries_in_vain) {
    scenario.protocol = {{0.0, calm},
                         {0.2, ParameterCommand{"right", "sensitivities.gravity", -40.0}},
                         {0.2, GravityCommand{Vector3(1.0, 0.0, -1.0)}}};
    Simulation simulation(scenario);
    takeSteps(simulation, 4);
    if (tries_in_vain) {
      EXPECT_FALSE(simulation.step().ok);
      EXPECT_FALSE(simulation.step().ok);
    }
    EXPECT_EQ(simulation.apply(calm).refusal, "");
    takeSteps(simulation, 4);
    return simulation;
  };
  const Simulation straight_on = run(false), after_failures = run(true);
  for (std::size_t i = 0; i < 2; ++i) expectSameBits(straight_on.organs()[i], after_failures.organs()[i]);
}

TEST(OrganSources, FollowTheirStrength) {
  Simulation simulation(pair(0.05));
  EXPECT_EQ(simulation.apply(ParameterCommand{"right", "source.strength", -1.5}).refusal, "");
  takeSteps(simulation, 10);
  EXPECT_LT(tip(simulation, 0).x(), -0.3);
}

}  // namespace
}  // namespace sensory_growth::simulation
