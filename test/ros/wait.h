#pragma once

#include <gtest/gtest.h>
#include <ros/duration.h>

#include <chrono>
#include <string>

namespace sensory_growth::node::testing {

/// Until a test gives up; long enough for a busy machine and a sanitizer, and no test waits that long when all is well.
constexpr std::chrono::seconds kPatience{60};

/// For what nothing notifies about, such as the connections of a subscriber.
template <typename Predicate>
void lookUntil(const std::string& what, const Predicate& holds) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) FAIL() << "waited in vain for " << what;
    ros::WallDuration(0.005).sleep();  // between two looks
  }
}

}  // namespace sensory_growth::node::testing
