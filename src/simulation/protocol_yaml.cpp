#include "protocol_yaml.h"

#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "sensory_growth/simulation/parameters.h"

namespace sensory_growth::simulation {
namespace {

template <typename Value>
Options<Value> named(std::initializer_list<Value> values) {
  Options<Value> options;
  for (const Value value : values) options.emplace_back(name(value), value);
  return options;
}

StimulusTiming readTiming(YamlReader& in) {
  const Range range = atLeast(0).upTo(kLongestWait);
  StimulusTiming timing;
  timing.start = in.quantity("start", dimension::time, range, timing.start);
  timing.duration = in.quantity("duration", dimension::time, range, timing.duration);
  timing.period = in.quantity("period", dimension::time, range, timing.period);
  const bool is_given = std::isfinite(timing.start + timing.duration + timing.period);
  if (const auto fault = findFault(timing); is_given && fault) in.addProblem("period", *fault);
  return timing;
}

/// The fields of a stimulus but its id.
StimulusCommand readStimulus(YamlReader& in, StimulusKind kind, StimulusOperation operation, const std::string& id) {
  StimulusCommand command;
  command.kind = kind;
  command.operation = operation;
  command.id = id;
  if (operation == StimulusOperation::remove) return command;
  const bool is_direction = kind == StimulusKind::light_direction;
  command.vector = is_direction ? in.direction("towards") : in.vector("position", dimension::length);
  command.strength = in.number("strength", anyNumber);
  command.timing = readTiming(in);
  return command;
}

/// Takes a command in the known world, or says why it would change nothing there.
struct Refusal {
  KnownWorld& world;
  double boundary;  ///< growth time at which the command takes effect [s]

  std::optional<std::string> operator()(const StimulusCommand& command) const {
    return world.schedule.take(command, boundary, world.environment);
  }
  std::optional<std::string> operator()(const ParameterCommand& command) const { return apply(command, world.organs); }
  std::optional<std::string> operator()(const GravityCommand& command) const { return findFault(command); }
  std::optional<std::string> operator()(const SpawnCommand&) const { return std::nullopt; }   // no protocol has it
  std::optional<std::string> operator()(const RemoveCommand&) const { return std::nullopt; }  // no protocol has it
};

std::optional<std::string> findRefusal(const TimedCommand& entry, KnownWorld& world) {
  world.schedule.skipTo(entry.time, world.environment);
  const double boundary = std::ceil(entry.time / world.step - 1e-9) * world.step;
  return std::visit(Refusal{world, boundary}, entry.command);
}

void readStimuli(YamlReader& in, std::vector<TimedCommand>& protocol, KnownWorld* known) {
  const auto readList = [&](const std::string& key, StimulusKind kind) {
    YamlReader::Lines ids;
    in.list(key, kOptional, [&](YamlReader& stimulus) {
      const std::string id = stimulus.uniqueIdentifier("id", ids);
      protocol.push_back({0.0, readStimulus(stimulus, kind, StimulusOperation::add, id)});
      if (!known || !stimulus.faultless()) return;
      if (const auto refusal = findRefusal(protocol.back(), *known)) stimulus.addProblem("id", *refusal);
    });
  };
  readList("point_sources", StimulusKind::point_source);
  readList("light_directions", StimulusKind::light_direction);
}

StimulusCommand readStimulusChange(YamlReader& in, StimulusOperation operation) {
  StimulusCommand command;
  const auto kind = in.exactlyOneOf(named({StimulusKind::point_source, StimulusKind::light_direction}));
  if (!kind) return command;
  in.section(name(*kind), kRequired, [&](YamlReader& stimulus) {
    command = readStimulus(stimulus, *kind, operation, stimulus.identifier("id"));
  });
  return command;
}

ParameterCommand readParameter(YamlReader& in) {
  ParameterCommand command;
  command.organ = in.identifier("organ");
  command.name = in.text("name");
  const Parameter* parameter = findParameter(command.name);
  if (!parameter) {
    if (in.has("name")) in.addProblem("name", whyUnknown(command.name));
    in.ignoreOtherKeys();
  } else if (parameter->dimension) {
    command.value = in.quantity("value", *parameter->dimension, parameter->range);
  } else {
    command.value = in.number("value", parameter->range);
  }
  return command;
}

Command readSetting(YamlReader& in) {
  enum class Kind { parameter, gravity };
  Command command;
  const auto kind = in.exactlyOneOf<Kind>({{"parameter", Kind::parameter}, {"gravity", Kind::gravity}});
  if (kind == Kind::parameter) {
    in.section("parameter", kRequired, [&](YamlReader& parameter) { command = readParameter(parameter); });
  } else if (kind == Kind::gravity) {
    in.section("gravity", kRequired, [&](YamlReader& gravity) { command = GravityCommand{readGravity(gravity)}; });
  }
  return command;
}

/// What a protocol does with something.
struct Verb {
  std::string key;
  std::optional<StimulusOperation> operation;  ///< of a stimulus; nothing sets something else
};

std::optional<Verb> readVerb(YamlReader& in) {
  Options<Verb> verbs;
  for (const auto operation : {StimulusOperation::add, StimulusOperation::change, StimulusOperation::remove}) {
    verbs.emplace_back(name(operation), Verb{name(operation), operation});
  }
  verbs.emplace_back("set", Verb{"set", std::nullopt});
  return in.exactlyOneOf(verbs);
}

}  // namespace

rod::Vector3 readGravity(YamlReader& in) {
  const rod::Vector3 direction = in.direction("direction");
  return in.quantity("acceleration", dimension::acceleration, atLeast(0)) * direction;
}

void readProtocol(YamlReader& in, std::vector<TimedCommand>& protocol, KnownWorld* known) {
  in.section("stimuli", kOptional, [&](YamlReader& stimuli) { readStimuli(stimuli, protocol, known); });
  double latest = 0.0;
  int latest_line = 0;
  in.list("protocol", kOptional, [&](YamlReader& in_entry) {
    TimedCommand entry;
    entry.time = in_entry.quantity("at", dimension::time, atLeast(0));
    const std::optional<Verb> verb = readVerb(in_entry);
    if (verb) {
      in_entry.section(verb->key, kRequired, [&](YamlReader& what) {
        entry.command = verb->operation ? readStimulusChange(what, *verb->operation) : readSetting(what);
      });
    }
    if (entry.time < latest) {
      in_entry.addProblem("at", "'" + in_entry.text("at") + "' is earlier than the entry before it, on line " +
                                    std::to_string(latest_line) + "; entries are in order of time");
    }
    if (known && in_entry.faultless()) {
      if (const auto refusal = findRefusal(entry, *known)) in_entry.addProblem(verb->key, *refusal);
    }
    latest = entry.time;
    latest_line = in_entry.line("at");
    protocol.push_back(entry);
  });
}

}  // namespace sensory_growth::simulation
