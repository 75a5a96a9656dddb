#include "sensory_growth/simulation/scenario_yaml.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>
#include <utility>

#include "loads_yaml.h"
#include "sensory_growth/simulation/yaml_reader.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

constexpr auto kRequired = Presence::required;
constexpr auto kOptional = Presence::optional;

constexpr double kPi = 3.14159265358979323846;

/// Where each id was first given, to refuse a second one.
using IdLines = std::map<std::string, int>;

std::string readId(YamlReader& in, IdLines& lines) {
  const std::string id = in.identifier("id");
  const auto [first, is_new] = lines.emplace(id, in.line("id"));
  if (!is_new && !id.empty()) {
    in.addProblem("id", "'" + id + "' is already used on line " + std::to_string(first->second) + "; ids are unique");
  }
  return id;
}

Vector3 readGravity(YamlReader& in) {
  const Vector3 direction = in.direction("direction");
  return in.quantity("acceleration", dimension::acceleration, atLeast(0)) * direction;
}

void readLimits(YamlReader& in, StepLimits& limits) {
  const Range limit = above(0).orInfinity();
  limits.tip_advance = in.number("tip_advance", limit, limits.tip_advance);
  limits.growth_strain = in.number("growth_strain", limit, limits.growth_strain);
  limits.bend_angle = in.quantity("bend_angle", dimension::angle, limit, limits.bend_angle);
  limits.total_angle = in.quantity("total_angle", dimension::angle, limit, limits.total_angle);
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
  settings.max_rotation = in.quantity("max_rotation", dimension::angle, above(0).upTo(kPi), settings.max_rotation);
  settings.max_bend_angle =
      in.quantity("max_bend_angle", dimension::angle, above(0).below(kPi), settings.max_bend_angle);
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

void readMaterial(YamlReader& in, RelaxationMethod relaxation, rod::Section& section) {
  section.young_modulus = in.quantity("young_modulus", dimension::modulus, above(0));
  enum class Given { poisson_ratio, shear_modulus };
  const auto given =
      in.exactlyOneOf<Given>({{"poisson_ratio", Given::poisson_ratio}, {"shear_modulus", Given::shear_modulus}});
  if (given == Given::poisson_ratio) {
    section.shear_modulus = section.young_modulus / (2.0 * (1.0 + in.number("poisson_ratio", above(-1).upTo(0.5))));
  } else if (given == Given::shear_modulus) {
    section.shear_modulus = in.quantity("shear_modulus", dimension::modulus, above(0));
  }
  section.density = in.quantity("density", dimension::density, above(0));
  section.shear_correction = in.number("shear_correction", above(0).upTo(1), section.shear_correction);
  section.inextensible = in.flag("inextensible", section.inextensible);
  const bool in_time = relaxation == RelaxationMethod::dynamics || relaxation == RelaxationMethod::continuous;
  if (section.inextensible && in_time) {
    in.addProblem("inextensible", "'true' needs static relaxation: no time step is short enough for it; give false");
  }
}

double readRate(YamlReader& in) { return in.quantity("rate", dimension::rate, atLeast(0)); }
double readZoneLength(YamlReader& in) { return in.quantity("zone_length", dimension::length, above(0)); }

growth::Profile readLogistic(YamlReader& in) {
  return growth::LogisticProfile{readRate(in), readZoneLength(in), in.number("steepness", above(0))};
}

growth::Profile readUniform(YamlReader& in) { return growth::UniformProfile{readRate(in)}; }

growth::Profile readApicalFlat(YamlReader& in) { return growth::ApicalFlatProfile{readRate(in), readZoneLength(in)}; }

void readGrowth(YamlReader& in, OrganScenario& organ) {
  organ.elongation = in.flag("elongation", organ.elongation);
  using ReadProfile = growth::Profile (*)(YamlReader&);
  const auto read = in.choice<ReadProfile>(
      "profile", {{"logistic", readLogistic}, {"uniform", readUniform}, {"apical_flat", readApicalFlat}});
  if (!read) return in.ignoreOtherKeys();
  organ.profile = (*read)(in);
}

void readSensitivities(YamlReader& in, growth::Senses& senses) {
  senses.gravity = in.number("gravity", anyNumber);
  senses.light_direction = in.number("light_direction", anyNumber);
  senses.point_source = in.number("point_source", anyNumber);
  if (std::abs(senses.point_source) > 0.0 || in.has("softening_length")) {
    senses.softening_length = in.quantity("softening_length", dimension::length, atLeast(0));
  }
}

void readDivision(YamlReader& in, RelaxationMethod relaxation, OrganScenario& organ) {
  organ.longest_element = in.quantity("longest_element", dimension::length, above(0).orInfinity());
  if (organ.length / organ.longest_element > kMostElements) {
    in.addProblem("longest_element", "would divide the organ into more than " + std::to_string(kMostElements) +
                                         " elements; give a longer one");
  }
  const auto mode = in.choice<rod::DivisionMode>(
      "mode", {{"keep_strain", rod::DivisionMode::keep_strain}, {"keep_positions", rod::DivisionMode::keep_positions}},
      organ.division);
  if (!mode) return;
  organ.division = *mode;
  if (mode == rod::DivisionMode::keep_positions && relaxation == RelaxationMethod::kinematics) {
    in.addProblem(
        "mode", "'keep_positions' leaves a strain defect that kinematic relaxation never removes; give 'keep_strain'");
  }
}

OrganScenario readOrgan(YamlReader& in, RelaxationMethod relaxation, IdLines& ids) {
  OrganScenario organ;
  organ.id = readId(in, ids);
  in.section("base", kRequired, [&](YamlReader& base) { readBase(base, relaxation, organ); });
  organ.length = in.quantity("length", dimension::length, above(0));
  organ.elements = static_cast<std::size_t>(in.count("elements", 1, kMostElements));
  organ.section.radius = in.quantity("radius", dimension::length, above(0));
  in.section("material", kRequired, [&](YamlReader& material) { readMaterial(material, relaxation, organ.section); });
  in.section("growth", kRequired, [&](YamlReader& growth) { readGrowth(growth, organ); });
  in.section("sensitivities", kRequired,
             [&](YamlReader& sensitivities) { readSensitivities(sensitivities, organ.senses); });
  organ.bending.proprioception_length = in.quantity("proprioception_length", dimension::length, atLeast(0));
  in.section("division", kRequired, [&](YamlReader& division) { readDivision(division, relaxation, organ); });
  readLoads(in, relaxation, organ);
  organ.rest_curvature = in.vector("rest_curvature", dimension::curvature, organ.rest_curvature);
  return organ;
}

StimulusCommand readStimulus(YamlReader& in, StimulusKind kind, StimulusOperation operation, const std::string& id) {
  StimulusCommand command;
  command.kind = kind;
  command.operation = operation;
  command.id = id;
  if (operation == StimulusOperation::remove) return command;
  const bool is_direction = kind == StimulusKind::light_direction;
  command.vector = is_direction ? in.direction("towards") : in.vector("position", dimension::length);
  command.strength = in.number("strength", anyNumber);
  return command;
}

void readStimuli(YamlReader& in, std::vector<TimedStimulus>& protocol) {
  const auto readList = [&](const std::string& key, StimulusKind kind) {
    IdLines ids;
    in.list(key, kOptional, [&](YamlReader& stimulus) {
      const std::string id = readId(stimulus, ids);
      protocol.push_back({0.0, readStimulus(stimulus, kind, StimulusOperation::add, id)});
    });
  };
  readList("point_sources", StimulusKind::point_source);
  readList("light_directions", StimulusKind::light_direction);
}

template <typename Value>
Options<Value> named(std::initializer_list<Value> values) {
  Options<Value> options;
  for (const Value value : values) options.emplace_back(name(value), value);
  return options;
}

TimedStimulus readProtocolEntry(YamlReader& in) {
  TimedStimulus entry;
  entry.time = in.quantity("at", dimension::time, atLeast(0));
  const auto operation =
      in.exactlyOneOf(named({StimulusOperation::add, StimulusOperation::change, StimulusOperation::remove}));
  if (!operation) return entry;
  in.section(name(*operation), kRequired, [&](YamlReader& stimulus) {
    const auto kind = stimulus.exactlyOneOf(named({StimulusKind::point_source, StimulusKind::light_direction}));
    if (!kind) return;
    stimulus.section(name(*kind), kRequired, [&](YamlReader& fields) {
      entry.command = readStimulus(fields, *kind, *operation, fields.identifier("id"));
    });
  });
  return entry;
}

/// `known` holds the stimuli of the world that the protocol finds, to refuse what would change nothing in it; null if
/// that world is not known.
void readProtocol(YamlReader& in, std::vector<TimedStimulus>& protocol, growth::Environment* known) {
  in.section("stimuli", kOptional, [&](YamlReader& stimuli) { readStimuli(stimuli, protocol); });
  if (known) {
    for (const TimedStimulus& stimulus : protocol) apply(stimulus.command, *known);
  }
  double latest = 0.0;
  int latest_line = 0;
  in.list("protocol", kOptional, [&](YamlReader& entry) {
    const TimedStimulus stimulus = readProtocolEntry(entry);
    if (stimulus.time < latest) {
      entry.addProblem("at", "'" + entry.text("at") + "' is earlier than the entry before it, on line " +
                                 std::to_string(latest_line) + "; entries are in order of time");
    }
    if (known && entry.faultless()) {
      const auto refusal = apply(stimulus.command, *known);
      if (refusal) entry.addProblem(name(stimulus.command.operation), *refusal);
    }
    latest = stimulus.time;
    latest_line = entry.line("at");
    protocol.push_back(stimulus);
  });
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
  IdLines ids;
  in.list("organs", kRequired,
          [&](YamlReader& organ) { scenario.organs.push_back(readOrgan(organ, scenario.relaxation, ids)); });
  growth::Environment environment;
  readProtocol(in, scenario.protocol, &environment);
  return scenario;
}

std::vector<TimedStimulus> readProtocolAlone(YamlReader& in) {
  std::vector<TimedStimulus> protocol;
  in.identifier("name");
  in.text("description", "");
  if (!in.has("stimuli") && !in.has("protocol")) in.addProblem("protocol", "is missing; give a sequence of mappings");
  readProtocol(in, protocol, nullptr);
  return protocol;
}

template <typename Content>
Content parse(const std::string& yaml, const std::string& source, Content (*read)(YamlReader&)) {
  std::vector<Problem> problems;
  Content content;
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

std::vector<TimedStimulus> loadProtocol(const std::string& file) { return parseProtocol(readText(file), file); }

std::vector<TimedStimulus> parseProtocol(const std::string& yaml, const std::string& source) {
  return parse(yaml, source, readProtocolAlone);
}

}  // namespace sensory_growth::simulation
