#pragma once

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "ros/wait.h"

namespace sensory_growth::node::testing {

/// Every message of a topic since the log was begun or forgot, and waiting for one under a deadline of wall time.
template <typename Message>
class MessageLog {
 public:
  explicit MessageLog(const std::string& topic)
      : topic_(topic), subscriber_(node_.subscribe<Message>(topic, 1000, &MessageLog::keep, this)) {
    lookUntil("a publisher of " + topic, [this] { return subscriber_.getNumPublishers() > 0; });
  }

  /// The first that holds; `holds` sees each once, in the order in which they came.
  template <typename Predicate>
  Message waitFor(const std::string& what, const Predicate& holds) {
    Message found;
    std::size_t next = 0;
    std::unique_lock<std::mutex> lock(mutex_);
    const bool has_come = changed_.wait_for(lock, kPatience, [&] {
      for (; next < messages_.size(); ++next) {
        if (!holds(messages_[next])) continue;
        found = messages_[next];
        return true;
      }
      return false;
    });
    EXPECT_TRUE(has_come) << "waited in vain for " << what << " on " << topic_;
    return found;
  }

  /// What is not latched is lost until the connection stands: makes the node send something until that arrives.
  template <typename Make>
  void connect(const Make& make_it_send) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    std::unique_lock<std::mutex> lock(mutex_);
    while (messages_.empty() && std::chrono::steady_clock::now() < deadline) {
      lock.unlock();
      make_it_send();
      lock.lock();
      changed_.wait_for(lock, std::chrono::milliseconds(100), [this] { return !messages_.empty(); });
    }
    EXPECT_FALSE(messages_.empty()) << "nothing came on " << topic_;
  }

  /// From now on only what comes later counts.
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }

  void waitForCount(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return messages_.size() >= count; }))
        << "only " << messages_.size() << " of " << count << " messages on " << topic_;
  }

  std::vector<Message> all() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

 private:
  void keep(const boost::shared_ptr<const Message>& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(*message);
    changed_.notify_all();
  }

  const std::string topic_;
  ros::NodeHandle node_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;  // last, so that callbacks end before what they touch
};

}  // namespace sensory_growth::node::testing
