#pragma once

/// When steps are due by a clock that somebody else owns, and which stamps they bear. Knows neither topics nor threads.

#include <ros/time.h>

#include <cstdint>
#include <optional>

namespace sensory_growth::node {

class FollowedTime {
 public:
  /// `step` is the ROS time of a step, at most 1 [s].
  FollowedTime(double step, const ros::Time& now) : step_(step), now_(now) {}

  /// The clock says `now`.
  void hear(const ros::Time& now);

  /// True if the clock went backwards since the last call. Then stamps may go back, and steps that are due count from
  /// the time to which it went.
  bool takeBackwardJump();

  /// Running begins: the first step is due one step from now.
  void start();

  /// Running ends: nothing is due.
  void stop() { begin_.reset(); }

  /// A reset: the next state is the first, and steps that are due count from it.
  void reset();

  bool isDue() const { return begin_ && due() <= now_; }

  /// The stamp of a new state, later than all before: of a step that is due, the time at which it fell due, whenever
  /// the clock was heard; of any other, the time now. Of steps that are more than a second late, the earliest are given
  /// up and counted as one overrun.
  ros::Time tick();

  std::uint64_t overruns() const { return overruns_; }

 private:
  ros::Time due() const;

  const double step_;
  ros::Time now_;
  ros::Time last_stamp_;
  std::optional<ros::Time> begin_;  // steps are due at whole numbers of steps from here; nothing: none is
  std::uint64_t taken_ = 0;         // steps since then
  std::uint64_t overruns_ = 0;
  std::optional<ros::Time> went_back_to_;
  bool is_first_ = false;  // of the next state
};

}  // namespace sensory_growth::node
