#pragma once

/// ROS time of the states: exactly one owner (ros.md 27), never zero, strictly increasing but where it is said to go
/// back.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/ros/followed_time.h"
#include "sensory_growth/ros/parameters.h"

namespace sensory_growth::node {

/// What forbids this clock mode on this ROS system: /use_sim_time, or another owner of /clock.
std::vector<std::string> findClockProblems(ClockMode mode);

/// Names of the other nodes that publish /clock, as the master knows them.
std::vector<std::string> otherClockPublishers();

/// ROS time after `ticks` steps of `step` [s]: computed from the counter, so that nothing accumulates.
ros::Time stampOf(std::uint64_t ticks, double step);

struct ClockSettings {
  ClockMode mode = ClockMode::publish;
  double step = 0.0;  ///< ROS time between two states [s]
  double rate = 0.0;  ///< most messages on /clock [1/s of wall time]
  ResetTime reset_time = ResetTime::keep_time;
};

/// Thread-safe.
class Clock {
 public:
  /// To follow a clock, ROS time must be valid.
  Clock(const ClockSettings& settings, ros::NodeHandle node);

  /// Running begins, or ends. What a clock that is followed says matters in between.
  void start();
  void stop();

  /// Whether a step may be taken; always, unless a clock is followed.
  bool isDue();

  /// The clock that is followed says `now`.
  void hear(const ros::Time& now);

  /// True if the clock that is followed went backwards since the last call.
  bool takeBackwardJump();

  /// Steps that were given up because the clock that is followed was too far ahead, counted once each time.
  std::uint64_t overruns();

  /// A reset: the next state is the first, and has the stamp of the very first if that is how time is reset.
  void reset();

  /// The stamp of a new state, later than all before; published on /clock unless `rate` forbids it just now.
  ros::Time tick();

  /// Publishes the current stamp if `rate` held it back.
  void flush();

  /// Publishes the current stamp once more if nothing went out lately: nodes that start while the simulation is paused
  /// wait for a valid time.
  void keepAlive();

 private:
  void publish();

  const ClockSettings settings_;
  const ros::WallDuration shortest_interval_;
  ros::Publisher publisher_;

  // Guards what follows. Held while /clock is sent, so that stamps go out in their order whichever thread sends them:
  // what roscpp locks for that is locked after it, and none of that is held where roscpp calls back.
  std::mutex mutex_;
  std::optional<FollowedTime> followed_;
  std::uint64_t ticks_ = 0;
  ros::Time stamp_;
  bool is_published_ = true;
  ros::SteadyTime last_published_;
};

}  // namespace sensory_growth::node
