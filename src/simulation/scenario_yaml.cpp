#include "sensory_growth/simulation/scenario_yaml.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "loads_yaml.h"
#include "protocol_yaml.h"
#include "senses_yaml.h"
#include "sensing_yaml.h"
#include "sensory_growth/simulation/yaml_reader.h"
#include "tissue_yaml.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

void readLimits(YamlReader& in, StepLimits& limits) {
  const Range limit = above(0).orInfinity();
  limits.tip_advance = in.number("tip_advance", limit, limits.tip_advance);
  limits.growth_strain = in.number("growth_strain", limit, limits.growth_strain);
  limits.growth_stress = in.number("growth_stress", limit, limits.growth_stress);
  limits.bend_angle = in.quantity("bend_angle", dimension::angle, limit, limits.bend_angle);
  limits.total_angle = in.quantity("total_angle", dimension::angle, limit, limits.total_angle);
  limits.oscillation = in.number("oscillation", limit, limits.oscillation);
  limits.smallest_part = in.number("smallest_part", above(0).upTo(1), limits.smallest_part);
}

void readStepping(YamlReader& in, Stepping& stepping) {
  stepping.step = in.quantity("step", dimension::time, above(0));
  stepping.second_order = in.flag("second_order", stepping.second_order);
  in.section("limits", kOptional, [&](YamlReader& limits) { readLimits(limits, stepping.limits); });
}

void readStatics(YamlReader& in, mechanics::RelaxationSettings& settings) {
  settings.tolerance = in.number("tolerance", above(0).below(1), settings.tolerance);
  settings.max_iterations = in.count("max_iterations", 1, 1000000, settings.max_iterations);
  settings.max_branch_switches = in.count("max_branch_switches", 0, 1000, settings.max_branch_switches);
  settings.max_rotation = in.quantity("max_rotation", dimension::angle, above(0).upTo(M_PI), settings.max_rotation);
  settings.max_bend_angle =
      in.quantity("max_bend_angle", dimension::angle, above(0).below(M_PI), settings.max_bend_angle);
}

void readDynamics(YamlReader& in, mechanics::DynamicsSettings& settings) {
  if (in.has("damping")) settings.damping = in.quantity("damping", dimension::rate, atLeast(0));
  settings.time_step = in.number("time_step", above(0).upTo(1), settings.time_step);
  settings.ramp_periods = in.number("ramp_periods", atLeast(0), settings.ramp_periods);
  settings.max_periods = in.number("max_periods", above(0).upTo(10000), settings.max_periods);
  settings.max_bend_angle =
      in.quantity("max_bend_angle", dimension::angle, above(0).upTo(2.0), settings.max_bend_angle);
  settings.dilatation = in.flag("dilatation", settings.dilatation);
  const auto stopping =
      in.choice<mechanics::StoppingRule>("stopping",
                                         {{"residual", mechanics::StoppingRule::residual},
                                          {"rotational_energy", mechanics::StoppingRule::rotational_energy}},
                                         settings.stopping);
  if (!stopping) return in.ignoreOtherKeys();
  settings.stopping = *stopping;
  if (stopping == mechanics::StoppingRule::residual) {
    settings.tolerance = in.number("tolerance", above(0).below(1), settings.tolerance);
  } else {
    settings.rest_energy = in.quantity("rest_energy", dimension::energy, above(0), settings.rest_energy);
    settings.rest_steps = in.count("rest_steps", 1, 1000000000, settings.rest_steps);
  }
}

void readRelaxation(YamlReader& in, Scenario& scenario) {
  const auto method = in.choice<RelaxationMethod>("method",
                                                  {{"static", RelaxationMethod::statics},
                                                   {"dynamic", RelaxationMethod::dynamics},
                                                   {"continuous", RelaxationMethod::continuous},
                                                   {"kinematic", RelaxationMethod::kinematics}},
                                                  scenario.relaxation);
  if (!method) return in.ignoreOtherKeys();
  scenario.relaxation = *method;
  switch (*method) {
    case RelaxationMethod::statics:
      return readStatics(in, scenario.relaxation_settings);
    case RelaxationMethod::dynamics:
      return readDynamics(in, scenario.dynamics_settings);
    case RelaxationMethod::continuous:
      scenario.growth_per_second = in.quantity("growth_per_second", dimension::time, above(0));
      return readDynamics(in, scenario.dynamics_settings);
    case RelaxationMethod::kinematics:
      return;
  }
}

/// An organ that the others sense.
OrganSource readSource(YamlReader& in) {
  OrganSource source;
  source.label = in.number("label", atLeast(0).upTo(1));
  source.strength = in.number("strength", anyNumber);
  return source;
}

OrganScenario readOrgan(YamlReader& in, RelaxationMethod relaxation, YamlReader::Lines& ids) {
  OrganScenario organ;
  organ.id = in.uniqueIdentifier("id", ids);
  if (organ.id == kAllOrgans) in.addProblem("id", "'all' means every organ in commands; give another id");
  in.section("base", kRequired, [&](YamlReader& base) { readBase(base, relaxation, organ); });
  organ.length = in.quantity("length", dimension::length, above(0));
  organ.elements = static_cast<std::size_t>(in.count("elements", 1, kMostElements));
  organ.section.radius = in.quantity("radius", dimension::length, above(0));
  in.section("material", kRequired, [&](YamlReader& material) { readMaterial(material, relaxation, organ.section); });
  in.section("growth", kRequired, [&](YamlReader& growth) { readGrowth(growth, relaxation, organ); });
  in.section("aging", kOptional, [&](YamlReader& aging) { organ.aging = readAging(aging, relaxation); });
  readSenses(in, organ);
  organ.sensing = readSensing(in);
  in.section("division", kRequired, [&](YamlReader& division) { readDivision(division, relaxation, organ); });
  in.section("source", kOptional, [&](YamlReader& source) { organ.source = readSource(source); });
  readLoads(in, relaxation, organ);
  organ.rest_curvature = in.vector("rest_curvature", dimension::curvature, organ.rest_curvature);
  return organ;
}

Scenario readScenario(YamlReader& in) {
  Scenario scenario;
  scenario.name = in.identifier("name");
  scenario.description = in.text("description", "");
  in.section("gravity", kRequired, [&](YamlReader& gravity) { scenario.gravity = readGravity(gravity); });
  scenario.weight = in.flag("weight");
  scenario.duration = in.quantity("duration", dimension::time, atLeast(0), scenario.duration);
  in.section("stepping", kRequired, [&](YamlReader& stepping) { readStepping(stepping, scenario.stepping); });
  in.section("relaxation", kOptional, [&](YamlReader& relaxation) { readRelaxation(relaxation, scenario); });
  if (scenario.relaxation == RelaxationMethod::kinematics && scenario.weight) {
    in.addProblem("weight", "'true' has no effect with kinematic relaxation; give false");
  }
  YamlReader::Lines ids;
  in.list("organs", kRequired,
          [&](YamlReader& organ) { scenario.organs.push_back(readOrgan(organ, scenario.relaxation, ids)); });
  KnownWorld world{{}, scenario.organs, Schedule(scenario.stepping.step), scenario.stepping.step};
  readProtocol(in, scenario.protocol, &world);
  return scenario;
}

std::vector<TimedCommand> readProtocolAlone(YamlReader& in) {
  std::vector<TimedCommand> protocol;
  in.identifier("name");
  in.text("description", "");
  if (!in.has("stimuli") && !in.has("protocol")) in.addProblem("protocol", "is missing; give a sequence of mappings");
  readProtocol(in, protocol, nullptr);
  return protocol;
}

template <typename Read>
auto parse(const std::string& yaml, const std::string& source, const Read& read) {
  std::vector<Problem> problems;
  decltype(read(std::declval<YamlReader&>())) content;
  readYaml(yaml, problems, [&](YamlReader& in) { content = read(in); });
  if (!problems.empty()) throw ScenarioError(source, std::move(problems));
  return content;
}

std::string readText(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  in.peek();  // a directory opens, but cannot be read
  if (!in.is_open() || in.bad()) {
    throw ScenarioError(file, {{"", 0, std::string("cannot be read: ") + std::strerror(errno)}});
  }
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

Scenario loadScenario(const std::string& file) { return parseScenario(readText(file), file); }

Scenario parseScenario(const std::string& yaml, const std::string& source) { return parse(yaml, source, readScenario); }

OrganScenario parseOrgan(const std::string& yaml, const std::string& source, RelaxationMethod relaxation) {
  if (yaml.size() > kLongestOrganText) {
    throw ScenarioError(source, {{"", 0, "is longer than " + std::to_string(kLongestOrganText) + " bytes"}});
  }
  return parse(yaml, source, [relaxation](YamlReader& in) {
    YamlReader::Lines ids;
    return readOrgan(in, relaxation, ids);
  });
}

std::vector<TimedCommand> loadProtocol(const std::string& file) { return parseProtocol(readText(file), file); }

std::vector<TimedCommand> parseProtocol(const std::string& yaml, const std::string& source) {
  return parse(yaml, source, readProtocolAlone);
}

}  // namespace sensory_growth::simulation
