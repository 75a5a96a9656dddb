#include "sensory_growth/ros/live_parameters.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/console.h>

#include <utility>

#include "sensory_growth/ros/names.h"
#include "serve.h"

namespace sensory_growth::node {
namespace {

using dynamic_reconfigure::Config;
using XmlRpc::XmlRpcValue;

constexpr char kGroup[] = "Default";  // the only one, as the protocol calls it

void append(const std::string& name, XmlRpcValue value, Config& config) {
  if (value.getType() == XmlRpcValue::TypeBoolean) {
    auto& parameter = config.bools.emplace_back();
    parameter.name = name;
    parameter.value = static_cast<bool&>(value);
  } else if (value.getType() == XmlRpcValue::TypeDouble) {
    auto& parameter = config.doubles.emplace_back();
    parameter.name = name;
    parameter.value = static_cast<double&>(value);
  } else {
    auto& parameter = config.strs.emplace_back();
    parameter.name = name;
    parameter.value = static_cast<std::string&>(value);
  }
}

/// A config whose one group is on.
Config emptyConfig() {
  Config config;
  auto& group = config.groups.emplace_back();
  group.name = kGroup;
  group.state = true;
  return config;
}

const char* typeOf(const LiveParameter& parameter) {
  switch (parameter.value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return "bool";
    case XmlRpcValue::TypeDouble:
      return "double";
    default:
      return "str";
  }
}

/// What graphical clients make a list of: a dictionary in the notation of Python.
std::string editMethod(const LiveParameter& parameter) {
  if (parameter.choices.empty()) return "";
  std::string text;
  for (const std::string& choice : parameter.choices) {
    text += (text.empty() ? "" : ", ") + std::string("{'name': '") + choice + "', 'value': '" + choice +
            "', 'type': 'str', 'description': ''}";
  }
  return "{'enum_description': '" + parameter.name + "', 'enum': [" + text + "]}";
}

}  // namespace

Config toConfig(const Parameters& parameters) {
  Config config = emptyConfig();
  for (const LiveParameter& parameter : liveParameters(parameters)) append(parameter.name, parameter.value, config);
  return config;
}

dynamic_reconfigure::ConfigDescription describeLive(const Parameters& parameters) {
  dynamic_reconfigure::ConfigDescription description;
  description.dflt = toConfig(parameters);
  description.min = description.max = emptyConfig();
  auto& group = description.groups.emplace_back();
  group.name = kGroup;
  for (const LiveParameter& parameter : liveParameters(parameters)) {
    append(parameter.name, parameter.lowest, description.min);
    append(parameter.name, parameter.highest, description.max);
    auto& one = group.parameters.emplace_back();
    one.name = parameter.name;
    one.type = typeOf(parameter);
    one.edit_method = editMethod(parameter);
  }
  return description;
}

XmlRpcValue toTree(const Config& config) {
  XmlRpcValue tree;
  tree.begin();  // makes it an empty struct
  for (const auto& parameter : config.bools) tree[parameter.name] = XmlRpcValue(static_cast<bool>(parameter.value));
  for (const auto& parameter : config.ints) tree[parameter.name] = XmlRpcValue(parameter.value);
  for (const auto& parameter : config.doubles) tree[parameter.name] = XmlRpcValue(parameter.value);
  for (const auto& parameter : config.strs) tree[parameter.name] = XmlRpcValue(parameter.value);
  return tree;
}

LiveParameters::LiveParameters(const Parameters& parameters, ros::NodeHandle private_node, ros::CallbackQueue& queue,
                               Use use)
    : use_(std::move(use)), parameters_(parameters) {
  using Description = dynamic_reconfigure::ConfigDescription;
  descriptions_ = private_node.advertise<Description>(names::kParameterDescriptions, 1, true);
  updates_ = private_node.advertise<Config>(names::kParameterUpdates, 1, true);
  descriptions_.publish(describeLive(parameters));
  updates_.publish(toConfig(parameters));
  service_ = serve<dynamic_reconfigure::Reconfigure>(private_node, names::kSetParameters, queue,
                                                     [this](auto& request, auto& response) {
                                                       change(toTree(request.config));
                                                       response.config = toConfig(now());
                                                     });
}

std::vector<std::string> LiveParameters::change(const XmlRpcValue& changes) {
  const Parameters before = now();
  const ParameterReading reading = changeParameters(before, changes);
  if (!reading.problems.empty()) {
    for (const std::string& problem : reading.problems) ROS_WARN_STREAM_NAMED(names::kLogRos, "refused: " << problem);
    return reading.problems;
  }
  use_(before, reading.parameters);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    parameters_ = reading.parameters;
  }
  updates_.publish(toConfig(reading.parameters));
  return {};
}

Parameters LiveParameters::now() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return parameters_;
}

}  // namespace sensory_growth::node
