// The markers of every shipped scenario, as it starts and as it grows, please rviz.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "ros/marker_lint.h"
#include "sensory_growth/ros/markers.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node {
namespace {

constexpr int kSteps = 3;

void expectClean(const std::string& file) {
  simulation::Simulation simulation(simulation::loadScenario(file));
  const SnapshotPtr first = takeSnapshot(simulation, ros::Time(1), 0);
  std::vector<std::pair<MarkerSettings, MarkerStream>> streams;
  for (const MarkerField field : {MarkerField::curvature, MarkerField::growth_rate, MarkerField::stress,
                                  MarkerField::stretch, MarkerField::age, MarkerField::none}) {
    for (const MarkerShape shape : {MarkerShape::tube, MarkerShape::line}) {
      Parameters parameters;
      parameters.marker_color = field;
      parameters.marker_style = shape;
      streams.emplace_back(makeMarkerSettings(parameters, *first), MarkerStream());
    }
  }
  for (int step = 0; step <= kSteps; ++step) {
    const SnapshotPtr snapshot = takeSnapshot(simulation, ros::Time(1 + step), 0);
    for (auto& [settings, stream] : streams) {
      EXPECT_THAT(testing::lint(stream.next(*snapshot, settings)), ::testing::IsEmpty());
    }
    const simulation::StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

TEST(ShippedDisplays, AreFixedToTheWorld) {
  int displays = 0;
  for (const auto& entry : std::filesystem::directory_iterator("../rviz")) {
    std::ifstream file(entry.path());
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_NE(text.find("\n    Fixed Frame: " + Parameters().world_frame + "\n"), std::string::npos) << entry.path();
    ++displays;
  }
  EXPECT_EQ(displays, 2);
}

TEST(ShippedScenarios, HaveMarkersThatPleaseRviz) {
  int scenarios = 0;
  for (const auto& entry : std::filesystem::directory_iterator("../config")) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path().filename());
    expectClean(entry.path());
    ++scenarios;
  }
  EXPECT_GE(scenarios, 20);
}

}  // namespace
}  // namespace sensory_growth::node
