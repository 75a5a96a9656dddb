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

void Simulation::reset() {
  organs_ = buildOrgans(scenario_);
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
  gravity_ = command.acceleration;
  gravity_changed_ = true;
  environment_.down = gravity_.stableNormalized();
  for (Organ& organ : organs_) organ.setGravity(gravity_);
  return std::nullopt;
}

std::optional<std::string> Simulation::take(const SpawnCommand& command) {
  if (organs_.size() >= kMostOrgans) {
    return "there are " + std::to_string(organs_.size()) + " organs already; remove one first";
  }
  try {
    const OrganScenario organ = parseOrgan(command.organ, "organ", scenario_.relaxation);
    if (find(organ.id) != organs_.end()) return "there is an organ '" + organ.id + "' already; give another id";
    Scenario now = scenario_;
    now.gravity = gravity_;
    organs_.push_back(Organ(organ, now));
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
  sources_.recount(organs_);
  return std::nullopt;
}

std::vector<Organ>::iterator Simulation::find(const std::string& id) {
  return std::find_if(organs_.begin(), organs_.end(), [&](const Organ& organ) { return organ.scenario().id == id; });
}

bool Simulation::finished() const { return scenario_.duration > 0.0 && time() >= scenario_.duration * (1.0 - 1e-12); }

std::vector<AppliedCommand> Simulation::takeApplied() { return std::exchange(applied_, {}); }

void Simulation::applyDue() {
  // What is due takes effect at the first step boundary that is not earlier than its time.
  const double now = time() + 1e-9 * scenario_.stepping.step;
  const std::vector<TimedCommand>& protocol = scenario_.protocol;
  while (true) {
    const bool has_more = next_in_protocol_ < protocol.size();
    const double asked = has_more ? protocol[next_in_protocol_].time : std::numeric_limits<double>::infinity();
    const double switched = schedule_.next();
    if (std::min(asked, switched) > now) return;
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
