#pragma once

/// Everything that wants to change the simulation waits here for the next step boundary (ros.md 26).

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <variant>
#include <vector>

#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

using Control = std::function<void()>;
using Command = std::variant<simulation::StimulusCommand, Control>;

/// Any thread pushes, one thread takes. Keeps the order of what was pushed.
///
/// Stimuli may come at the rate of a mouse, so those that the next one of the same id replaces before anybody saw them
/// are dropped, and their number is bounded.
class CommandQueue {
 public:
  using Clock = std::chrono::steady_clock;

  explicit CommandQueue(std::size_t most_stimuli) : most_stimuli_(most_stimuli) {}

  /// False, and nothing happened, if too many stimuli wait or the queue is closed.
  bool push(const simulation::StimulusCommand& stimulus);

  /// False, and nothing happened, if the queue is closed.
  bool push(Control control);

  /// Takes what waits, oldest first; does not block.
  std::vector<Command> take();

  /// Blocks until a command waits or the queue is closed.
  void wait();

  /// Blocks until `deadline`, unless a control waits or the queue is closed; true if so. Stimuli wait for the deadline:
  /// they make no difference before the step that is due then, and of many for one id only the last is left.
  bool waitUntil(Clock::time_point deadline);

  /// From now on nothing is taken in. Commands that still wait are dropped.
  void close();

  bool isClosed() const;

 private:
  bool replacesWaiting(const simulation::StimulusCommand& stimulus);

  const std::size_t most_stimuli_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<Command> waiting_;
  std::size_t stimuli_waiting_ = 0, controls_waiting_ = 0;
  bool is_closed_ = false;
};

}  // namespace sensory_growth::node
