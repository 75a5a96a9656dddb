// Organs that come and go while a simulation runs.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sensory_growth/simulation/checksum.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"
#include "support/random_runs.h"

namespace sensory_growth::simulation {
namespace {

using testing::HasSubstr;

/// An entry of `organs`; the organs attract each other.
std::string organ(const std::string& id, double x, const std::string& more = "") {
  return "id: " + id + "\nbase: {position: [" + std::to_string(x) +
         " m, 0 m, 0 m], direction: [0, 0, 1]}\n"
         "length: 30 mm\nelements: 10\nradius: 0.8 mm\n"
         "material: {young_modulus: 10 MPa, poisson_ratio: 0.5, density: 1000 kg/m^3}\n"
         "growth: {profile: apical_flat, rate: 0.6 1/h, zone_length: 20 mm}\n"
         "sensitivities: {gravity: 0.4, light_direction: 0, point_source: 0.8, softening_length: 1 mm}\n"
         "proprioception: {intrinsic_length: 8 mm}\ndivision: {longest_element: 5 mm}\n" +
         more;
}

const std::string kSource = "source: {label: 1, strength: 1}\n";

std::string indented(const std::string& entry) {
  std::string text = "  - ";
  for (const char c : entry) text += c == '\n' ? "\n    " : std::string(1, c);
  return text.substr(0, text.size() - 4);
}

Scenario scenarioOf(const std::vector<std::string>& organs) {
  std::string text =
      "name: test\ngravity: {direction: [0, 0, -1], acceleration: 9.81 m/s^2}\nweight: true\nstepping: {step: 1 min}\n"
      "organs:\n";
  for (const std::string& organ : organs) text += indented(organ);
  return parseScenario(text, "test");
}

void takeSteps(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

std::uint64_t sumOf(const Organ& organ) {
  Checksum sum;
  sum.add(organ.rod());
  return sum.value();
}

TEST(Spawning, AtTheStartEqualsAnOrganOfTheScenario) {
  const std::string left = organ("left", 0.0, kSource), right = organ("right", 0.02, kSource);
  Simulation spawned(scenarioOf({left})), given(scenarioOf({left, right}));
  EXPECT_EQ(spawned.apply(SpawnCommand{right}).refusal, "");
  EXPECT_EQ(checksum(spawned), checksum(given));
  for (int i = 0; i < 20; ++i) {
    takeSteps(spawned, 1);
    takeSteps(given, 1);
    ASSERT_EQ(checksum(spawned), checksum(given)) << i;
  }
}

TEST(Spawning, LaterEqualsAnOrganThatIsYoungerByThat) {
  const std::string late = organ("late", 0.5);
  Simulation simulation(scenarioOf({organ("first", 0.0)})), alone(scenarioOf({late}));
  takeSteps(simulation, 7);
  EXPECT_EQ(simulation.apply(SpawnCommand{late}).refusal, "");
  EXPECT_EQ(sumOf(simulation.organs()[1]), sumOf(alone.organs()[0]));
  takeSteps(simulation, 12);
  takeSteps(alone, 12);
  EXPECT_EQ(sumOf(simulation.organs()[1]), sumOf(alone.organs()[0]));
}

TEST(Spawning, StandsUnderTheGravityInForce) {
  Scenario turned = scenarioOf({organ("late", 0.0)});
  turned.gravity = {9.81, 0.0, 0.0};
  Simulation simulation(scenarioOf({organ("first", 0.5)})), alone(turned);
  simulation.apply(GravityCommand{turned.gravity});
  EXPECT_EQ(simulation.apply(SpawnCommand{organ("late", 0.0)}).refusal, "");
  EXPECT_EQ(sumOf(simulation.organs()[1]), sumOf(alone.organs()[0]));
}

TEST(Spawning, DoesNotDisturbOthersThatCannotSenseIt) {
  const std::vector<std::string> pair = {organ("left", 0.0, kSource), organ("right", 0.02, kSource)};
  Simulation simulation(scenarioOf(pair)), untouched(scenarioOf(pair));
  for (int i = 0; i < 20; ++i) {
    if (i == 5) {
      EXPECT_EQ(simulation.apply(SpawnCommand{organ("third", 0.04)}).refusal, "");
    }
    if (i == 12) {
      EXPECT_EQ(simulation.apply(RemoveCommand{"third"}).refusal, "");
    }
    takeSteps(simulation, 1);
    takeSteps(untouched, 1);
    for (int k = 0; k < 2; ++k) EXPECT_EQ(sumOf(simulation.organs()[k]), sumOf(untouched.organs()[k])) << i;
  }
  EXPECT_EQ(checksum(simulation), checksum(untouched));
}

TEST(Spawning, ARemovedOrganIsSensedNoMore) {
  const std::string left = organ("left", 0.0, kSource), right = organ("right", 0.02, kSource);
  Simulation simulation(scenarioOf({right, left})), alone(scenarioOf({left})), both(scenarioOf({right, left}));
  EXPECT_EQ(simulation.apply(RemoveCommand{"right"}).refusal, "");
  EXPECT_TRUE(simulation.seenBy(0).point_sources.empty());
  takeSteps(simulation, 10);
  takeSteps(alone, 10);
  takeSteps(both, 10);
  EXPECT_EQ(checksum(simulation), checksum(alone));
  EXPECT_NE(sumOf(both.organs()[1]), sumOf(alone.organs()[0]));
}

TEST(Spawning, ResetGoesBackToTheOrgansOfTheScenario) {
  Simulation simulation(scenarioOf({organ("first", 0.0, kSource)}));
  const std::uint64_t at_start = checksum(simulation);
  simulation.apply(RemoveCommand{"first"});
  EXPECT_TRUE(simulation.organs().empty());
  takeSteps(simulation, 3);
  simulation.apply(SpawnCommand{organ("other", 0.1, kSource)});
  takeSteps(simulation, 3);
  simulation.reset();
  EXPECT_EQ(checksum(simulation), at_start);
}

TEST(Spawning, RefusesWithAReasonAndChangesNothing) {
  Simulation simulation(scenarioOf({organ("first", 0.0)}));
  const std::uint64_t before = checksum(simulation);
  const auto refusal = [&](const Command& command) {
    const std::string refusal = simulation.apply(command).refusal;
    EXPECT_EQ(checksum(simulation), before) << refusal;
    return refusal;
  };
  EXPECT_EQ(refusal(SpawnCommand{organ("first", 0.1)}), "there is an organ 'first' already; give another id");
  EXPECT_EQ(refusal(RemoveCommand{"second"}), "there is no organ 'second'");
  EXPECT_EQ(refusal(RemoveCommand{"all"}), "there is no organ 'all'");
  EXPECT_EQ(refusal(SpawnCommand{""}), "organ: is empty");
  const std::string wrong = refusal(SpawnCommand{organ("Bad id", 0.1, "lenght: 3 mm\n")});
  EXPECT_THAT(wrong, HasSubstr("organ:1: id: 'Bad id'"));
  EXPECT_THAT(wrong, HasSubstr("lenght: is an unknown key; did you mean 'length'?"));
  EXPECT_THAT(refusal(SpawnCommand{organ("all", 0.1)}), HasSubstr("'all' means every organ"));
  EXPECT_THAT(refusal(SpawnCommand{organ("second", 0.1, "tip_force: [0 N, 0 N, -1 kN]\n")}),
              HasSubstr("organ 'second' has no equilibrium to start from"));
  EXPECT_EQ(refusal(SpawnCommand{organ("second", 0.1) + std::string(kLongestOrganText, ' ')}),
            "organ: is longer than 100000 bytes");
  EXPECT_THAT(refusal(SpawnCommand{"a: " + std::string(90000, '[')}), HasSubstr("organ:"));
}

TEST(Spawning, IsBounded) {
  Simulation simulation(scenarioOf({organ("first", 0.0)}));
  for (std::size_t i = 1; i < kMostOrgans; ++i) {
    EXPECT_EQ(simulation.apply(SpawnCommand{organ("organ_" + std::to_string(i), 0.1)}).refusal, "");
  }
  EXPECT_EQ(simulation.apply(SpawnCommand{organ("last", 0.1)}).refusal,
            "there are 256 organs already; remove one first");
  EXPECT_EQ(simulation.apply(RemoveCommand{"organ_9"}).refusal, "");
  EXPECT_EQ(simulation.apply(SpawnCommand{organ("last", 0.1)}).refusal, "");
}

TEST(RandomScenarios, StaySoundAndEqualOnAnyNumberOfThreadsWhileOrgansComeAndGo) {
  const tbb::global_control enough_threads(tbb::global_control::max_allowed_parallelism, 8);
  constexpr int kSteps = 30;
  int changes = 0;
  for (unsigned seed = 1; seed <= 15; ++seed) {
    const std::string text = support::randomScenario(seed, kSteps, "static");
    SCOPED_TRACE(text);
    const auto run = [&](int threads) {
      std::vector<std::uint64_t> sums;
      try {
        Simulation simulation(parseScenario(text, "random"), threads);
        support::Dice dice(seed);
        for (int i = 0; i < kSteps && simulation.step().ok; ++i) {
          changes += support::exchangeOrgan(dice, simulation, i, kSteps);
          for (const Organ& organ : simulation.organs()) EXPECT_TRUE(support::isSound(organ)) << i;
          sums.push_back(checksum(simulation));
        }
      } catch (const std::invalid_argument&) {
        // No equilibrium to start from.
      }
      return sums;
    };
    EXPECT_EQ(run(1), run(3));
  }
  EXPECT_GT(changes, 50);
}

}  // namespace
}  // namespace sensory_growth::simulation
