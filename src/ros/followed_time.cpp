#include "sensory_growth/ros/followed_time.h"

#include <algorithm>

#include "sensory_growth/ros/clock.h"

namespace sensory_growth::node {
namespace {

const ros::Duration kMostBehind(1.0);
const ros::Duration kSmallestDifference(0, 1);

}  // namespace

void FollowedTime::hear(const ros::Time& now) {
  went_back_ = went_back_ || now < now_;
  now_ = now;
}

bool FollowedTime::takeBackwardJump() {
  if (!went_back_) return false;
  went_back_ = false;
  last_stamp_ = {};
  stop();
  return true;
}

void FollowedTime::start() {
  begin_ = now_;
  taken_ = 0;
}

ros::Time FollowedTime::tick() {
  ros::Time stamp = now_;
  if (isDue()) {
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
