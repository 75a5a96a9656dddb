#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <condition_variable>
#include <map>
#include <mutex>
#include <string>

#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {

/// The latest on /diagnostics, by what is diagnosed ("stimuli", "recording"), whoever says it.
class DiagnosticsListener {
 public:
  DiagnosticsListener() : subscriber_(node_.subscribe("/diagnostics", 10, &DiagnosticsListener::keep, this)) {}

  /// Waits until `what` has a message that begins so, and returns the message.
  std::string waitFor(const std::string& what, const std::string& beginning) {
    return wait(what, beginning, [&](const auto& status) { return status.message.rfind(beginning, 0) == 0; }).message;
  }

  /// Waits until a value of `what` is this.
  void waitForValue(const std::string& what, const std::string& key, const std::string& value) {
    wait(what, key + " = " + value, [&](const auto& status) {
      for (const auto& pair : status.values) {
        if (pair.key == key && pair.value == value) return true;
      }
      return false;
    });
  }

 private:
  template <typename Predicate>
  diagnostic_msgs::DiagnosticStatus wait(const std::string& what, const std::string& wish, const Predicate& holds) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return latest_.count(what) && holds(latest_[what]); }))
        << what << ": '" << latest_[what].message << "' instead of " << wish;
    return latest_[what];
  }

  void keep(const diagnostic_msgs::DiagnosticArray& array) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& status : array.status) {
      const std::size_t colon = status.name.find(": ");  // before it stands the node
      latest_[colon == std::string::npos ? status.name : status.name.substr(colon + 2)] = status;
    }
    changed_.notify_all();
  }

  ros::NodeHandle node_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> latest_;
  ros::Subscriber subscriber_;  // last, so that callbacks end before what they touch
};

}  // namespace sensory_growth::node::testing
