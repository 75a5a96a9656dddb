#pragma once

#include <chrono>

namespace sensory_growth::node {

/// Lets one log line through per interval of wall time; roscpp's own throttle counts ROS time, which may stand still.
class WallThrottle {
 public:
  explicit WallThrottle(std::chrono::steady_clock::duration interval) : interval_(interval) {}

  bool due() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + interval_;
    return true;
  }

 private:
  std::chrono::steady_clock::duration interval_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace sensory_growth::node
