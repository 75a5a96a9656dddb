#include "sensory_growth/ros/answer.h"

namespace sensory_growth::node {

void PendingAnswer::give(Answer answer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (answer_) return;
  answer_ = std::move(answer);
  given_.notify_one();
}

Answer PendingAnswer::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  given_.wait(lock, [this] { return answer_.has_value(); });
  return *answer_;
}

}  // namespace sensory_growth::node
