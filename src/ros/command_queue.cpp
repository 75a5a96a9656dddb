#include "sensory_growth/ros/command_queue.h"

#include <utility>

namespace sensory_growth::node {

using simulation::StimulusCommand;
using simulation::StimulusOperation;

bool CommandQueue::push(const StimulusCommand& stimulus) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_closed_) return false;
  if (!replacesWaiting(stimulus)) {
    if (stimuli_waiting_ == most_stimuli_) return false;
    waiting_.emplace_back(stimulus);
    ++stimuli_waiting_;
  }
  changed_.notify_one();
  return true;
}

bool CommandQueue::push(Control control) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_closed_) return false;
  waiting_.emplace_back(std::move(control));
  ++controls_waiting_;
  changed_.notify_one();
  return true;
}

std::vector<Command> CommandQueue::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stimuli_waiting_ = controls_waiting_ = 0;
  return std::exchange(waiting_, {});
}

void CommandQueue::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return is_closed_ || !waiting_.empty(); });
}

bool CommandQueue::waitUntil(Clock::time_point deadline) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_until(lock, deadline, [this] { return is_closed_ || controls_waiting_ > 0; });
}

void CommandQueue::close() {
  std::vector<Command> dropped;  // destroyed outside the lock: it may hold the replies that callers wait for
  const std::lock_guard<std::mutex> lock(mutex_);
  is_closed_ = true;
  dropped.swap(waiting_);
  stimuli_waiting_ = controls_waiting_ = 0;
  changed_.notify_one();
}

bool CommandQueue::isClosed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_closed_;
}

bool CommandQueue::replacesWaiting(const StimulusCommand& stimulus) {
  if (stimulus.operation == StimulusOperation::remove) return false;
  if (stimulus.timing.start > 0.0) return false;  // what holds until then must not be lost
  for (auto command = waiting_.rbegin(); command != waiting_.rend(); ++command) {
    auto* earlier = std::get_if<StimulusCommand>(&*command);
    if (!earlier) return false;  // not across a control, which may look at the stimuli
    if (earlier->kind != stimulus.kind || earlier->id != stimulus.id) continue;
    if (earlier->operation == StimulusOperation::remove) return false;
    // An addition never fails, so the two together are one if either is.
    const bool adds = earlier->operation == StimulusOperation::add || stimulus.operation == StimulusOperation::add;
    *earlier = stimulus;
    earlier->operation = adds ? StimulusOperation::add : StimulusOperation::change;
    return true;
  }
  return false;
}

}  // namespace sensory_growth::node
