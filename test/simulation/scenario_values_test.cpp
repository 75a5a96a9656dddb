// What a scenario file says arrives in the scenario, in SI; what it leaves out has its documented default.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;
using support::expectNear;
using support::good;
using support::infinity;

/// Directors of the base of an organ that points along `direction`.
rod::Matrix3 baseFrame(const std::string& direction, const std::string& roll) {
  YAML::Node scenario = YAML::LoadFile(good + "least_keys.yaml");
  scenario["organs"][0]["base"]["direction"] = YAML::Load(direction);
  scenario["organs"][0]["base"]["roll"] = roll;
  return parseScenario(YAML::Dump(scenario), "test").organs[0].base.frame.toRotationMatrix();
}

rod::Matrix3 directors(const Vector3& d1, const Vector3& d2, const Vector3& d3) {
  rod::Matrix3 frame;
  frame << d1, d2, d3;
  return frame;
}

TEST(ScenarioYaml, EveryKeyArrivesInSi) {
  const Scenario s = loadScenario(good + "all_keys.yaml");
  EXPECT_EQ(s.name, "all_keys");
  EXPECT_EQ(s.description, "Every key of a statically relaxed scenario.");
  expectNear(s.gravity, {0.0, 0.0, -9.80665});
  EXPECT_TRUE(s.weight);
  EXPECT_DOUBLE_EQ(s.duration, 129600.0);

  EXPECT_DOUBLE_EQ(s.stepping.step, 120.0);
  EXPECT_FALSE(s.stepping.second_order);
  EXPECT_EQ(s.stepping.limits.tip_advance, 0.25);
  EXPECT_EQ(s.stepping.limits.growth_strain, 0.02);
  EXPECT_DOUBLE_EQ(s.stepping.limits.bend_angle, 0.017453292519943295);
  EXPECT_EQ(s.stepping.limits.total_angle, infinity);
  EXPECT_EQ(s.stepping.limits.oscillation, 0.05);
  EXPECT_EQ(s.stepping.limits.smallest_part, 0.125);

  EXPECT_EQ(s.relaxation, RelaxationMethod::statics);
  EXPECT_EQ(s.relaxation_settings.tolerance, 1e-8);
  EXPECT_EQ(s.relaxation_settings.max_iterations, 77);
  EXPECT_EQ(s.relaxation_settings.max_branch_switches, 3);
  EXPECT_DOUBLE_EQ(s.relaxation_settings.max_rotation, 0.5235987755982988);
  EXPECT_DOUBLE_EQ(s.relaxation_settings.max_bend_angle, 0.5);

  ASSERT_EQ(s.organs.size(), 2u);
  const OrganScenario& organ = s.organs[0];
  EXPECT_EQ(organ.id, "logistic_organ");
  expectNear(organ.base.position, {0.001, -0.02, 0.3});
  EXPECT_LT((organ.base.frame.toRotationMatrix() - directors({0, 0, -1}, {-1, 0, 0}, {0, 1, 0})).norm(), 1e-14);
  EXPECT_DOUBLE_EQ(organ.length, 0.03);
  EXPECT_EQ(organ.elements, 60u);
  EXPECT_DOUBLE_EQ(organ.section.radius, 8e-4);
  EXPECT_DOUBLE_EQ(organ.section.young_modulus, 12e6);
  EXPECT_DOUBLE_EQ(organ.section.shear_modulus, 4e6);
  EXPECT_DOUBLE_EQ(organ.section.density, 1100.0);
  EXPECT_EQ(organ.section.shear_correction, 0.9);
  EXPECT_TRUE(organ.section.inextensible);
  const auto& logistic = std::get<growth::LogisticProfile>(organ.profile);
  EXPECT_DOUBLE_EQ(logistic.rate, 1e-4);
  EXPECT_DOUBLE_EQ(logistic.zone_length, 0.01);
  EXPECT_EQ(logistic.steepness, 12.0);
  EXPECT_FALSE(organ.elongation);
  EXPECT_EQ(organ.senses.gravity, 0.1);
  EXPECT_EQ(organ.senses.light_direction, -0.2);
  EXPECT_EQ(organ.senses.point_source, 0.3);
  EXPECT_DOUBLE_EQ(organ.senses.softening_length, 0.0015);
  EXPECT_DOUBLE_EQ(organ.bending.proprioception.intrinsic_length, 6e-5);
  EXPECT_DOUBLE_EQ(organ.longest_element, 7e-4);
  EXPECT_EQ(organ.division, rod::DivisionMode::keep_positions);
  expectNear(organ.loads.tip_force, {1e-3, 0.0, -2e-6});
  expectNear(organ.rest_curvature, {5.0, 20.0, -1.0});
  ASSERT_TRUE(organ.source);
  EXPECT_EQ(organ.source->label, 0.75);
  EXPECT_EQ(organ.source->strength, -0.5);

  const OrganScenario& flat = s.organs[1];
  EXPECT_DOUBLE_EQ(flat.section.young_modulus, 1e9);
  EXPECT_DOUBLE_EQ(flat.section.shear_modulus, 3e5);
  EXPECT_DOUBLE_EQ(std::get<growth::ApicalFlatProfile>(flat.profile).rate, 2e-5);
  EXPECT_DOUBLE_EQ(std::get<growth::ApicalFlatProfile>(flat.profile).zone_length, 0.005);
  EXPECT_EQ(flat.longest_element, infinity);
}

TEST(ScenarioYaml, SensesAndGrowthLawsArriveInSi) {
  const Scenario s = loadScenario(good + "senses.yaml");
  ASSERT_EQ(s.organs.size(), 5u);
  const OrganScenario& all = s.organs[0];
  EXPECT_EQ(all.twist_transport, growth::TwistTransport::rate);
  EXPECT_EQ(all.senses.intensity_exponent, 0.5);
  const auto& power = std::get<growth::InversePowerPull>(all.senses.distance);
  EXPECT_DOUBLE_EQ(power.length, 0.1);
  EXPECT_EQ(power.exponent, 1.5);
  EXPECT_EQ(all.senses.oscillator.amplitude, 0.25);
  EXPECT_DOUBLE_EQ(all.senses.oscillator.period, -5400.0);
  EXPECT_DOUBLE_EQ(all.senses.oscillator.phase, 0.5235987755982988);
  EXPECT_DOUBLE_EQ(all.senses.oscillator.phase_gradient, 17.453292519943295);
  EXPECT_DOUBLE_EQ(all.bending.proprioception.intrinsic_length, 1e-3);
  EXPECT_DOUBLE_EQ(all.bending.proprioception.actual_length, 2e-3);
  EXPECT_DOUBLE_EQ(all.bending.proprioception.relaxation_length, 3e-3);
  EXPECT_EQ(all.bending.proprioception.set_point, Eigen::Vector2d(4.0, -50.0));
  EXPECT_TRUE(all.bending.saturation);
  EXPECT_FALSE(all.bending.rotation);

  const auto& sampled = std::get<growth::SampledPull>(s.organs[1].senses.distance);
  EXPECT_THAT(sampled.distances, testing::ElementsAre(0.0, testing::DoubleEq(0.02), testing::DoubleEq(0.05)));
  EXPECT_THAT(sampled.factors, testing::ElementsAre(1.0, 0.5, -0.25));
  ASSERT_TRUE(s.organs[1].bending.rotation);
  EXPECT_DOUBLE_EQ(s.organs[1].bending.rotation->period, 7200.0);
  EXPECT_EQ(s.organs[1].bending.rotation->gate, 0.01);
  EXPECT_EQ(s.organs[1].senses.oscillator.amplitude, 0.0);

  EXPECT_DOUBLE_EQ(std::get<growth::ExponentialPull>(s.organs[2].senses.distance).length, 0.03);
  EXPECT_EQ(s.organs[2].bending.rotation->gate, 1e-3);
  EXPECT_DOUBLE_EQ(std::get<growth::GaussianPull>(s.organs[3].senses.distance).length, 0.04);
  EXPECT_EQ(s.organs[3].senses.oscillator.phase, 0.0);
  EXPECT_EQ(s.organs[3].senses.oscillator.phase_gradient, 0.0);
  EXPECT_TRUE(std::holds_alternative<growth::ConstantPull>(s.organs[4].senses.distance));
  EXPECT_EQ(s.organs[4].twist_transport, growth::TwistTransport::angle);
}

TEST(ScenarioYaml, LoadsAndSurroundingsArriveInSi) {
  const Scenario s = loadScenario(good + "loads.yaml");
  ASSERT_EQ(s.organs.size(), 2u);
  EXPECT_EQ(s.organs[0].base_support, rod::BaseSupport::hinged);
  const mechanics::Loads& loads = s.organs[0].loads;
  expectNear(loads.tip_force, {0.0, 1e-6, 0.0});
  expectNear(loads.line_force, {2e-3, 0.0, -3e-3});
  expectNear(loads.tip_couple, {0.0, 4e-6, 5e-8});

  ASSERT_EQ(loads.surroundings.springs.size(), 2u);
  const mechanics::Spring& spring = loads.surroundings.springs[0];
  EXPECT_EQ(spring.label, 0.25);
  expectNear(spring.anchor, {0.01, 0.0, 0.002});
  EXPECT_DOUBLE_EQ(spring.stiffness, 3.0);
  EXPECT_EQ(loads.surroundings.springs[1].label, 1.0);
  EXPECT_DOUBLE_EQ(loads.surroundings.springs[1].stiffness, 4.0);

  ASSERT_EQ(loads.surroundings.walls.size(), 2u);
  const mechanics::Wall& floor = loads.surroundings.walls[0];
  expectNear(floor.point, {0.0, 0.0, -0.001});
  expectNear(floor.normal, {0.0, 0.0, 1.0});
  EXPECT_EQ(floor.stiffness, infinity);
  expectNear(loads.surroundings.walls[1].normal, {-0.6, 0.0, 0.8});
  EXPECT_DOUBLE_EQ(loads.surroundings.walls[1].stiffness, 6000.0);

  const std::optional<mechanics::HeldApex>& apex = loads.surroundings.held_apex;
  ASSERT_TRUE(apex && apex->frame);
  expectNear(apex->position, {0.035, 0.0, 0.001});
  EXPECT_LT((apex->frame->toRotationMatrix() - directors({0, 0, -1}, {-1, 0, 0}, {0, 1, 0})).norm(), 1e-14);

  EXPECT_EQ(s.organs[1].base_support, rod::BaseSupport::frozen_first_element);
  const std::optional<mechanics::HeldApex>& free_to_turn = s.organs[1].loads.surroundings.held_apex;
  ASSERT_TRUE(free_to_turn);
  expectNear(free_to_turn->position, {0.0, 1.0, 0.031});
  EXPECT_FALSE(free_to_turn->frame);
}

TEST(ScenarioYaml, AbsentKeysHaveTheirDocumentedDefaults) {
  const Scenario s = loadScenario(good + "least_keys.yaml");
  EXPECT_EQ(s.description, "");
  EXPECT_EQ(s.duration, 0.0);
  EXPECT_FALSE(s.weight);
  EXPECT_EQ(s.relaxation, RelaxationMethod::kinematics);
  EXPECT_TRUE(s.stepping.second_order);
  EXPECT_EQ(s.stepping.limits.tip_advance, 0.5);
  EXPECT_EQ(s.stepping.limits.growth_strain, 0.05);
  EXPECT_EQ(s.stepping.limits.bend_angle, 0.02);
  EXPECT_EQ(s.stepping.limits.total_angle, 0.1);
  EXPECT_EQ(s.stepping.limits.oscillation, 0.1);
  EXPECT_EQ(s.stepping.limits.smallest_part, 0.000244140625);
  EXPECT_TRUE(s.protocol.empty());
  const OrganScenario& organ = s.organs.at(0);
  EXPECT_LT((organ.base.frame.toRotationMatrix() - rod::Matrix3::Identity()).norm(), 1e-15);
  EXPECT_EQ(std::get<growth::UniformProfile>(organ.profile).rate, 0.0);
  EXPECT_TRUE(organ.elongation);
  EXPECT_FALSE(organ.section.inextensible);
  EXPECT_DOUBLE_EQ(organ.section.shear_correction, 0.9642857142857143);
  EXPECT_EQ(organ.twist_transport, growth::TwistTransport::angle);
  EXPECT_EQ(organ.senses.softening_length, 0.0);
  EXPECT_EQ(organ.senses.intensity_exponent, 1.0);
  EXPECT_TRUE(std::holds_alternative<growth::ConstantPull>(organ.senses.distance));
  EXPECT_EQ(organ.senses.oscillator.amplitude, 0.0);
  EXPECT_EQ(organ.bending.proprioception.actual_length, 0.0);
  EXPECT_EQ(organ.bending.proprioception.relaxation_length, 0.0);
  EXPECT_TRUE(organ.bending.proprioception.set_point.isZero(0.0));
  EXPECT_FALSE(organ.bending.saturation);
  EXPECT_FALSE(organ.bending.rotation);
  EXPECT_EQ(organ.division, rod::DivisionMode::keep_strain);
  EXPECT_EQ(organ.base_support, rod::BaseSupport::clamped);
  EXPECT_TRUE(organ.loads.tip_force.isZero(0.0));
  EXPECT_TRUE(organ.loads.line_force.isZero(0.0));
  EXPECT_TRUE(organ.loads.tip_couple.isZero(0.0));
  EXPECT_TRUE(organ.loads.surroundings.empty());
  EXPECT_FALSE(organ.source);
  EXPECT_TRUE(organ.rest_curvature.isZero(0.0));

  const Scenario relaxed = loadScenario("../config/wheat_coleoptile.yaml");
  EXPECT_EQ(relaxed.relaxation, RelaxationMethod::statics);
  EXPECT_EQ(relaxed.relaxation_settings.tolerance, 1e-10);
  EXPECT_EQ(relaxed.relaxation_settings.max_iterations, 2000);
}

TEST(ScenarioYaml, BaseFrameIsTheMinimalRotationThenTheRoll) {
  const double r = std::sqrt(0.5);
  const struct {
    const char* direction;
    const char* roll;
    rod::Matrix3 frame;
  } cases[] = {
      {"[0, 0, 5]", "0 deg", directors({1, 0, 0}, {0, 1, 0}, {0, 0, 1})},
      {"[0, 0, 5]", "90 deg", directors({0, 1, 0}, {-1, 0, 0}, {0, 0, 1})},
      {"[2, 0, 0]", "0 deg", directors({0, 0, -1}, {0, 1, 0}, {1, 0, 0})},
      {"[2, 0, 0]", "-90 deg", directors({0, -1, 0}, {0, 0, -1}, {1, 0, 0})},
      {"[-1, 0, 0]", "0 deg", directors({0, 0, 1}, {0, 1, 0}, {-1, 0, 0})},
      {"[0, 1e-200, 1e-200]", "0 deg", directors({1, 0, 0}, {0, r, -r}, {0, r, r})},
      {"[0, 0, -1]", "0 deg", directors({1, 0, 0}, {0, -1, 0}, {0, 0, -1})},
      {"[0, 0, -1]", "180 deg", directors({-1, 0, 0}, {0, 1, 0}, {0, 0, -1})},
      {"[1e-9, 0, -1]", "0 deg", directors({-1, 0, -1e-9}, {0, 1, 0}, {1e-9, 0, -1})},
  };
  for (const auto& c : cases) {
    const rod::Matrix3 frame = baseFrame(c.direction, c.roll);
    EXPECT_LT((frame - c.frame).norm(), 1e-14) << c.direction << ", roll " << c.roll << ":\n" << frame;
  }
}

TEST(ScenarioYaml, EveryKeyOfDynamicRelaxationIsRead) {
  const Scenario s = loadScenario(good + "dynamic.yaml");
  EXPECT_EQ(s.relaxation, RelaxationMethod::dynamics);
  const mechanics::DynamicsSettings& dynamics = s.dynamics_settings;
  EXPECT_EQ(dynamics.damping, 20.0);
  EXPECT_EQ(dynamics.time_step, 0.25);
  EXPECT_EQ(dynamics.ramp_periods, 5.0);
  EXPECT_EQ(dynamics.max_periods, 50.0);
  EXPECT_DOUBLE_EQ(dynamics.max_bend_angle, 0.78539816339744831);
  EXPECT_TRUE(dynamics.dilatation);
  EXPECT_EQ(dynamics.stopping, mechanics::StoppingRule::residual);
  EXPECT_EQ(dynamics.tolerance, 1e-7);
}

TEST(ScenarioYaml, EveryKeyOfContinuousRelaxationIsRead) {
  const Scenario s = loadScenario(good + "continuous.yaml");
  EXPECT_EQ(s.relaxation, RelaxationMethod::continuous);
  EXPECT_DOUBLE_EQ(s.growth_per_second, 600.0);
  const mechanics::DynamicsSettings& dynamics = s.dynamics_settings;
  EXPECT_EQ(dynamics.stopping, mechanics::StoppingRule::rotational_energy);
  EXPECT_DOUBLE_EQ(dynamics.rest_energy, 2e-12);
  EXPECT_EQ(dynamics.rest_steps, 700);
  // Not given: documented defaults.
  EXPECT_FALSE(dynamics.damping.has_value());
  EXPECT_EQ(dynamics.time_step, 0.3);
  EXPECT_EQ(dynamics.ramp_periods, 3.0);
  EXPECT_EQ(dynamics.max_periods, 200.0);
  EXPECT_DOUBLE_EQ(dynamics.max_bend_angle, 1.5707963267948966);
  EXPECT_FALSE(dynamics.dilatation);
  EXPECT_EQ(dynamics.tolerance, 1e-9);
}

}  // namespace
}  // namespace sensory_growth::simulation
