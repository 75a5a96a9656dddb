#include "sensory_growth/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::simulation {
namespace {

std::vector<Organ> buildOrgans(const Scenario& scenario) {
  std::vector<Organ> organs;
  organs.reserve(scenario.organs.size());
  for (const OrganScenario& organ : scenario.organs) organs.emplace_back(organ, scenario);
  return organs;
}

/// Of stimuli in force, which are not changed by what looks at them: a direction made a unit vector twice is another.
void checkStimuli(const SimulationState& state) {
  const auto require = [](const std::optional<std::string>& fault, const std::string& id) {
    if (fault) throw std::invalid_argument("stimulus '" + id + "': " + *fault);
  };
  for (const auto& [id, position, strength, velocity] : state.point_sources) {
    require(findFault(StimulusCommand{StimulusKind::point_source, StimulusOperation::add, id, position, strength}), id);
    if (!velocity.isZero(0.0)) throw std::invalid_argument("stimulus '" + id + "' moves on its own");
  }
  for (const auto& [id, towards, strength] : state.light_directions) {
    require(findFault(StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, id, towards, strength}),
            id);
    if (std::abs(towards.norm() - 1.0) > 1e-9) {
      throw std::invalid_argument("stimulus '" + id + "' has a direction that is no unit vector");
    }
  }
  if (state.point_sources.size() > kMostStimuli || state.light_directions.size() > kMostStimuli) {
    throw std::invalid_argument("there are more than " + std::to_string(kMostStimuli) + " stimuli of a kind");
  }
}

}  // namespace

Simulation::Simulation(Scenario scenario, int threads)
    : scenario_(std::move(scenario)), workers_(threads), schedule_(scenario_.stepping.step) {
  const double step = scenario_.stepping.step;
  if (!(step > 0.0) || !std::isfinite(step)) throw std::invalid_argument("stepping.step must be positive and finite");
  const auto earlier = [](const TimedCommand& a, const TimedCommand& b) { return a.time < b.time; };
  if (!std::is_sorted(scenario_.protocol.begin(), scenario_.protocol.end(), earlier)) {
    throw std::invalid_argument("the protocol must be in order of time");
  }
  reset();
}

Simulation::Simulation(Scenario scenario, const SimulationState& state, int threads)
    : Simulation(std::move(scenario), threads) {
  restore(state);
}

void Simulation::reset() {
  organs_ = buildOrgans(scenario_);
  births_.clear();
  sources_ = OrganSources(organs_);
  environment_ = {};
  schedule_ = Schedule(scenario_.stepping.step);
  gravity_ = scenario_.gravity;
  environment_.down = gravity_.stableNormalized();
  gravity_changed_ = false;
  step_index_ = 0;
  next_in_protocol_ = 0;
  applied_.clear();
  applyDue();
}

SimulationState Simulation::state() const {
  SimulationState state;
  state.step_index = step_index_;
  state.gravity = gravity_;
  state.gravity_changed = gravity_changed_;
  state.point_sources = environment_.point_sources;
  state.light_directions = environment_.light_directions;
  state.scheduled = schedule_.entries();
  state.births = births_;
  state.source_velocities = sources_.velocities();
  state.organs.reserve(organs_.size());
  for (const Organ& organ : organs_) state.organs.push_back(organ.state());
  return state;
}

/// Of a simulation that was just built: what is thrown on the way leaves it half restored.
void Simulation::restore(const SimulationState& state) {
  if (state.step_index > kLatestStep) throw std::invalid_argument("the step index is beyond all that can be counted");
  if (const auto fault = findFault(GravityCommand{state.gravity})) throw std::invalid_argument(*fault);
  checkStimuli(state);
  restoreBirths(state.births);
  step_index_ = state.step_index;
  setGravity(state.gravity);
  gravity_changed_ = state.gravity_changed;
  environment_.time = time();
  environment_.point_sources = state.point_sources;
  environment_.light_directions = state.light_directions;
  schedule_ = Schedule(scenario_.stepping.step, state.scheduled);
  restoreOrgans(state);
  sources_ = OrganSources(organs_);
  sources_.restore(organs_, state.source_velocities);
  const auto is_due = [this](const TimedCommand& command) { return isDue(command.time); };
  const auto& protocol = scenario_.protocol;
  next_in_protocol_ =
      static_cast<std::size_t>(std::partition_point(protocol.begin(), protocol.end(), is_due) - protocol.begin());
  applied_.clear();
}

/// Adds the organs that the scenario does not have, in place of its own of the same id.
void Simulation::restoreBirths(const std::vector<Birth>& births) {
  if (births.size() > kMostOrgans) throw std::invalid_argument("more organs were added than there can be");
  for (const Birth& birth : births) {
    if (const auto replaced = find(birth.id); replaced != organs_.end()) organs_.erase(replaced);
    try {
      add(birth.organ, birth.gravity);
    } catch (const std::exception& fault) {
      throw std::invalid_argument(fault.what());
    }
  }
}

/// Keeps only the organs of the state, in its order.
void Simulation::restoreOrgans(const SimulationState& state) {
  std::vector<Organ> organs;
  for (const OrganState& organ_state : state.organs) {
    try {
      const auto organ = find(organ_state.id);
      if (organ == organs_.end()) throw std::invalid_argument("comes from nowhere, or twice");
      organ->restore(organ_state, time());
      organs.push_back(std::move(*organ));
      organs_.erase(organ);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("organ '" + organ_state.id + "': " + fault.what());
    }
  }
  organs_ = std::move(organs);
}

void Simulation::takeStimuliOf(const Simulation& other) {
  schedule_ = other.schedule_;
  schedule_.delay(time() - other.time());
  environment_.point_sources = other.environment_.point_sources;
  environment_.light_directions = other.environment_.light_directions;
  if (other.gravity_ != gravity_) setGravity(other.gravity_);
}

StepReport Simulation::step() {
  const double dt = scenario_.stepping.step;
  try {
    if (gravity_changed_) {  // the organs sense each other where it puts them
      workers_.forEach(organs_.size(), [this](std::size_t i) { organs_[i].begin(); });
      sources_.locate(organs_);
    }
    workers_.forEach(organs_.size(),
                     [this, dt](std::size_t i) { organs_[i].advance(dt, sources_.seenBy(i, environment_)); });
  } catch (...) {
    for (Organ& organ : organs_) organ.undo();
    throw;
  }
  const auto has_failed = [](const Organ& organ) { return !organ.report().ok(); };
  const auto failed = std::find_if(organs_.begin(), organs_.end(), has_failed);
  if (failed != organs_.end()) {
    // The first that failed keeps its report; advance() has left it as it was.
    for (auto organ = organs_.begin(); organ != organs_.end(); ++organ) {
      if (organ != failed) organ->undo();
    }
    return {false, "organ '" + failed->scenario().id + "' failed in step " + std::to_string(step_index_ + 1) + ": " +
                       describe(failed->report())};
  }
  gravity_changed_ = false;
  sources_.follow(organs_, dt);
  ++step_index_;
  environment_.time = time();
  applyDue();
  return {};
}

AppliedCommand Simulation::apply(const Command& command) {
  const auto refusal = std::visit([this](const auto& typed) { return take(typed); }, command);
  applied_.push_back({step_index_, command, refusal.value_or("")});
  return applied_.back();
}

std::optional<std::string> Simulation::take(const StimulusCommand& command) {
  return schedule_.take(command, time(), environment_);
}

std::optional<std::string> Simulation::take(const ParameterCommand& command) {
  std::vector<OrganScenario> now;
  for (const Organ& organ : organs_) now.push_back(organ.scenario());
  if (auto refusal = simulation::apply(command, now)) return refusal;
  for (Organ& organ : organs_) {
    if (addresses(command, organ.scenario())) organ.set(*findParameter(command.name), command.value);
  }
  sources_.locate(organs_);
  return std::nullopt;
}

std::optional<std::string> Simulation::take(const GravityCommand& command) {
  if (auto fault = findFault(command)) return fault;
  setGravity(command.acceleration);
  return std::nullopt;
}

void Simulation::setGravity(const rod::Vector3& gravity) {
  gravity_ = gravity;
  gravity_changed_ = true;
  environment_.down = gravity_.stableNormalized();
  for (Organ& organ : organs_) organ.setGravity(gravity_);
}

std::optional<std::string> Simulation::take(const SpawnCommand& command) {
  if (organs_.size() >= kMostOrgans) {
    return "there are " + std::to_string(organs_.size()) + " organs already; remove one first";
  }
  try {
    add(command.organ, gravity_);
  } catch (const std::exception& fault) {
    return fault.what();
  }
  sources_.recount(organs_);
  return std::nullopt;
}

std::optional<std::string> Simulation::take(const RemoveCommand& command) {
  const auto organ = find(command.organ);
  if (organ == organs_.end()) return "there is no organ '" + command.organ + "'";
  organs_.erase(organ);
  const auto is_gone = [&command](const Birth& birth) { return birth.id == command.organ; };
  births_.erase(std::remove_if(births_.begin(), births_.end(), is_gone), births_.end());
  sources_.recount(organs_);
  return std::nullopt;
}

/// Adds an organ that began under that gravity. Throws std::exception saying why it cannot be.
void Simulation::add(const std::string& organ, const rod::Vector3& gravity) {
  const OrganScenario parsed = parseOrgan(organ, "organ", scenario_.relaxation);
  if (find(parsed.id) != organs_.end()) {
    throw std::invalid_argument("there is an organ '" + parsed.id + "' already; give another id");
  }
  Scenario then = scenario_;
  then.gravity = gravity;
  organs_.push_back(Organ(parsed, then));
  births_.push_back({parsed.id, organ, gravity});
}

std::vector<Organ>::iterator Simulation::find(const std::string& id) {
  return std::find_if(organs_.begin(), organs_.end(), [&](const Organ& organ) { return organ.scenario().id == id; });
}

bool Simulation::finished() const { return scenario_.duration > 0.0 && time() >= scenario_.duration * (1.0 - 1e-12); }

std::vector<AppliedCommand> Simulation::takeApplied() { return std::exchange(applied_, {}); }

/// What is due takes effect at the first step boundary that is not earlier than its time.
bool Simulation::isDue(double time_asked) const { return time_asked <= time() + 1e-9 * scenario_.stepping.step; }

void Simulation::applyDue() {
  const std::vector<TimedCommand>& protocol = scenario_.protocol;
  while (true) {
    const bool has_more = next_in_protocol_ < protocol.size();
    const double asked = has_more ? protocol[next_in_protocol_].time : std::numeric_limits<double>::infinity();
    const double switched = schedule_.next();
    if (!isDue(std::min(asked, switched))) return;
    if (asked <= switched) {
      apply(protocol[next_in_protocol_++].command);
    } else {
      switchNext();
    }
  }
}

void Simulation::switchNext() {
  const StimulusCommand command = schedule_.takeNext();
  const auto refusal = simulation::apply(command, environment_);
  applied_.push_back({step_index_, command, refusal.value_or("")});
}

}  // namespace sensory_growth::simulation
