#include "sensory_growth/simulation/schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace sensory_growth::simulation {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Why a flash might fall between two step boundaries and never be seen, or nothing.
std::optional<std::string> findFlaw(const StimulusTiming& timing, double step) {
  if (timing.duration == 0.0 || timing.duration >= step * (1.0 - 1e-9)) return std::nullopt;
  std::ostringstream text;
  text << "duration " << timing.duration << " s is shorter than a step of " << step << " s";
  return text.str();
}

}  // namespace

double ScheduledStimulus::nextSwitch() const {
  const StimulusTiming& timing = stimulus.timing;
  const std::uint64_t flashes = switches / 2;  // that are over
  if (isOn() ? timing.duration == 0.0 : flashes > 0 && timing.period == 0.0) return kNever;
  return begin + static_cast<double>(flashes) * timing.period + (isOn() ? timing.duration : 0.0);
}

Schedule::Schedule(double step, std::vector<ScheduledStimulus> entries) : step_(step), entries_(std::move(entries)) {
  if (entries_.size() > kMostScheduled) throw std::invalid_argument("there are too many scheduled stimuli");
  for (const ScheduledStimulus& entry : entries_) {
    const StimulusCommand& stimulus = entry.stimulus;
    if (const auto fault = findFault(stimulus)) throw std::invalid_argument(*fault);
    if (const auto flaw = findFlaw(stimulus.timing, step_)) throw std::invalid_argument(*flaw);
    if (stimulus.operation != StimulusOperation::add || !std::isfinite(entry.begin) || entry.nextSwitch() == kNever) {
      throw std::invalid_argument("stimulus '" + stimulus.id + "' is scheduled for no time");
    }
  }
}

void Schedule::delay(double time) {
  for (ScheduledStimulus& entry : entries_) entry.begin += time;
}

std::optional<std::string> Schedule::take(const StimulusCommand& command, double now,
                                          growth::Environment& environment) {
  if (auto fault = findFault(command)) return fault;
  const bool removes = command.operation == StimulusOperation::remove;
  const StimulusTiming timing = removes ? StimulusTiming{} : command.timing;
  if (auto flaw = findFlaw(timing, step_)) return flaw;

  // One that is kept exists, although it may be nowhere else between two flashes.
  const auto kept = find(command);
  const bool is_kept = kept != entries_.end();
  StimulusCommand addition = command;
  if (!removes && is_kept) addition.operation = StimulusOperation::add;
  growth::Environment changed = environment;
  const auto refusal = apply(addition, changed);
  if (refusal && !(removes && is_kept)) return refusal;

  addition.operation = StimulusOperation::add;
  const ScheduledStimulus scheduled{addition, now + timing.start, timing.start > 0.0 ? 0u : 1u};
  const bool keeps = !removes && scheduled.nextSwitch() < kNever;
  if (keeps && !is_kept && entries_.size() == kMostScheduled) {
    return "there are " + std::to_string(kMostScheduled) + " stimuli scheduled already; remove one first";
  }
  if (is_kept) entries_.erase(kept);
  if (keeps) entries_.push_back(scheduled);
  if (timing.start == 0.0) environment = std::move(changed);
  return std::nullopt;
}

double Schedule::next() const {
  double next = kNever;
  for (const ScheduledStimulus& entry : entries_) next = std::min(next, entry.nextSwitch());
  return next;
}

StimulusCommand Schedule::takeNext() {
  const auto sooner = [](const auto& a, const auto& b) { return a.nextSwitch() < b.nextSwitch(); };
  return makeSwitch(std::min_element(entries_.begin(), entries_.end(), sooner));
}

void Schedule::skipTo(double time, growth::Environment& environment) {
  const auto is_due = [time](const ScheduledStimulus& entry) {
    return entry.stimulus.timing.period == 0.0 && entry.nextSwitch() < time;
  };
  const auto find_due = [&] { return std::find_if(entries_.begin(), entries_.end(), is_due); };
  for (Entry due = find_due(); due != entries_.end(); due = find_due()) apply(makeSwitch(due), environment);
}

Schedule::Entry Schedule::find(const StimulusCommand& command) {
  return std::find_if(entries_.begin(), entries_.end(), [&](const ScheduledStimulus& entry) {
    return entry.stimulus.kind == command.kind && entry.stimulus.id == command.id;
  });
}

StimulusCommand Schedule::makeSwitch(Entry entry) {
  StimulusCommand command = entry->stimulus;
  command.operation = entry->isOn() ? StimulusOperation::remove : StimulusOperation::add;
  command.timing = {};
  ++entry->switches;
  if (entry->nextSwitch() == kNever) entries_.erase(entry);
  return command;
}

}  // namespace sensory_growth::simulation
