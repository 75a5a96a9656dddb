#include "sensory_growth/simulation/parameters.h"

#include <algorithm>
#include <sstream>
#include <type_traits>
#include <utility>
#include <variant>

#include "sensory_growth/simulation/spelling.h"

namespace sensory_growth::simulation {
namespace {

/// `find(organ)` points to the value; null if the organ has no such part.
template <typename Find>
Parameter parameter(const char* name, const Dimension* dimension, const Range& range, const Find& find) {
  return {name, dimension, range,
          [find](const OrganScenario& organ) {
            const double* value = find(organ);
            return value ? std::optional<double>(*value) : std::nullopt;
          },
          [find](OrganScenario& organ, double value) { *find(organ) = value; }};
}

/// Null, of the same constness as the organ.
template <typename Organ>
using Value = std::conditional_t<std::is_const_v<Organ>, const double, double>*;

/// Of a profile that has one.
template <typename Organ>
Value<Organ> rate(Organ& organ) {
  const auto find = [](auto& profile) -> Value<Organ> {
    if constexpr (std::is_same_v<std::decay_t<decltype(profile)>, growth::SampledProfile>) {
      return nullptr;
    } else {
      return &profile.rate;
    }
  };
  return std::visit(find, organ.profile);
}

/// Parts of an organ or of the run that a simulation is built with; what follows a name after '.' or '[' belongs to it.
const std::vector<std::string>& structuralNames() {
  static const std::vector<std::string> names = {
      "id",
      "base",
      "length",
      "elements",
      "radius",
      "material",
      "rest_curvature",
      "growth",
      "division",
      "tip_force",
      "line_force",
      "tip_couple",
      "springs",
      "walls",
      "source",
      "held_apex",
      "saturation",
      "circumnutation",
      "sensing",
      "aging",
      "sensitivities.distance",
      "stepping",
      "weight",
      "duration",
      "relaxation",
      "organs",
      "proprioception.set_point",
  };
  return names;
}

bool isStructural(const std::string& name) {
  const auto holds = [&name](const std::string& part) {
    return name.compare(0, part.size(), part) == 0 &&
           (name.size() == part.size() || name[part.size()] == '.' || name[part.size()] == '[');
  };
  const auto& names = structuralNames();
  return std::any_of(names.begin(), names.end(), holds);
}

std::vector<std::string> parameterNames() {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters()) names.push_back(parameter.name);
  return names;
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }

}  // namespace

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all = {
      parameter("sensitivities.gravity", nullptr, anyNumber, [](auto& organ) { return &organ.senses.gravity; }),
      parameter("sensitivities.light_direction", nullptr, anyNumber,
                [](auto& organ) { return &organ.senses.light_direction; }),
      parameter("sensitivities.point_source", nullptr, anyNumber,
                [](auto& organ) { return &organ.senses.point_source; }),
      parameter("sensitivities.softening_length", &dimension::length, atLeast(0),
                [](auto& organ) { return &organ.senses.softening_length; }),
      parameter("sensitivities.intensity_exponent", nullptr, above(0).upTo(10),
                [](auto& organ) { return &organ.senses.intensity_exponent; }),
      parameter("proprioception.intrinsic_length", &dimension::length, atLeast(0),
                [](auto& organ) { return &organ.bending.proprioception.intrinsic_length; }),
      parameter("proprioception.actual_length", &dimension::length, atLeast(0),
                [](auto& organ) { return &organ.bending.proprioception.actual_length; }),
      parameter("proprioception.relaxation_length", &dimension::length, atLeast(0),
                [](auto& organ) { return &organ.bending.proprioception.relaxation_length; }),
      parameter("growth.rate", &dimension::rate, atLeast(0), [](auto& organ) { return rate(organ); }),
      parameter("growth.stress_coupling.yield_margin", &dimension::stress, above(0),
                [](auto& organ) -> Value<std::remove_reference_t<decltype(organ)>> {
                  return organ.stress_coupling ? &organ.stress_coupling->yield_margin : nullptr;
                }),
      parameter("source.strength", nullptr, anyNumber,
                [](auto& organ) -> Value<std::remove_reference_t<decltype(organ)>> {
                  return organ.source ? &organ.source->strength : nullptr;
                }),
  };
  return all;
}

const Parameter* findParameter(const std::string& name) {
  const auto& all = parameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string whyUnknown(const std::string& name) {
  const std::vector<std::string> names = parameterNames();
  if (const std::string* meant = nearestName(name, names)) {
    return quoted(name) + " is no parameter; did you mean " + quoted(*meant) + "?";
  }
  if (isStructural(name)) {
    return quoted(name) + " is structural: organs are built with it; change it in the scenario and start again";
  }
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + quoted(one);
  return quoted(name) + " is no parameter; known are " + known;
}

std::optional<std::string> findFault(const ParameterCommand& command) {
  const Parameter* parameter = findParameter(command.name);
  if (!parameter) return whyUnknown(command.name);
  if (parameter->range.contains(command.value)) return std::nullopt;
  const char* unit = parameter->dimension ? parameter->dimension->unit : "";
  std::ostringstream text;
  text << command.name << " " << command.value << (*unit ? " " : "") << unit << " is out of range; "
       << parameter->range.describe(unit);
  return text.str();
}

std::optional<std::string> apply(const ParameterCommand& command, std::vector<OrganScenario>& organs) {
  if (auto fault = findFault(command)) return fault;
  const Parameter& parameter = *findParameter(command.name);
  std::vector<OrganScenario> changed = organs;
  bool is_known = false;
  for (OrganScenario& organ : changed) {
    if (!addresses(command, organ)) continue;
    is_known = true;
    if (!parameter.get(organ)) return "organ " + quoted(organ.id) + " has no " + command.name;
    parameter.set(organ, command.value);
    for (const auto& fault : {growth::findFault(organ.senses), growth::findFault(organ.bending)}) {
      if (fault) return "organ " + quoted(organ.id) + ": " + *fault;
    }
  }
  if (!is_known) return "there is no organ " + quoted(command.organ) + "; give its id, or " + quoted(kAllOrgans);
  organs = std::move(changed);
  return std::nullopt;
}

bool addresses(const ParameterCommand& command, const OrganScenario& organ) {
  return command.organ == kAllOrgans || command.organ == organ.id;
}

}  // namespace sensory_growth::simulation
