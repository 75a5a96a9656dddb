#pragma once

/// Stimuli that switch on and off by themselves.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::simulation {

/// Most stimuli that wait to be switched.
constexpr std::size_t kMostScheduled = 256;

/// A stimulus that will be switched.
struct ScheduledStimulus {
  StimulusCommand stimulus;    ///< what adds it
  double begin = 0.0;          ///< growth time at which it is on for the first time [s]
  std::uint64_t switches = 0;  ///< on and off, so far

  bool isOn() const { return switches % 2 == 1; }

  /// Growth time of the next switch [s], from the number of those before, so that nothing accumulates; infinity: never.
  double nextSwitch() const;
};

/// Makes plain additions and removals of commands with a timing.
class Schedule {
 public:
  /// `step` is the growth time between two step boundaries [s].
  explicit Schedule(double step) : step_(step) {}

  /// Goes on with such entries. Throws std::invalid_argument if take() makes none like them.
  Schedule(double step, std::vector<ScheduledStimulus> entries);

  /// Puts all switches off by that time [s].
  void delay(double time);

  /// Takes a command at a step boundary, at growth time `now` [s]: applies it to the environment or keeps it for later.
  /// Whatever was kept of that stimulus is forgotten. Or leaves all as it was and returns why.
  std::optional<std::string> take(const StimulusCommand& command, double now, growth::Environment& environment);

  /// Growth time of the next switch [s]; infinity if there is none.
  double next() const;

  /// The next switch, which counts as made. There must be one.
  StimulusCommand takeNext();

  /// Makes the switches earlier than `time` [s], but those of flashes: what flashes exists all the time.
  void skipTo(double time, growth::Environment& environment);

  /// What will be switched, in the order in which it was taken.
  const std::vector<ScheduledStimulus>& entries() const { return entries_; }

 private:
  using Entry = std::vector<ScheduledStimulus>::iterator;

  Entry find(const StimulusCommand& command);
  StimulusCommand makeSwitch(Entry entry);

  double step_;
  std::vector<ScheduledStimulus> entries_;
};

}  // namespace sensory_growth::simulation
