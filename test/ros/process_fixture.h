#pragma once

/// Tests that start and end the node themselves.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "ros/bag_contents.h"
#include "ros/child_process.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {

class Process : public ::testing::Test {
 protected:
  Process() : directory_(std::filesystem::temp_directory_path() / ("process_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(directory_);
    name_ = "/child_" + std::to_string(++started_);  // a name of its own: the master forgets a killed node late
    set("scenario", scenarioFile());
    set("growth_time_scale", 60.0);
    set("recording_directory", directory_.string());
    set("recording_minimum_free_space", 0.0);
  }

  ~Process() override {
    ros::param::del(name_);
    std::filesystem::remove_all(directory_);
  }

  template <typename Value>
  void set(const std::string& parameter, const Value& value) {
    ros::param::set(name_ + "/" + parameter, value);
  }

  ChildProcess start(rlim_t largest_file = RLIM_INFINITY) {
    return ChildProcess({NODE_EXECUTABLE, "__name:=" + name_.substr(1)}, directory_ / "output.txt", largest_file);
  }

  void expectRefusal(const std::vector<std::string>& messages) {
    ChildProcess child = start();
    EXPECT_EQ(child.waitForExit(kPatience), 1);
    for (const std::string& message : messages) {
      EXPECT_NE(child.printed().find(message), std::string::npos) << message << " is not in\n" << child.printed();
    }
  }

  /// States in a bag that was not closed, from step 0 on; none missing.
  std::size_t recoveredStates(const std::string& unfinished) {
    const std::string reindex = "rosbag reindex -q '" + unfinished + "'";
    EXPECT_EQ(std::system(reindex.c_str()), 0);
    const rosbag::Bag bag(unfinished);
    const auto states = readTopic<OrganState>(bag, name_ + "/organs/shoot/state");
    for (std::size_t step = 0; step < states.size(); ++step) EXPECT_EQ(states[step].step_index, step);
    EXPECT_EQ(readTopic<std_msgs::String>(bag, name_ + "/scenario").size(), 1u);
    return states.size();
  }

  inline static int started_ = 0;
  const std::filesystem::path directory_;
  std::string name_;
};

}  // namespace sensory_growth::node::testing
