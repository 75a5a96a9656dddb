#include "sensory_growth/ros/loaded_scenario.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::node {
namespace {

constexpr double kLongestStep = 1.0;      // of ROS time [s]; tf and timers cannot use a coarser clock (ros.md 33)
constexpr double kShortestStep = 1.0e-6;  // [s]; stamps count nanoseconds

std::string readFile(const std::string& path, const std::string& parameter, std::vector<std::string>& problems) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.good() && !file.eof()) problems.push_back("~" + parameter + " is '" + path + "', which cannot be read");
  return text;
}

/// Runs `read` and keeps what it throws as a problem.
template <typename Read>
void collect(std::vector<std::string>& problems, const Read& read) {
  try {
    read();
  } catch (const std::exception& error) {
    problems.push_back(error.what());
  }
}

void checkStep(const Parameters& parameters, const simulation::Scenario& scenario, std::vector<std::string>& problems) {
  if (parameters.growth_time_scale <= 0.0) return;  // reported already
  const double step = scenario.stepping.step / parameters.growth_time_scale;
  if (step <= kLongestStep && step >= kShortestStep) return;
  std::ostringstream text;
  text << "~growth_time_scale is " << parameters.growth_time_scale << ", so a step of " << scenario.stepping.step
       << " s of growth takes " << step << " s of ROS time; it must be from " << kShortestStep << " to " << kLongestStep
       << " s, which asks for a scale from " << scenario.stepping.step / kLongestStep << " to "
       << scenario.stepping.step / kShortestStep;
  problems.push_back(text.str());
}

}  // namespace

LoadedScenario loadScenario(const Parameters& parameters, const std::string& node, std::vector<std::string>& problems) {
  Sources sources;
  sources.node = node;
  const std::size_t problems_before = problems.size();
  sources.scenario = readFile(parameters.scenario, "scenario", problems);
  if (!parameters.protocol.empty()) sources.protocol = readFile(parameters.protocol, "protocol", problems);
  if (problems.size() > problems_before) return {};
  return parseScenario(parameters, std::move(sources), problems);
}

LoadedScenario parseScenario(const Parameters& parameters, Sources sources, std::vector<std::string>& problems) {
  LoadedScenario loaded;
  collect(problems, [&] {
    loaded.scenario = simulation::parseScenario(sources.scenario, parameters.scenario);
    checkStep(parameters, loaded.scenario, problems);
  });
  collect(problems, [&] {
    if (parameters.protocol.empty()) return;
    auto& protocol = loaded.scenario.protocol;
    for (auto& command : simulation::parseProtocol(sources.protocol, parameters.protocol)) {
      protocol.push_back(std::move(command));
    }
    std::stable_sort(protocol.begin(), protocol.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  });
  loaded.sources = std::move(sources);
  loaded.sources.scenario_name = loaded.scenario.name;
  loaded.sources.parameters = describeEffective(parameters, loaded.sources.node);
  for (const simulation::OrganScenario& organ : loaded.scenario.organs) loaded.sources.organs.push_back(organ.id);
  return loaded;
}

std::string describeEffective(const Parameters& parameters, const std::string& node) {
  return "node: " + node + "\nversion: " + version() + "\n" + toYaml(parameters);
}

const char* version() { return SENSORY_GROWTH_VERSION; }

}  // namespace sensory_growth::node
