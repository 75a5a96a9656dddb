#pragma once

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "ros/wait.h"

namespace sensory_growth::node::testing {

/// Every message of a topic since the log was begun, and waiting for one under a deadline of wall time.
template <typename Message>
class MessageLog {
 public:
  explicit MessageLog(const std::string& topic)
      : topic_(topic), subscriber_(node_.subscribe<Message>(topic, 1000, &MessageLog::keep, this)) {
    lookUntil("a publisher of " + topic, [this] { return subscriber_.getNumPublishers() > 0; });
  }

  /// The first that holds.
  template <typename Predicate>
  Message waitFor(const std::string& what, const Predicate& holds) {
    Message found;
    std::unique_lock<std::mutex> lock(mutex_);
    const bool has_come = changed_.wait_for(lock, kPatience, [&] {
      for (const Message& message : messages_) {
        if (!holds(message)) continue;
        found = message;
        return true;
      }
      return false;
    });
    EXPECT_TRUE(has_come) << "waited in vain for " << what << " on " << topic_;
    return found;
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
