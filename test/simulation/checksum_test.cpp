#include "sensory_growth/simulation/checksum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::simulation {
namespace {

double nextAfter(double value) { return std::nextafter(value, std::numeric_limits<double>::infinity()); }

/// The smallest change there is.
void nudge(double& value) { value = nextAfter(value); }
void nudge(rod::Vector3& value) { nudge(value.z()); }
void nudge(rod::Quaternion& value) { nudge(value.w()); }

rod::Rod twoElements() {
  rod::Section section;
  section.radius = 1e-3;
  section.young_modulus = 1e7;
  section.shear_modulus = 3e6;
  section.density = 1000.0;
  return rod::straightRod({}, 0.02, 2, section);
}

std::uint64_t sumOf(const rod::Rod& rod) {
  Checksum sum;
  sum.add(rod);
  return sum.value();
}

std::uint64_t sumOf(const growth::Environment& environment) {
  Checksum sum;
  sum.add(environment);
  return sum.value();
}

TEST(Checksum, IsXxh3) {
  // The value that the specification of XXH3 gives for no bytes and seed 0.
  EXPECT_EQ(Checksum().value(), 0x2d06800538d394c2u);
}

TEST(Checksum, TellsWhereATextEnds) {
  Checksum ab_c, a_bc;
  ab_c.add("ab");
  ab_c.add("c");
  a_bc.add("a");
  a_bc.add("bc");
  EXPECT_NE(ab_c.value(), a_bc.value());
}

TEST(Checksum, CountsTheLastBitOfEveryFieldOfARod) {
  const std::vector<std::function<void(rod::Rod&)>> changes = {
      [](rod::Rod& r) { nudge(r.base.position); },
      [](rod::Rod& r) { nudge(r.base.frame); },
      [](rod::Rod& r) { r.base_support = rod::BaseSupport::hinged; },
      [](rod::Rod& r) { nudge(r.elements[1].rest_length); },
      [](rod::Rod& r) { nudge(r.elements[1].reference_length); },
      [](rod::Rod& r) { nudge(r.elements[1].section.radius); },
      [](rod::Rod& r) { nudge(r.elements[1].section.young_modulus); },
      [](rod::Rod& r) { nudge(r.elements[1].section.shear_modulus); },
      [](rod::Rod& r) { nudge(r.elements[1].section.density); },
      [](rod::Rod& r) { nudge(r.elements[1].section.shear_correction); },
      [](rod::Rod& r) { r.elements[1].section.inextensible = true; },
      [](rod::Rod& r) { nudge(r.elements[1].age); },
      [](rod::Rod& r) { nudge(r.elements[1].strain); },
      [](rod::Rod& r) { nudge(r.elements[1].rest_strain); },
      [](rod::Rod& r) { nudge(r.elements[1].frame); },
      [](rod::Rod& r) { nudge(r.elements[1].angular_velocity); },
      [](rod::Rod& r) { nudge(r.bends[1].curvature); },
      [](rod::Rod& r) { nudge(r.bends[1].rest_curvature); },
      [](rod::Rod& r) { nudge(r.vertices[2].position); },
      [](rod::Rod& r) { nudge(r.vertices[2].label); },
      [](rod::Rod& r) { nudge(r.vertices[2].velocity); },
  };
  const rod::Rod rod = twoElements();
  EXPECT_EQ(sumOf(rod), sumOf(twoElements()));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    rod::Rod changed = rod;
    changes[i](changed);
    EXPECT_NE(sumOf(changed), sumOf(rod)) << "change " << i;
  }
}

TEST(Checksum, CountsTheLastBitOfEverythingThatIsSensed) {
  const std::vector<std::function<void(growth::Environment&)>> changes = {
      [](growth::Environment& e) { nudge(e.time); },
      [](growth::Environment& e) { nudge(e.down); },
      [](growth::Environment& e) { e.point_sources[0].id = "lamq"; },
      [](growth::Environment& e) { nudge(e.point_sources[0].position); },
      [](growth::Environment& e) { nudge(e.point_sources[0].strength); },
      [](growth::Environment& e) { nudge(e.point_sources[0].velocity); },
      [](growth::Environment& e) { e.light_directions[0].id = "sum"; },
      [](growth::Environment& e) { nudge(e.light_directions[0].towards); },
      [](growth::Environment& e) { nudge(e.light_directions[0].strength); },
      [](growth::Environment& e) { e.light_directions.pop_back(); },
  };
  growth::Environment environment;
  environment.point_sources = {{"lamp", {1.0, 2.0, 3.0}, 1.0, {}}};
  environment.light_directions = {{"sun", {1.0, 0.0, 0.0}, 1.0}};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    growth::Environment changed = environment;
    changes[i](changed);
    EXPECT_NE(sumOf(changed), sumOf(environment)) << "change " << i;
  }
}

class ChecksumOfSimulation : public ::testing::Test {
 protected:
  static std::uint64_t sumAfter(const std::vector<Command>& commands, int steps = 0, int threads = 1) {
    Simulation simulation(loadScenario("data/ros/shoot.yaml"), threads);
    for (const Command& command : commands) EXPECT_EQ(simulation.apply(command).refusal, "");
    for (int i = 0; i < steps; ++i) EXPECT_TRUE(simulation.step().ok);
    return checksum(simulation);
  }
};

TEST_F(ChecksumOfSimulation, CountsTheLastBitOfACommandAtOnce) {
  const auto lamp = [](double strength) {
    return StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 0.0, 0.0}, strength};
  };
  const auto rate = [](double value) { return ParameterCommand{"shoot", "growth.rate", value}; };
  const auto sensitivity = [](double value) { return ParameterCommand{"shoot", "sensitivities.gravity", value}; };
  const auto gravity = [](double z) { return GravityCommand{{0.0, 0.0, z}}; };
  EXPECT_EQ(sumAfter({lamp(0.5)}), sumAfter({lamp(0.5)}));
  EXPECT_NE(sumAfter({lamp(0.5)}), sumAfter({lamp(nextAfter(0.5))}));
  EXPECT_NE(sumAfter({rate(1e-5)}), sumAfter({rate(nextAfter(1e-5))}));
  EXPECT_NE(sumAfter({sensitivity(0.3)}), sumAfter({sensitivity(nextAfter(0.3))}));
  EXPECT_NE(sumAfter({gravity(-5.0)}), sumAfter({gravity(nextAfter(-5.0))}));
}

TEST_F(ChecksumOfSimulation, IsThatOfTheStepAndNotOfTheThreads) {
  EXPECT_NE(sumAfter({}, 3), sumAfter({}, 4));
  EXPECT_EQ(sumAfter({}, 4, 1), sumAfter({}, 4, 3));
}

}  // namespace
}  // namespace sensory_growth::simulation
