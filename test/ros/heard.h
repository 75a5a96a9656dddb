#pragma once

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

namespace sensory_growth::node::testing {

/// Everything that comes on a topic, and waiting for it under a deadline of wall time.
template <typename Message>
class Heard {
 public:
  explicit Heard(const std::string& topic) : topic_(topic) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          messages_.push_back(*message);
          changed_.notify_all();
        };
    subscriber_ = ros::NodeHandle().subscribe<Message>(topic, 1000, callback);
  }

  /// The first message for which holds(message) is true.
  template <typename Predicate>
  Message waitFor(const std::string& what, const Predicate& holds) {
    Message found;
    std::size_t next = 0;
    const auto is_there = [&] {
      for (; next < messages_.size(); ++next) {
        if (!holds(messages_[next])) continue;
        found = messages_[next];
        return true;
      }
      return false;
    };
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(15), is_there)) << topic_ << ": no " << what;
    return found;
  }

  /// What is not latched is lost until the connection stands: makes the node send something until that arrives.
  template <typename Make>
  void connect(const Make& make_it_send) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(15);
    std::unique_lock<std::mutex> lock(mutex_);
    while (messages_.empty() && std::chrono::steady_clock::now() < deadline) {
      lock.unlock();
      make_it_send();
      lock.lock();
      changed_.wait_for(lock, std::chrono::milliseconds(100), [this] { return !messages_.empty(); });
    }
    EXPECT_FALSE(messages_.empty()) << topic_ << ": nothing";
  }

  /// From now on only what comes later counts.
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }

 private:
  const std::string topic_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<Message> messages_;

  ros::Subscriber subscriber_;  // last, so that callbacks end before what they touch
};

}  // namespace sensory_growth::node::testing
