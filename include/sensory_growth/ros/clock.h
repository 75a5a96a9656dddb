#pragma once

/// ROS time of the states: exactly one owner (ros.md 27), never zero, strictly increasing, also across a reset.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "sensory_growth/ros/parameters.h"

namespace sensory_growth::node {

/// What forbids this clock mode on this ROS system: /use_sim_time, or another owner of /clock.
std::vector<std::string> findClockProblems(ClockMode mode);

/// Names of the other nodes that publish /clock, as the master knows them.
std::vector<std::string> otherClockPublishers();

/// ROS time after `ticks` steps of `step` [s]: computed from the counter, so that nothing accumulates.
ros::Time stampOf(std::uint64_t ticks, double step);

/// Thread-safe.
class Clock {
 public:
  /// `step` is the ROS time between two states [s], `rate` the most messages on /clock [1/s of wall time].
  Clock(ClockMode mode, double step, double rate, ros::NodeHandle node);

  /// The stamp of a new state, later than all before; published on /clock unless `rate` forbids it just now.
  ros::Time tick();

  /// Publishes the current stamp if `rate` held it back.
  void flush();

  /// Publishes the current stamp once more if nothing went out lately: nodes that start while the simulation is paused
  /// wait for a valid time.
  void keepAlive();

 private:
  void publish();

  const ClockMode mode_;
  const double step_;
  const ros::WallDuration shortest_interval_;
  ros::Publisher publisher_;

  std::mutex mutex_;  // guards what follows
  std::uint64_t ticks_ = 0;
  ros::Time stamp_;
  bool is_published_ = true;
  ros::SteadyTime last_published_;
};

}  // namespace sensory_growth::node
