#include "sensory_growth/ros/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "sensory_growth/ros/live_parameters.h"

namespace sensory_growth::node {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using XmlRpc::XmlRpcValue;

XmlRpcValue minimal() {
  XmlRpcValue tree;
  tree["scenario"] = "/some/where.yaml";
  tree["growth_time_scale"] = 60;
  return tree;
}

TEST(Parameters, TakesWhatIsGivenAndKeepsDefaults) {
  XmlRpcValue tree = minimal();
  tree["real_time_factor"] = 2.5;
  tree["marker_style"] = "line";
  tree["start_paused"] = true;
  const ParameterReading reading = readParameters(tree);
  EXPECT_THAT(reading.problems, IsEmpty());
  EXPECT_EQ(reading.parameters.scenario, "/some/where.yaml");
  EXPECT_EQ(reading.parameters.growth_time_scale, 60.0);
  EXPECT_EQ(reading.parameters.real_time_factor, 2.5);
  EXPECT_EQ(reading.parameters.marker_style, MarkerShape::line);
  EXPECT_TRUE(reading.parameters.start_paused);
  EXPECT_EQ(reading.parameters.world_frame, "world");
}

TEST(Parameters, ListsEverythingThatIsMissing) {
  XmlRpcValue empty;
  empty.begin();
  EXPECT_THAT(readParameters(empty).problems, ElementsAre("~scenario is required and was not given",
                                                          "~growth_time_scale is required and was not given"));
}

TEST(Parameters, ListsAllProblemsAtOnce) {
  XmlRpcValue tree = minimal();
  tree["start_paused"] = 1;
  tree["marker_rate"] = 0.0;
  tree["marker_colour"] = "curvature";
  EXPECT_THAT(
      readParameters(tree).problems,
      ElementsAre("~start_paused is 1; it must be true or false", "~marker_rate is 0; it must be from 0.1 to 100",
                  "~marker_colour is not a parameter of this node; did you mean ~marker_color?"));
}

struct BadCase {
  const char* key;
  XmlRpcValue value;
  const char* message;
};

class BadParameter : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadParameter, IsRefusedByName) {
  XmlRpcValue tree = minimal();
  tree[GetParam().key] = GetParam().value;
  const ParameterReading reading = readParameters(tree);
  ASSERT_THAT(reading.problems, SizeIs(1));
  EXPECT_THAT(reading.problems.front(), HasSubstr(std::string("~") + GetParam().key + " "));
  EXPECT_THAT(reading.problems.front(), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadParameter,
    ::testing::Values(
        BadCase{"scenario", 3, "must be text"}, BadCase{"scenario", "", "is empty"},
        BadCase{"growth_time_scale", "fast", "must be a number"}, BadCase{"growth_time_scale", 0, "must be from 1e-09"},
        BadCase{"growth_time_scale", std::numeric_limits<double>::quiet_NaN(), "is nan; it must be finite"},
        BadCase{"real_time_factor", std::numeric_limits<double>::infinity(), "is inf; it must be finite"},
        BadCase{"real_time_factor", -1.0, "must be from 0"}, BadCase{"real_time_factor", 1e-9, "is below 1e-6"},
        BadCase{"stations", 101, "must be from 0 to 100"}, BadCase{"stations", 2.5, "must be a whole number"},
        BadCase{"clock_mode", "sundial", "must be one of publish, wall"},
        BadCase{"clock_mode", "follow", "publish, wall"},
        BadCase{"marker_color", 7, "must be one of curvature, growth_rate, stretch, none"},
        BadCase{"world_frame", "/map", "must not begin with a slash"}, BadCase{"world_frame", "", "is empty"},
        BadCase{"recording_compression", "zip", "must be one of none, lz4, bz2"}),
    [](const auto& tested) { return std::string(tested.param.key) + "_" + std::to_string(tested.index); });

TEST(Parameters, RecordingNeedsADirectory) {
  XmlRpcValue tree = minimal();
  tree["record"] = true;
  EXPECT_THAT(readParameters(tree).problems, ElementsAre("~recording_directory is required because ~record is true"));
}

TEST(Parameters, AreWrittenToTheLastDigit) {
  Parameters parameters;
  parameters.scenario = "it's here.yaml";
  parameters.growth_time_scale = 0.1;
  const std::string yaml = toYaml(parameters);
  EXPECT_THAT(yaml, HasSubstr("scenario: 'it''s here.yaml'\n"));
  EXPECT_THAT(yaml, HasSubstr("growth_time_scale: 0.10000000000000001\n"));
  EXPECT_THAT(yaml, HasSubstr("clock_mode: publish\n"));
  EXPECT_THAT(yaml, HasSubstr("record: false\n"));
}

Parameters atStart() { return readParameters(minimal()).parameters; }

TEST(LiveParameters, ChangeTogetherOrNotAtAll) {
  XmlRpcValue changes;
  changes["marker_rate"] = 5;
  changes["marker_style"] = "line";
  changes["progress"] = true;
  const ParameterReading changed = changeParameters(atStart(), changes);
  EXPECT_THAT(changed.problems, IsEmpty());
  EXPECT_EQ(changed.parameters.marker_rate, 5.0);
  EXPECT_EQ(changed.parameters.marker_style, MarkerShape::line);
  EXPECT_TRUE(changed.parameters.progress);
  EXPECT_EQ(changed.parameters.scenario, "/some/where.yaml");

  changes["marker_color"] = "red";
  const ParameterReading refused = changeParameters(atStart(), changes);
  EXPECT_THAT(refused.problems, SizeIs(1));
  EXPECT_EQ(toYaml(refused.parameters), toYaml(atStart()));
}

TEST(LiveParameters, RefuseWhatCannotChange) {
  XmlRpcValue changes;
  changes["threads"] = 2;
  changes["scenario"] = "/some/where/else.yaml";
  changes["marker_rate"] = 1000.0;
  changes["marker_rat"] = 10.0;
  changes["real_time_factor"] = 1e-9;
  EXPECT_THAT(changeParameters(atStart(), changes).problems,
              ElementsAre("~scenario cannot change while the node runs; start it again",
                          "~threads cannot change while the node runs; start it again",
                          "~marker_rate is 1000; it must be from 0.1 to 100",
                          "~real_time_factor is below 1e-6 but not 0; at 0 the simulation runs as fast as it can",
                          "~marker_rat is not a parameter of this node; did you mean ~marker_rate?"));
}

TEST(LiveParameters, ListNamesValuesAndLimits) {
  std::vector<std::string> names;
  for (const LiveParameter& parameter : liveParameters(atStart())) names.push_back(parameter.name);
  EXPECT_THAT(names, ElementsAre("real_time_factor", "progress", "marker_rate", "marker_style", "marker_color",
                                 "marker_color_limit", "marker_radius_scale", "marker_lamp_diameter"));
  LiveParameter rate = liveParameters(atStart())[2];
  EXPECT_EQ(static_cast<double&>(rate.value), 20.0);
  EXPECT_EQ(static_cast<double&>(rate.lowest), 0.1);
  EXPECT_EQ(static_cast<double&>(rate.highest), 100.0);
  EXPECT_THAT(liveParameters(atStart())[3].choices, ElementsAre("tube", "line"));
}

TEST(LiveParameters, SurviveTheirMessage) {
  Parameters parameters = atStart();
  parameters.marker_rate = 7.0;
  parameters.marker_style = MarkerShape::line;
  parameters.progress = true;
  const ParameterReading again = changeParameters(atStart(), toTree(toConfig(parameters)));
  EXPECT_THAT(again.problems, IsEmpty());
  EXPECT_EQ(toYaml(again.parameters), toYaml(parameters));
}

}  // namespace
}  // namespace sensory_growth::node
