// Routes of perception in scenario files: what arrives, and what is refused.

#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_error.h"
#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::simulation {
namespace {

using growth::Coordinate;
using growth::Cue;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kFile = "data/scenarios/good/sensing.yaml";

std::vector<growth::Route> routes() { return loadScenario(kFile).organs.at(0).sensing; }

TEST(SensingYaml, SensorsAndCuesArrive) {
  const std::vector<growth::Route> r = routes();
  ASSERT_EQ(r.size(), 6u);
  EXPECT_THAT(r[0].cues, ElementsAre(Cue::light_direction, Cue::point_source));
  EXPECT_THAT(r[4].cues, ElementsAre(Cue::gravity));
  const struct {
    Coordinate coordinate;
    double at;
  } sensors[] = {{Coordinate::distance_from_apex, 0.0},
                 {Coordinate::distance_from_apex, 3e-3},
                 {Coordinate::distance_from_base, 4e-3},
                 {Coordinate::label, 0.75}};
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(r[i].sensor.has_value()) << i;
    EXPECT_EQ(r[i].sensor->coordinate, sensors[i].coordinate) << i;
    EXPECT_DOUBLE_EQ(r[i].sensor->at, sensors[i].at) << i;
  }
  EXPECT_FALSE(r[4].sensor.has_value());
}

TEST(SensingYaml, MemoriesArriveInSi) {
  const std::vector<growth::Route> r = routes();
  EXPECT_DOUBLE_EQ(std::get<growth::Delay>(r[0].memory).time, 780.0);
  EXPECT_EQ(r[0].before_start, growth::BeforeStart::constant);
  const auto& exponential = std::get<growth::LinearOde>(r[1].memory);
  EXPECT_EQ(exponential.delay, 0.0);
  EXPECT_DOUBLE_EQ(exponential.time_constant, 300.0);
  EXPECT_THAT(exponential.coefficients, ElementsAre(1.0));
  EXPECT_EQ(r[1].before_start, growth::BeforeStart::zero);
  const auto& ode = std::get<growth::LinearOde>(r[2].memory);
  EXPECT_DOUBLE_EQ(ode.delay, 120.0);
  EXPECT_DOUBLE_EQ(ode.time_constant, 360.0);
  EXPECT_THAT(ode.coefficients, ElementsAre(1.9, 1.0));
  const auto& sampled = std::get<growth::SampledKernel>(r[3].memory);
  EXPECT_THAT(sampled.times, ElementsAre(0.0, 60.0, 180.0));
  EXPECT_THAT(sampled.densities, testing::Pointwise(testing::DoubleEq(), {0.0, 1.0 / 60.0, 0.0}));
  EXPECT_EQ(std::get<growth::Delay>(r[4].memory).time, 0.0);  // none is given: at once
}

TEST(SensingYaml, ReceiversAndSpreadsArriveInSi) {
  const std::vector<growth::Route> r = routes();
  EXPECT_EQ(r[0].receivers.coordinate, Coordinate::distance_from_apex);
  EXPECT_THAT(r[0].receivers.at, ElementsAre(2e-3, 1e-2));
  EXPECT_THAT(r[0].receivers.weights, ElementsAre(1.0, 0.5));
  EXPECT_EQ(r[1].receivers.coordinate, Coordinate::distance_from_base);
  EXPECT_THAT(r[1].receivers.weights, ElementsAre(-2.0));
  EXPECT_EQ(r[2].receivers.coordinate, Coordinate::label);
  EXPECT_THAT(r[2].receivers.at, ElementsAre(0.0, 0.5, 1.0));
  EXPECT_TRUE(r[3].receivers.at.empty());
  const auto& fading = std::get<growth::FadingSpread>(r[4].spread.value());
  EXPECT_EQ(fading.direction, growth::FadingSpread::Direction::acropetal);
  EXPECT_DOUBLE_EQ(fading.length, 6e-3);
  const auto& sampled = std::get<growth::SampledSpread>(r[5].spread.value());
  EXPECT_THAT(sampled.labels, ElementsAre(0.0, 1.0));
  Eigen::Matrix2d densities;
  densities << 1.0, 2.0, 30.0, 4.0;
  EXPECT_LT((sampled.densities - densities).norm(), 1e-13);
}

/// A piece of the file is replaced; one problem is expected.
struct Spoilt {
  const char* piece;
  const char* replacement;
  const char* message;  ///< with the key
};

void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.replacement; }

class SpoiltSensing : public testing::TestWithParam<Spoilt> {};

TEST_P(SpoiltSensing, IsRefusedWithKeyAndReason) {
  std::ifstream in(kFile);
  std::ostringstream content;
  content << in.rdbuf();
  std::string yaml = content.str();
  const std::string piece = GetParam().piece;
  const std::size_t at = yaml.find(piece);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(yaml.find(piece, at + 1), std::string::npos) << "the piece is not unique";
  try {
    parseScenario(yaml.replace(at, piece.size(), GetParam().replacement), "test");
    FAIL() << "is accepted";
  } catch (const ScenarioError& error) {
    ASSERT_EQ(error.problems().size(), 1u) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, SpoiltSensing,
    testing::Values(
        Spoilt{"[light_direction, point_source]", "[light_direction, sound]",
               "organs[0].sensing[0].cues[1]: is 'sound'; give one or more of 'gravity', 'light_direction', "
               "'point_source' and 'oscillator', each once"},
        Spoilt{"[light_direction, point_source]", "[gravity, gravity]", "sensing[0].cues[1]: is 'gravity' again; give"},
        Spoilt{"[light_direction, point_source]", "[]", "sensing[0].cues: is empty; give one or more"},
        Spoilt{"[light_direction, point_source]", "light_direction", "sensing[0].cues: is 'light_direction'; give one"},
        Spoilt{"{at: apex}", "{at: tip}", "sensing[0].sensor.at: 'tip' is not known; give 'local', 'apex', "},
        Spoilt{"{at: apex}", "{at: apex, distance: 1 mm}", "sensing[0].sensor.distance: is an unknown key"},
        Spoilt{"distance: 3 mm", "distance: -3 mm",
               "sensing[1].sensor.distance: '-3 mm' is out of range; must be >= 0 m"},
        Spoilt{"label: 0.75", "label: 1.01", "sensing[3].sensor.label: '1.01' is out of range; must be >= 0 and <= 1"},
        Spoilt{"delay: 13 min", "delay: 0 min", "sensing[0].memory.delay: '0 min' is out of range; must be > 0 s"},
        Spoilt{"delay: 13 min", "delay: 13", "sensing[0].memory.delay: '13' has no unit; give a time"},
        Spoilt{"13 min, before_start: constant", "13 min, before_start: never",
               "memory.before_start: 'never' is not known"},
        Spoilt{"13 min, before_start: constant", "13 min", "sensing[0].memory.before_start: is missing"},
        Spoilt{"kernel: linear_ode", "kernel: fuzzy", "sensing[2].memory.kernel: 'fuzzy' is not known; give 'delay', "},
        Spoilt{"[1.9, 1]", "[1, 1, 1, 1]",
               "sensing[2].memory.coefficients: describe a system that does not come to rest"},
        Spoilt{"[1.9, 1]", "[1.9, 0]", "sensing[2].memory.coefficients[1]: '0' is out of range; must be > 0"},
        Spoilt{"[1.9, 1]", "[1, 1, 1, 1, 1, 1, 1, 1, 1]", "sensing[2].memory.coefficients: must be 1 to 8"},
        Spoilt{"time_constant: 6 min", "time_constant: 1 us",
               "time_constant: '1 us' is out of range; must be >= 0.001 s"},
        Spoilt{"times: [0 s, 1 min, 3 min]", "times: [0 s, 3 min, 1 min]", "sensing[3].memory.times: must rise"},
        Spoilt{"times: [0 s, 1 min, 3 min]", "times: [0 s, 3 min]",
               "sensing[3].memory.densities: must be as many as times"},
        Spoilt{"times: [0 s, 1 min, 3 min]", "times: [0 s, 1, 3 min]", "sensing[3].memory.times[1]: '1' has no unit"},
        Spoilt{"distances: [2 mm, 1 cm]", "distances: [2 mm, 1 mm]", "sensing[0].receivers.distances: must rise"},
        Spoilt{"weights: [1, 0.5]", "weights: [1]", "sensing[0].receivers.weights: must be as many as distances"},
        Spoilt{"weights: [1, 0.5]", "weights: [1, 1 mm]", "sensing[0].receivers.weights[1]: '1 mm' "},
        Spoilt{"weights: [0, 1, 2]", "weights: 1",
               "sensing[2].receivers.weights: is '1'; give a sequence, each a number"},
        Spoilt{"coordinate: label", "coordinate: width", "sensing[2].receivers.coordinate: 'width' is not known"},
        Spoilt{"{at: label, label: 0.75}",
               "{at: label, label: 0.75}\n        spread: {kernel: exponential, direction: both, length: 1 mm}",
               "sensing[3].spread: needs bends that sense for themselves: a local sensor"},
        Spoilt{"direction: acropetal", "direction: sideways", "sensing[4].spread.direction: 'sideways' is not known"},
        Spoilt{"length: 6 mm", "length: 0 mm", "sensing[4].spread.length: '0 mm' is out of range; must be > 0 m"},
        Spoilt{"labels: [0, 1], dens", "labels: [0.1, 1], dens", "sensing[5].spread.labels: must rise from 0 to 1"},
        Spoilt{"[[1 1/m, 2 1/m], ", "[", "sensing[5].spread.densities: must have as many rows and columns"},
        Spoilt{"[[1 1/m, 2 1/m], ", "[[1 1/m], ", "sensing[5].spread.densities: must have as many rows and columns"},
        Spoilt{"[[1 1/m, 2 1/m], ", "[3 1/m, ",
               "sensing[5].spread.densities[0]: is '3 1/m'; give a sequence of rows"}));

}  // namespace
}  // namespace sensory_growth::simulation
