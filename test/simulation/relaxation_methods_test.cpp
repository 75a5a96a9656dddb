// Every way of relaxing with every way of stepping, for organs that sense each other.

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

struct Mode {
  RelaxationMethod relaxation;
  bool elongation;
  bool second_order;
};

/// Two leaning organs that attract each other, sense gravity and carry their weight, if there is elasticity.
Scenario pair(const Mode& mode, double step) {
  Scenario scenario = support::kinematicScenario(step, 6);
  scenario.relaxation = mode.relaxation;
  scenario.relaxation_settings.tolerance = 1e-13;
  scenario.dynamics_settings.tolerance = 1e-11;
  scenario.growth_per_second = 0.002;  // the first period is 1.1 s
  scenario.weight = mode.relaxation != RelaxationMethod::kinematics;
  scenario.gravity = -Vector3::UnitZ();
  scenario.stepping.second_order = mode.second_order;
  OrganScenario& left = scenario.organs.front();
  left.id = "left";
  left.base.frame = rod::exp(Vector3(0.0, 0.3, 0.0));
  left.section = support::section(0.1, 1.0, 0.4);
  left.elongation = mode.elongation;
  left.senses.gravity = 0.1;
  left.senses.point_source = 0.2;
  left.senses.softening_length = 0.2;
  left.bending.proprioception.intrinsic_length = 0.05;
  left.source = OrganSource{1.0, 1.0};
  OrganScenario right = left;
  right.id = "right";
  right.base.position = {0.8, 0.3, 0.0};
  right.base.frame = rod::exp(Vector3(0.2, -0.1, 0.3));
  scenario.organs.push_back(right);
  return scenario;
}

/// Both after growth by `duration`.
std::vector<rod::Rod> grown(const Mode& mode, int steps, double duration) {
  Simulation simulation(pair(mode, duration / steps));
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.ok) << report.message;
  }
  return {simulation.organs()[0].rod(), simulation.organs()[1].rod()};
}

double distance(const std::vector<rod::Rod>& a, const std::vector<rod::Rod>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t v = 0; v < a[i].vertices.size(); ++v) {
      sum += (a[i].vertices[v].position - b[i].vertices[v].position).norm();
    }
  }
  return sum / static_cast<double>(a.size() * a[0].vertices.size());
}

class EveryMethod : public testing::TestWithParam<std::tuple<RelaxationMethod, bool, bool>> {
 protected:
  const Mode mode_{std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam())};
};

class Equilibrium : public EveryMethod {};    ///< continuous motion has a time scale of its own
class HeavyInMotion : public EveryMethod {};  ///< and so comparable with the statics

TEST_P(EveryMethod, LengthsGrowOnlyWithElongation) {
  constexpr double duration = 0.2;
  for (const rod::Rod& rod : grown(mode_, 4, duration)) {
    EXPECT_NEAR(rod.restLength(), mode_.elongation ? std::exp(duration) : 1.0, 1e-12);
  }
}

TEST_P(Equilibrium, ConvergesWithItsOrder) {
  constexpr double duration = 0.4;
  const auto coarse = grown(mode_, 4, duration), middle = grown(mode_, 8, duration), fine = grown(mode_, 16, duration);
  const double order = std::log2(distance(coarse, middle) / distance(middle, fine));
  EXPECT_NEAR(order, mode_.second_order ? 2.0 : 1.0, 0.2);
}

TEST_P(HeavyInMotion, AgreesWithTheStatics) {
  constexpr double duration = 0.1;
  Mode statics = mode_;
  statics.relaxation = RelaxationMethod::statics;
  const auto expected = grown(statics, 4, duration), actual = grown(mode_, 4, duration);
  // Motion lags behind by what an organ grows while it swings: 0.002 per second of motion.
  EXPECT_LT(distance(actual, expected), mode_.relaxation == RelaxationMethod::continuous ? 2e-3 : 1e-7);
}

std::string nameOf(const testing::TestParamInfo<std::tuple<RelaxationMethod, bool, bool>>& info) {
  const char* const methods[] = {"static", "dynamic", "continuous", "kinematic"};
  return std::string(methods[static_cast<int>(std::get<0>(info.param))]) +
         (std::get<1>(info.param) ? "" : "_without_elongation") + (std::get<2>(info.param) ? "" : "_of_first_order");
}

constexpr auto statics = RelaxationMethod::statics, dynamics = RelaxationMethod::dynamics,
               continuous = RelaxationMethod::continuous, kinematics = RelaxationMethod::kinematics;

INSTANTIATE_TEST_SUITE_P(All, EveryMethod,
                         testing::Combine(testing::Values(statics, dynamics, continuous, kinematics), testing::Bool(),
                                          testing::Bool()),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(All, Equilibrium,
                         testing::Combine(testing::Values(statics, dynamics, kinematics), testing::Bool(),
                                          testing::Bool()),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(All, HeavyInMotion,
                         testing::Combine(testing::Values(dynamics, continuous), testing::Bool(), testing::Bool()),
                         nameOf);

}  // namespace
}  // namespace sensory_growth::simulation
