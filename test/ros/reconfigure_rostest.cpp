/// Parameters that change while the node runs, by the protocol of dynamic_reconfigure.

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <std_msgs/String.h>
#include <unistd.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>
#include <visualization_msgs/MarkerArray.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <string>

#include "ros/child_process.h"
#include "ros/message_log.h"
#include "ros/node_under_test.h"
#include "sensory_growth/SetRealTimeFactor.h"

namespace sensory_growth::node::testing {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::Reconfigure;
using ::testing::HasSubstr;
using visualization_msgs::Marker;

double number(const Config& config, const std::string& name) {
  for (const auto& parameter : config.doubles) {
    if (parameter.name == name) return parameter.value;
  }
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

std::string word(const Config& config, const std::string& name) {
  for (const auto& parameter : config.strs) {
    if (parameter.name == name) return parameter.value;
  }
  ADD_FAILURE() << "no " << name;
  return "";
}

class LiveParameters : public ::testing::Test {
 protected:
  /// Each test begins with the parameters of the launch file.
  LiveParameters() {
    set("real_time_factor", 20.0);
    set("marker_rate", 20.0);
    set("marker_style", std::string("tube"));
  }

  Config send(const Config& config) {
    Reconfigure::Request request;
    request.config = config;
    return node_.call<Reconfigure>("set_parameters", request).config;
  }

  Config set(const std::string& name, double value) {
    Config config;
    auto& parameter = config.doubles.emplace_back();
    parameter.name = name;
    parameter.value = value;
    return send(config);
  }

  Config set(const std::string& name, const std::string& value) {
    Config config;
    auto& parameter = config.strs.emplace_back();
    parameter.name = name;
    parameter.value = value;
    return send(config);
  }

  /// Waits until the parameters that the node tells are so.
  void expectTold(const std::string& name, const std::string& value) {
    told_.waitFor(name + ": " + value, [&](const std_msgs::String& message) {
      return YAML::Load(message.data)[name].as<std::string>() == value;
    });
  }

  NodeUnderTest node_;
  MessageLog<std_msgs::String> told_{"/sensory_growth/parameters"};
  MessageLog<Config> updates_{"/sensory_growth/parameter_updates"};
};

TEST_F(LiveParameters, AreInEffectWhenTheServiceAnswersAndAreTold) {
  EXPECT_EQ(number(set("marker_rate", 50.0), "marker_rate"), 50.0);
  expectTold("marker_rate", "50");
  updates_.waitFor("update", [](const Config& config) { return number(config, "marker_rate") == 50.0; });
}

TEST_F(LiveParameters, ThatAreRefusedComeBackUnchanged) {
  EXPECT_EQ(number(set("marker_rate", 1000.0), "marker_rate"), 20.0);
  EXPECT_EQ(number(set("real_time_factor", -1.0), "real_time_factor"), 20.0);
  EXPECT_EQ(number(set("marker_rate", std::nan("")), "marker_rate"), 20.0);
  EXPECT_EQ(word(set("marker_style", std::string("cube")), "marker_style"), "tube");
  for (const char* fixed : {"growth_time_scale", "clock_rate", "no_parameter"}) {
    const Config answer = set(fixed, 1.0);
    for (const auto& parameter : answer.doubles) EXPECT_NE(parameter.name, fixed);
  }
  Config half_good;  // then nothing changes
  half_good.doubles.resize(2);
  half_good.doubles[0].name = "marker_rate";
  half_good.doubles[0].value = 30.0;
  half_good.doubles[1].name = "clock_rate";
  EXPECT_EQ(number(send(half_good), "marker_rate"), 20.0);
}

TEST_F(LiveParameters, OfTheRealTimeFactorFollowTheService) {
  set("real_time_factor", 7.0);
  node_.waitForStatus("the factor", [](const Status& s) { return s.real_time_factor == 7.0; });
  SetRealTimeFactor::Request request;
  request.factor = 9.0;
  ASSERT_TRUE(node_.call<SetRealTimeFactor>("set_real_time_factor", request).success);
  node_.waitForStatus("the factor", [](const Status& s) { return s.real_time_factor == 9.0; });
  expectTold("real_time_factor", "9");
  updates_.waitFor("update", [](const Config& config) { return number(config, "real_time_factor") == 9.0; });
}

TEST_F(LiveParameters, OfMarkersAreSeenWhilePaused) {
  MessageLog<visualization_msgs::MarkerArray> markers("/sensory_growth/markers");
  const auto bodyIs = [](int type) {
    return [type](const visualization_msgs::MarkerArray& array) {
      for (const Marker& marker : array.markers) {
        if (marker.ns == "shoot/body" && marker.type == type) return true;
      }
      return false;
    };
  };
  markers.waitFor("tube", bodyIs(Marker::TRIANGLE_LIST));
  set("marker_style", std::string("line"));
  markers.waitFor("line", bodyIs(Marker::LINE_STRIP));
}

TEST_F(LiveParameters, OfLampsResizeTheirHandles) {
  MessageLog<visualization_msgs::InteractiveMarkerUpdate> updates("/sensory_growth/stimulus_handles/update");
  updates.connect([] {});  // the heartbeat
  const auto diameterFor = [&](double lamp_diameter) {
    updates.forget();
    set("marker_lamp_diameter", lamp_diameter);
    const auto drawn =
        updates.waitFor("a handle drawn anew", [](const auto& update) { return !update.markers.empty(); });
    for (const auto& control : drawn.markers.at(0).controls) {
      for (const Marker& marker : control.markers) {
        if (marker.type == Marker::SPHERE) return marker.scale.x;
      }
    }
    return 0.0;
  };
  EXPECT_DOUBLE_EQ(diameterFor(0.02), 0.02);  // of the handle that adds lamps
  EXPECT_DOUBLE_EQ(diameterFor(0.04), 0.04);
}

TEST_F(LiveParameters, AreDescribedWithTheirLimits) {
  MessageLog<dynamic_reconfigure::ConfigDescription> heard("/sensory_growth/parameter_descriptions");
  const auto description = heard.waitFor("description", [](const auto&) { return true; });
  std::map<std::string, std::string> types;
  for (const auto& parameter : description.groups.at(0).parameters) types[parameter.name] = parameter.type;
  EXPECT_EQ(types, (std::map<std::string, std::string>{{"real_time_factor", "double"},
                                                       {"progress", "bool"},
                                                       {"marker_rate", "double"},
                                                       {"marker_style", "str"},
                                                       {"marker_color", "str"},
                                                       {"marker_color_limit", "double"},
                                                       {"marker_radius_scale", "double"},
                                                       {"marker_lamp_diameter", "double"}}));
  EXPECT_EQ(number(description.min, "marker_rate"), 0.1);
  EXPECT_EQ(number(description.max, "marker_rate"), 100.0);
}

TEST_F(LiveParameters, TakeWhatDynparamSends) {
  const auto dynparam = [](const std::string& arguments) {
    ChildProcess child({"/bin/sh", "-c", "exec rosrun dynamic_reconfigure dynparam " + arguments},
                       "dynparam_" + std::to_string(getpid()) + ".txt");
    const int code = child.waitForExit(std::chrono::seconds(120));
    return std::to_string(code) + ": " + child.printed();
  };
  EXPECT_THAT(dynparam("set /sensory_growth '{marker_rate: 12.5, marker_style: line}'"), HasSubstr("0: "));
  expectTold("marker_rate", "12.5");
  expectTold("marker_style", "line");
  EXPECT_THAT(dynparam("set /sensory_growth threads 2"), HasSubstr("know parameter: threads"));
}

}  // namespace
}  // namespace sensory_growth::node::testing
