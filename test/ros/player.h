#pragma once

/// `rosbag play` as a test uses it: paused until everybody is connected.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "ros/node_under_test.h"
#include "ros/service_call.h"

namespace sensory_growth::node::testing {

/// A file of this process, which is removed with it.
class TemporaryBag {
 public:
  TemporaryBag() : path_(std::filesystem::temp_directory_path() / ("playback_" + std::to_string(getpid()) + ".bag")) {}
  ~TemporaryBag() { std::filesystem::remove(path_); }
  std::string path() const { return path_; }

 private:
  const std::filesystem::path path_;
};

/// Lets a player go on that began paused, once `is_ready` holds.
template <typename Predicate>
void startPlaying(const std::string& player, std::chrono::seconds patience, const Predicate& is_ready) {
  const std::string service = player + "/pause_playback";
  const auto deadline = std::chrono::steady_clock::now() + patience;
  // Nothing notifies about services and connections; ROS time stands still, so it cannot be waited on either.
  while (!ros::service::exists(service, false) || !is_ready()) {
    if (std::chrono::steady_clock::now() > deadline) FAIL() << player << " is not ready";
    ros::WallDuration(0.005).sleep();
  }
  std_srvs::SetBool go_on;
  go_on.request.data = false;
  EXPECT_TRUE(callService(service, go_on));
}

}  // namespace sensory_growth::node::testing
