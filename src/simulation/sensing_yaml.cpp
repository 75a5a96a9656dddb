#include "sensing_yaml.h"

#include <optional>
#include <utility>

namespace sensory_growth::simulation {
namespace {

using growth::Coordinate;

/// Notes the fault of what was read without other problems.
void report(YamlReader& in, const std::optional<growth::Fault>& fault) {
  if (fault && in.faultless()) in.addProblem(fault->field, fault->reason);
}

/// The sensor; nothing if every bend senses for itself.
std::optional<growth::Sensor> readSensor(YamlReader& in) {
  enum class Place { local, apex, from_apex, from_base, label };
  const auto place = in.choice<Place>("at", {{"local", Place::local},
                                             {"apex", Place::apex},
                                             {"distance_from_apex", Place::from_apex},
                                             {"distance_from_base", Place::from_base},
                                             {"label", Place::label}});
  if (!place) {
    in.ignoreOtherKeys();
    return std::nullopt;
  }
  switch (*place) {
    case Place::local:
      return std::nullopt;
    case Place::apex:
      return growth::Sensor{};
    case Place::from_apex:
      return growth::Sensor{Coordinate::distance_from_apex, in.quantity("distance", dimension::length, atLeast(0))};
    case Place::from_base:
      return growth::Sensor{Coordinate::distance_from_base, in.quantity("distance", dimension::length, atLeast(0))};
    case Place::label:
      return growth::Sensor{Coordinate::label, in.number("label", atLeast(0).upTo(1))};
  }
  return std::nullopt;
}

growth::MemoryKernel readDelay(YamlReader& in) {
  return growth::Delay{in.quantity("delay", dimension::time, above(0))};
}

double readTimeConstant(YamlReader& in) {
  return in.quantity("time_constant", dimension::time, atLeast(growth::kShortestTimeConstant));
}

growth::MemoryKernel readExponentialKernel(YamlReader& in) { return growth::exponentialKernel(readTimeConstant(in)); }

growth::MemoryKernel readLinearOde(YamlReader& in) {
  return growth::LinearOde{in.quantity("delay", dimension::time, atLeast(0)), readTimeConstant(in),
                           in.numbers("coefficients", above(0))};
}

growth::MemoryKernel readSampledKernel(YamlReader& in) {
  return growth::SampledKernel{in.quantities("times", dimension::time, atLeast(0)),
                               in.quantities("densities", dimension::rate, anyNumber)};
}

void readMemory(YamlReader& in, growth::Route& route) {
  const auto before_start = in.choice<growth::BeforeStart>(
      "before_start", {{"constant", growth::BeforeStart::constant}, {"zero", growth::BeforeStart::zero}});
  if (before_start) route.before_start = *before_start;
  using ReadKernel = growth::MemoryKernel (*)(YamlReader&);
  const auto read = in.choice<ReadKernel>("kernel", {{"delay", readDelay},
                                                     {"exponential", readExponentialKernel},
                                                     {"linear_ode", readLinearOde},
                                                     {"sampled", readSampledKernel}});
  if (!read) return in.ignoreOtherKeys();
  route.memory = (*read)(in);
  report(in, findFault(route.memory));
}

std::optional<growth::Spread> readFading(YamlReader& in) {
  using Direction = growth::FadingSpread::Direction;
  const auto direction = in.choice<Direction>(
      "direction",
      {{"basipetal", Direction::basipetal}, {"acropetal", Direction::acropetal}, {"both", Direction::both}});
  const double length = in.quantity("length", dimension::length, above(0));
  if (!direction) return std::nullopt;
  return growth::FadingSpread{*direction, length};
}

std::optional<growth::Spread> readSampledSpread(YamlReader& in) {
  growth::SampledSpread spread;
  spread.labels = in.numbers("labels", atLeast(0).upTo(1));
  const std::vector<std::vector<double>> rows = in.matrix("densities", dimension::curvature);
  spread.densities.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(spread.labels.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != spread.labels.size()) {
      in.addProblem("densities", "must have as many rows and columns as there are labels");
      return std::nullopt;
    }
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      spread.densities(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = rows[i][k];
    }
  }
  return spread;
}

std::optional<growth::Spread> readSpread(YamlReader& in) {
  using ReadKernel = std::optional<growth::Spread> (*)(YamlReader&);
  const auto read = in.choice<ReadKernel>("kernel", {{"exponential", readFading}, {"sampled", readSampledSpread}});
  if (!read) {
    in.ignoreOtherKeys();
    return std::nullopt;
  }
  const std::optional<growth::Spread> spread = (*read)(in);
  if (spread) report(in, findFault(*spread));
  return spread;
}

growth::Receivers readReceivers(YamlReader& in) {
  growth::Receivers receivers;
  const auto coordinate = in.choice<Coordinate>("coordinate", {{"distance_from_apex", Coordinate::distance_from_apex},
                                                               {"distance_from_base", Coordinate::distance_from_base},
                                                               {"label", Coordinate::label}});
  if (!coordinate) {
    in.ignoreOtherKeys();
    return receivers;
  }
  receivers.coordinate = *coordinate;
  receivers.at = coordinate == Coordinate::label ? in.numbers("labels", atLeast(0).upTo(1))
                                                 : in.quantities("distances", dimension::length, atLeast(0));
  receivers.weights = in.numbers("weights", anyNumber);
  report(in, findFault(receivers));
  return receivers;
}

growth::Route readRoute(YamlReader& in) {
  using growth::Cue;
  Options<Cue> cues;
  for (const Cue cue : {Cue::gravity, Cue::light_direction, Cue::point_source, Cue::oscillator}) {
    cues.emplace_back(growth::name(cue), cue);
  }
  growth::Route route;
  route.cues = in.choices("cues", cues);
  in.section("sensor", kRequired, [&](YamlReader& sensor) { route.sensor = readSensor(sensor); });
  in.section("memory", kOptional, [&](YamlReader& memory) { readMemory(memory, route); });
  in.section("spread", kOptional, [&](YamlReader& spread) { route.spread = readSpread(spread); });
  if (route.sensor && route.spread) in.addProblem("spread", "needs bends that sense for themselves: a local sensor");
  in.section("receivers", kOptional, [&](YamlReader& receivers) { route.receivers = readReceivers(receivers); });
  return route;
}

}  // namespace

std::vector<growth::Route> readSensing(YamlReader& organ) {
  std::vector<growth::Route> routes;
  organ.list("sensing", kOptional, [&](YamlReader& route) { routes.push_back(readRoute(route)); });
  return routes;
}

}  // namespace sensory_growth::simulation
