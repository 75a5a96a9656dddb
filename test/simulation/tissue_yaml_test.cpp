// Tissue in scenario files: growth profiles, stress coupling, aging.

#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::simulation {
namespace {

using testing::HasSubstr;

const std::string kFile = "data/scenarios/good/tissue.yaml";

TEST(TissueYaml, ArrivesInSi) {
  const Scenario s = loadScenario(kFile);
  EXPECT_EQ(s.stepping.limits.growth_stress, 0.25);
  ASSERT_EQ(s.organs.size(), 2u);

  const OrganScenario& gaussian = s.organs[0];
  EXPECT_DOUBLE_EQ(std::get<growth::ApicalGaussianProfile>(gaussian.profile).rate, 1e-4);
  EXPECT_DOUBLE_EQ(std::get<growth::ApicalGaussianProfile>(gaussian.profile).zone_length, 5e-3);
  ASSERT_TRUE(gaussian.stress_coupling);
  EXPECT_DOUBLE_EQ(gaussian.stress_coupling->yield_margin, 3e5);
  EXPECT_EQ(gaussian.stress_coupling->largest_factor, 3.0);
  EXPECT_EQ(gaussian.stress_coupling->sign, -1.0);
  ASSERT_TRUE(gaussian.aging && gaussian.aging->young_modulus && gaussian.aging->radius);
  EXPECT_EQ(gaussian.aging->clock, growth::AgingClock::maturation);
  EXPECT_DOUBLE_EQ(gaussian.aging->young_modulus->mature, 1e9);
  EXPECT_DOUBLE_EQ(gaussian.aging->young_modulus->time, 72000.0);
  EXPECT_DOUBLE_EQ(gaussian.aging->radius->mature, 2e-3);
  EXPECT_DOUBLE_EQ(gaussian.aging->radius->time, 172800.0);

  const OrganScenario& sampled = s.organs[1];
  const auto& profile = std::get<growth::SampledProfile>(sampled.profile);
  EXPECT_DOUBLE_EQ(profile.rateAt(0.0), 1e-4);
  EXPECT_DOUBLE_EQ(profile.rateAt(1e-3), 2e-4);
  EXPECT_DOUBLE_EQ(profile.rateAt(2.5e-3), 1e-4);
  EXPECT_EQ(profile.rateAt(1.0), 0.0);
  EXPECT_EQ(sampled.stress_coupling->largest_factor, std::numeric_limits<double>::infinity());
  EXPECT_EQ(sampled.stress_coupling->sign, 1.0);
  EXPECT_EQ(sampled.aging->clock, growth::AgingClock::time);
  EXPECT_FALSE(sampled.aging->young_modulus);
}

TEST(TissueYaml, IsPlainByDefault) {
  const Scenario s = loadScenario("data/scenarios/good/least_keys.yaml");
  EXPECT_EQ(s.stepping.limits.growth_stress, 0.5);
  EXPECT_FALSE(s.organs[0].stress_coupling);
  EXPECT_FALSE(s.organs[0].aging);
}

struct Spoilt {
  const char* piece;
  const char* replacement;
  const char* problem;  ///< key and the beginning of the message
};

void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.replacement; }

class SpoiltTissue : public testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltTissue, IsRefusedWithKeyAndReason) {
  std::ostringstream text;
  text << std::ifstream(kFile).rdbuf();
  std::string yaml = text.str();
  const std::size_t at = yaml.find(GetParam().piece);
  ASSERT_NE(at, std::string::npos);
  yaml.replace(at, std::string(GetParam().piece).size(), GetParam().replacement);
  try {
    parseScenario(yaml, "test");
    FAIL() << "nothing is wrong with it";
  } catch (const ScenarioError& error) {
    ASSERT_EQ(error.problems().size(), 1u) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(GetParam().problem));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Keys, SpoiltTissue,
    testing::Values(
        Spoilt{"growth_stress: 0.25", "growth_stress: 0",
               "stepping.limits.growth_stress: '0' is out of range; must be > 0 or inf"},
        Spoilt{"yield_margin: 300 kPa", "yield_margin: 300 mm",
               "organs[0].growth.stress_coupling.yield_margin: '300 mm' is a length; give a stress such as '0.3 MPa'"},
        Spoilt{"yield_margin: 300 kPa", "yield_margin: 0 Pa", "yield_margin: '0 Pa' is out of range; must be > 0 Pa"},
        Spoilt{"yield_margin: 300 kPa, ", "", "stress_coupling.yield_margin: is missing; give a stress"},
        Spoilt{"largest_factor: 3", "largest_factor: 0.5",
               "largest_factor: '0.5' is out of range; must be >= 1 or inf"},
        Spoilt{"lockhart_sign: -1", "lockhart_sign: 0", "lockhart_sign: '0' is not known; give '1' or '-1'"},
        Spoilt{"density: 1000 kg/m^3", "density: 1000 kg/m^3, inextensible: true",
               "organs[0].growth.stress_coupling: needs tissue that stretches under stress"},
        Spoilt{"clock: maturation", "clock: sun",
               "organs[0].aging.clock: 'sun' is not known; give 'maturation' or 'time'"},
        Spoilt{"mature_modulus: 1 GPa", "mature_modulus: 0 GPa",
               "aging.stiffening.mature_modulus: '0 GPa' is out of range"},
        Spoilt{"time: 20 h", "time: -20 h", "aging.stiffening.time: '-20 h' is out of range; must be > 0 s"},
        Spoilt{"mature_radius: 2 mm", "mature_radius: 0 mm", "aging.thickening.mature_radius: '0 mm' is out of range"},
        Spoilt{", thickening: {mature_radius: 0.8 mm, time: 1 h}", "",
               "organs[1].aging.stiffening: is missing, and so is 'thickening'; give one of them or leave 'aging' out"},
        Spoilt{"distances: [0 mm, 1 mm, 4 mm]", "distances: 1 mm",
               "organs[1].growth.distances: is '1 mm'; give a sequence, each a length such as '0.8 mm'"},
        Spoilt{"distances: [0 mm, 1 mm, 4 mm]", "distances: []", "organs[1].growth.distances: is empty; give"},
        Spoilt{"[0 mm, 1 mm, 4 mm]", "[0 mm, 1, 4 mm]",
               "organs[1].growth.distances[1]: '1' has no unit; give a length"},
        Spoilt{"[0 mm, 1 mm, 4 mm]", "[0 mm, [1 mm], 4 mm]",
               "organs[1].growth.distances[1]: is a sequence; give a length"},
        Spoilt{"[0 mm, 1 mm, 4 mm]", "[0.5 mm, 1 mm, 4 mm]",
               "organs[1].growth.distances: distance 1 is 0.0005 m; distances begin with 0 and increase"},
        Spoilt{"[0 mm, 1 mm, 4 mm]", "[0 mm, 4 mm, 1 mm]",
               "organs[1].growth.distances: distance 3 is 0.001 m; distances begin with 0 and increase"},
        Spoilt{"[0 mm, 1 mm, 4 mm]", "[0 mm, 4 mm]",
               "organs[1].growth.distances: 2 distances with 3 rates; give as many"},
        Spoilt{"0.72 1/h", "-0.72 1/h", "organs[1].growth.rates[1]: '-0.72 1/h' is out of range; must be >= 0 1/s"}));

TEST(TissueYaml, KinematicOrgansRefuseWhatTheyWouldIgnore) {
  std::ostringstream text;
  text << std::ifstream(kFile).rdbuf();
  std::string yaml = text.str() + "relaxation: {method: kinematic}\n";
  try {
    parseScenario(yaml, "test");
    FAIL() << "nothing is wrong with it";
  } catch (const ScenarioError& error) {
    EXPECT_EQ(error.problems().size(), 3u) << error.what();
    EXPECT_THAT(error.what(), HasSubstr("organs[0].growth.stress_coupling: has no effect with kinematic relaxation"));
    EXPECT_THAT(error.what(), HasSubstr("organs[0].aging.stiffening: has no effect with kinematic relaxation"));
    EXPECT_THAT(error.what(), HasSubstr("organs[1].growth.stress_coupling: has no effect with kinematic relaxation"));
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
