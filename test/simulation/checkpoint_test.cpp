// A simulation that goes on from a checkpoint is the one that never stopped, bit for bit; and bytes that are no
// checkpoint are refused with the reason.

#include "sensory_growth/simulation/checkpoint.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sensory_growth/simulation/checksum.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"
#include "support/random_runs.h"
#include "support/scenario_texts.h"

namespace sensory_growth::simulation {
namespace {

using testing::HasSubstr;

/// By way of bytes, as a new process would go on.
Simulation resumed(const Simulation& simulation, int threads = 1) {
  const Checkpoint checkpoint = decode(encode({"test", "", "", simulation.state()}));
  return Simulation(simulation.scenario(), checkpoint.state, threads);
}

std::string bytesOf(const Simulation& simulation) { return encode({"", "", "", simulation.state()}); }

/// Expects both to take the same steps, faults included, and to carry the same state.
void expectSameSteps(Simulation& one, Simulation& other, int steps) {
  ASSERT_EQ(checksum(one), checksum(other));
  for (int i = 0; i < steps; ++i) {
    const StepReport report = one.step();
    ASSERT_EQ(report.message, other.step().message) << "step " << one.stepIndex();
    ASSERT_EQ(checksum(one), checksum(other)) << "step " << one.stepIndex();
    if (!report.ok) break;
  }
  EXPECT_TRUE(bytesOf(one) == bytesOf(other));
}

/// 2 n steps are n, a checkpoint and n.
void expectToGoOn(Simulation simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
  Simulation other = resumed(simulation);
  EXPECT_TRUE(bytesOf(other) == bytesOf(simulation));
  EXPECT_EQ(other.stepIndex(), simulation.stepIndex());
  EXPECT_EQ(other.time(), simulation.time());
  expectSameSteps(simulation, other, steps);
}

TEST(Checkpoint, GoesOnInEveryShippedScenario) {
  int scenarios = 0;
  for (const auto& entry : std::filesystem::directory_iterator("../config")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path());
    Scenario scenario = loadScenario(entry.path());
    // Motion takes long.
    const bool moves = scenario.relaxation == RelaxationMethod::dynamics;
    expectToGoOn(Simulation(scenario), moves ? 3 : 12);
    ++scenarios;
  }
  EXPECT_GE(scenarios, 24);
}

TEST(Checkpoint, GoesOnInRandomScenarios) {
  const struct {
    const char* method;
    unsigned runs;
    int steps;
  } cases[] = {{"static", 40, 10}, {"kinematic", 20, 10}, {"continuous", 8, 6}, {"dynamic", 3, 2}};
  for (const auto& [method, runs, steps] : cases) {
    for (unsigned seed = 1; seed <= runs; ++seed) {
      const std::string text = support::randomScenario(seed, 2 * steps, method);
      SCOPED_TRACE(text);
      try {
        expectToGoOn(Simulation(parseScenario(text, "random")), steps);
      } catch (const std::invalid_argument&) {
        // No equilibrium to start from.
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(Checkpoint, KeepsWhatWasChangedBeforeAndTakesWhatIsChangedAfter) {
  Simulation simulation(loadScenario("data/ros/shoot.yaml"), 1);
  const auto disturb = [](Simulation& shoot, double strength) {
    for (const Command& command :
         {Command(
              StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.1, 0.02, 0.1}, strength}),
          Command(
              StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {1.0, 2.0, 0.3}, strength}),
          Command(ParameterCommand{"shoot", "growth.rate", 1e-4 * strength}),
          Command(ParameterCommand{"all", "sensitivities.gravity", 0.3 * strength}),
          Command(GravityCommand{{strength, 0.0, -9.0}})}) {
      EXPECT_EQ(shoot.apply(command).refusal, "");
    }
  };
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  disturb(simulation, 0.7);
  Simulation at_once = resumed(simulation);  // the weight has changed and the organ has not yet relaxed under it
  ASSERT_TRUE(simulation.step().ok);
  ASSERT_TRUE(at_once.step().ok);
  Simulation later = resumed(simulation, 2);
  for (Simulation* shoot : {&simulation, &at_once, &later}) disturb(*shoot, 0.4);
  Simulation again = resumed(simulation);
  expectSameSteps(at_once, later, 10);
  expectSameSteps(simulation, again, 10);
  EXPECT_EQ(checksum(at_once), checksum(simulation));
}

TEST(Checkpoint, ResetsToTheStartOfTheScenario) {
  const Scenario scenario = loadScenario("../config/turned_pot.yaml");
  Simulation fresh(scenario), grown(scenario);
  for (int i = 0; i < 5; ++i) grown.step();
  Simulation other = resumed(grown);
  other.reset();
  expectSameSteps(fresh, other, 5);
}

TEST(Checkpoint, OfAFaultIsTheLastGoodState) {
  Scenario scenario = loadScenario("data/ros/shoot.yaml");
  scenario.stepping.limits.smallest_part = 1.0;
  scenario.stepping.limits.growth_strain = 1e-4;
  Simulation simulation(scenario);
  ASSERT_FALSE(simulation.step().ok);
  ASSERT_FALSE(simulation.step().ok);
  Simulation other = resumed(simulation);
  EXPECT_TRUE(other.organs().front().report().ok());
  expectSameSteps(simulation, other, 1);
}

TEST(Checkpoint, TakesTheStimuliOfAnother) {
  const Scenario scenario = loadScenario("data/ros/shoot.yaml");
  Simulation simulation(scenario);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(simulation.step().ok);
  Simulation other = resumed(simulation);
  simulation.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.1, 0.0, 0.1}, 1.0});
  simulation.apply(GravityCommand{{1.0, 0.0, -9.0}});
  other.takeStimuliOf(simulation);
  expectSameSteps(simulation, other, 5);
}

class Bytes : public testing::Test {
 protected:
  void SetUp() override {
    const std::string text = support::contentOf("../config/late_coleoptiles.yaml");  // with memories of all kinds
    scenario_ = parseScenario(text, "test");
    Simulation simulation(scenario_);
    simulation.apply(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 0.0, 1.0}, 1.0});
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(simulation.step().ok);
    bytes_ = encode({"0.1.0", text, "", simulation.state()});
    std::uint64_t size = 0;
    header_ = bytes_.size();
    for (std::size_t begin = 8; header_ == bytes_.size() && begin < 64; ++begin) {
      std::memcpy(&size, bytes_.data() + begin, sizeof size);
      if (size > 1000 && bytes_.size() - size < 64 && bytes_.size() > size) header_ = bytes_.size() - size;
    }
    ASSERT_LT(header_, 64u);
  }

  static std::string refusal(const std::string& bytes) {
    try {
      decode(bytes);
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "";
  }

  /// Makes the checksum right again, as somebody could who knows the format.
  std::string sealed(std::string bytes) const {
    const std::uint64_t sum = XXH3_64bits(bytes.data() + header_, bytes.size() - header_);
    std::memcpy(bytes.data() + header_ - sizeof sum, &sum, sizeof sum);
    return bytes;
  }

  Scenario scenario_;
  std::string bytes_;
  std::size_t header_ = 0;  ///< bytes before the content
};

TEST_F(Bytes, HoldTheTextsAndTheState) {
  const Checkpoint checkpoint = decode(bytes_);
  EXPECT_EQ(checkpoint.version, "0.1.0");
  EXPECT_EQ(checkpoint.scenario, support::contentOf("../config/late_coleoptiles.yaml"));
  EXPECT_EQ(checkpoint.protocol, "");
  EXPECT_TRUE(encode(checkpoint) == bytes_);
  EXPECT_TRUE(sealed(bytes_) == bytes_);
}

TEST_F(Bytes, ThatAreSomethingElseAreRefused) {
  for (const std::string& other : {std::string(), std::string("\x89SGC"), std::string("#ROSBAG V2.0\n"),
                                   std::string(1000, '\0'), scenario_.description}) {
    EXPECT_EQ(refusal(other), "is no checkpoint");
  }
}

TEST_F(Bytes, ThatAreCutOffAnywhereAreRefused) {
  for (std::size_t size = 0; size < bytes_.size(); size += size < 4096 ? 1 : 61) {
    ASSERT_NE(refusal(bytes_.substr(0, size)), "") << size;
  }
  EXPECT_THAT(refusal(bytes_.substr(0, bytes_.size() - 1)), HasSubstr("cut off"));
  EXPECT_THAT(refusal(bytes_.substr(0, 12)), HasSubstr("cut off"));
  EXPECT_THAT(refusal(bytes_ + "x"), HasSubstr("added to"));
}

TEST_F(Bytes, WithAnyBitChangedAreRefused) {
  std::mt19937 random(5);
  const auto flip = [&](std::size_t at, int bit) {
    std::string altered = bytes_;
    altered[at] = static_cast<char>(altered[at] ^ (1 << bit));
    ASSERT_NE(refusal(altered), "") << "bit " << bit << " of byte " << at;
  };
  for (std::size_t at = 0; at < header_; ++at) {
    for (int bit = 0; bit < 8; ++bit) flip(at, bit);
  }
  for (int i = 0; i < 2000; ++i) {
    flip(std::uniform_int_distribution<std::size_t>(0, bytes_.size() - 1)(random), static_cast<int>(random() % 8));
  }
  std::string altered = bytes_;
  altered.back() ^= 1;
  EXPECT_EQ(refusal(altered), "was altered: its checksum is another");
}

TEST_F(Bytes, OfANewerFormatAreRefused) {
  std::string newer = bytes_;
  newer[9] = 2;  // after the mark and the byte order
  EXPECT_EQ(refusal(newer), "has format 2; this version of sensory_growth reads 1, a newer one is needed");
}

TEST_F(Bytes, ThatSomebodyForgedAreRefusedOrSound) {
  std::mt19937 random(7);
  int refused = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    std::string forged = bytes_;
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = std::uniform_int_distribution<std::size_t>(header_, bytes_.size() - 1)(random);
      forged[at] = static_cast<char>(random() % 4 == 0 ? 0xff : random());
    }
    try {
      Simulation simulation(scenario_, decode(sealed(forged)).state);
      simulation.step();
      for (const Organ& organ : simulation.organs()) ASSERT_TRUE(support::isSound(organ));
    } catch (const CheckpointError&) {
      ++refused;
    } catch (const std::invalid_argument& fault) {
      ++refused;
      EXPECT_STRNE(fault.what(), "");
    }
  }
  EXPECT_GT(refused, kTrials / 100);
  EXPECT_LT(refused, kTrials);
}

/// Each change makes a state that the scenario cannot lead to.
TEST_F(Bytes, OfStatesThatCannotBeAreRefusedByName) {
  const struct {
    const char* message;
    std::function<void(SimulationState&)> change;
  } cases[] = {
      {"beyond all that can be counted", [](SimulationState& s) { s.step_index = ~std::uint64_t{0}; }},
      {"not finite", [](SimulationState& s) { s.gravity.x() = NAN; }},
      {"organ 'other': comes from nowhere", [](SimulationState& s) { s.organs[1].id = "other"; }},
      {"comes from nowhere, or twice", [](SimulationState& s) { s.organs[1].id = s.organs[0].id; }},
      {"base: is missing",
       [](SimulationState& s) {
         s.births.push_back({"other", "id: other", {0.0, 0.0, 0.0}});
       }},
      {"stimulus 'lamp': strength", [](SimulationState& s) { s.point_sources[0].strength = 1e9; }},
      {"moves on its own", [](SimulationState& s) { s.point_sources[0].velocity.x() = 1.0; }},
      {"more than 256 stimuli", [](SimulationState& s) { s.point_sources.resize(257, s.point_sources[0]); }},
      {"element 2 is none", [](SimulationState& s) { s.organs[0].moment.rod.elements[2].rest_length = -1.0; }},
      {"element 2 is none", [](SimulationState& s) { s.organs[0].moment.rod.elements[2].frame.w() += 0.1; }},
      {"bend 1 is none", [](SimulationState& s) { s.organs[0].moment.rod.bends[1].curvature.x() = NAN; }},
      {"vertex 4 is none", [](SimulationState& s) { s.organs[0].moment.rod.vertices[4].label = 0.0; }},
      {"belong together", [](SimulationState& s) { s.organs[0].moment.rod.bends.pop_back(); }},
      {"held in another way",
       [](SimulationState& s) { s.organs[0].moment.rod.base_support = rod::BaseSupport::hinged; }},
      {"the report is not", [](SimulationState& s) { s.organs[0].moment.report.fault = OrganFault::relaxation; }},
      {"parameters are those of another organ", [](SimulationState& s) { s.organs[0].parameters.pop_back(); }},
      {"is no parameter", [](SimulationState& s) { s.organs[0].parameters[0].name = "nonsense"; }},
      {"out of range", [](SimulationState& s) { s.organs[0].parameters.back().value = -1.0; }},
      {"memories instead of", [](SimulationState& s) { s.organs[0].memories.clear(); }},
      {"what is yet to come", [](SimulationState& s) { s.organs[0].memories[0].back().time *= 2.0; }},
      {"sample 1 of a memory", [](SimulationState& s) { s.organs[0].memories[0][1].sensed.pop_back(); }},
      {"that of another organ", [](SimulationState& s) { s.organs[0].memories[0][1].labels.front() = 0.5; }},
      {"velocities", [](SimulationState& s) { s.source_velocities.emplace_back(); }},
  };
  for (const auto& [message, change] : cases) {
    SCOPED_TRACE(message);
    SimulationState state = decode(bytes_).state;
    change(state);
    try {
      const Simulation simulation(scenario_, state);
      ADD_FAILURE() << "was taken";
    } catch (const std::invalid_argument& fault) {
      EXPECT_THAT(fault.what(), HasSubstr(message));
    }
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
