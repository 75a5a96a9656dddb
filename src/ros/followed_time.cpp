#include "sensory_growth/ros/followed_time.h"

#include <algorithm>
#include <utility>

#include "sensory_growth/ros/clock.h"

namespace sensory_growth::node {
namespace {

const ros::Duration kMostBehind(1.0);
const ros::Duration kSmallestDifference(0, 1);

}  // namespace

void FollowedTime::hear(const ros::Time& now) {
  if (now < now_) went_back_to_ = now;
  now_ = now;
}

bool FollowedTime::takeBackwardJump() {
  if (!went_back_to_) return false;
  last_stamp_ = {};
  if (begin_) begin_ = went_back_to_;
  taken_ = 0;
  went_back_to_.reset();
  return true;
}

void FollowedTime::start() {
  begin_ = now_;
  taken_ = 0;
}

void FollowedTime::reset() {
  is_first_ = true;
  if (begin_ && taken_ > 0) start();  // otherwise time has just begun, or gone back
}

ros::Time FollowedTime::tick() {
  ros::Time stamp = now_;
  if (std::exchange(is_first_, false)) {
    stamp = begin_.value_or(now_);
  } else if (isDue()) {
    if (now_ - due() > kMostBehind) {
      ++overruns_;
      begin_ = now_ - kMostBehind;
      taken_ = 0;
    }
    stamp = due();
    ++taken_;
  }
  last_stamp_ = std::max(stamp, last_stamp_ + kSmallestDifference);
  return last_stamp_;
}

ros::Time FollowedTime::due() const { return *begin_ + (stampOf(taken_ + 1, step_) - ros::Time()); }

}  // namespace sensory_growth::node
