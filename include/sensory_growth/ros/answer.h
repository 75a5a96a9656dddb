#pragma once

/// What the thread of the simulation answers to a thread that asked, and how the answer gets across.

#include <ros/time.h>

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace sensory_growth::node {

/// What a service answers.
struct Answer {
  bool success = false;
  std::string message;
  std::uint64_t step_index = 0;
  ros::Time stamp;
};

/// Where the thread that asked waits. A mutex and a condition rather than std::promise: ThreadSanitizer sees these, and
/// not what happens inside the standard library.
class PendingAnswer {
 public:
  /// The first answer counts; later ones are dropped.
  void give(Answer answer);

  /// Blocks until there is an answer.
  Answer wait();

 private:
  std::mutex mutex_;
  std::condition_variable given_;
  std::optional<Answer> answer_;
};

/// The end that answers. Whoever drops it without a word has said that nothing was done, so nobody waits for a
/// request that was dropped from the queue.
class Replier {
 public:
  explicit Replier(std::shared_ptr<PendingAnswer> pending) : pending_(std::move(pending)) {}
  ~Replier() { pending_->give({false, "not done: the node is shutting down, or in a fault (see ~status)", 0, {}}); }
  Replier(const Replier&) = delete;
  Replier& operator=(const Replier&) = delete;

  void give(Answer answer) const { pending_->give(std::move(answer)); }

 private:
  std::shared_ptr<PendingAnswer> pending_;
};

/// Shared, for a request may be copied on its way; the last copy counts.
using Reply = std::shared_ptr<const Replier>;

}  // namespace sensory_growth::node
