#include "sensory_growth/ros/clock.h"

#include <ros/master.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cmath>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

constexpr double kKeepAliveInterval = 0.1;  // [s]

}  // namespace

std::vector<std::string> findClockProblems(ClockMode mode) {
  std::vector<std::string> problems;
  // What counts is what this process found when it started: roscpp reads /use_sim_time only then.
  if (mode == ClockMode::publish && !ros::Time::isSimTime()) {
    problems.push_back("~clock_mode is publish, which needs /use_sim_time to be true before the node starts");
  }
  if (mode == ClockMode::follow && !ros::Time::isSimTime()) {
    problems.push_back("~clock_mode is follow, which needs /use_sim_time to be true before the node starts");
  }
  if (mode == ClockMode::wall && ros::Time::isSimTime()) {
    problems.push_back("~clock_mode is wall, which needs /use_sim_time to be false or absent");
  }
  if (mode == ClockMode::publish) {
    for (const std::string& other : otherClockPublishers()) {
      problems.push_back("~clock_mode is publish, but " + other +
                         " publishes /clock already (if that node is gone, `rosnode cleanup` forgets it)");
    }
  }
  return problems;
}

std::vector<std::string> otherClockPublishers() {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  std::vector<std::string> others;
  if (!ros::master::execute("getSystemState", request, response, state, false)) return others;
  XmlRpc::XmlRpcValue& publishers = state[0];  // pairs of a topic and the nodes that publish it
  for (int i = 0; i < publishers.size(); ++i) {
    if (static_cast<std::string&>(publishers[i][0]) != names::kClock) continue;
    for (int k = 0; k < publishers[i][1].size(); ++k) {
      const std::string& other = publishers[i][1][k];
      if (other != ros::this_node::getName()) others.push_back(other);
    }
  }
  return others;
}

ros::Time stampOf(std::uint64_t ticks, double step) {
  const long double nanoseconds = static_cast<long double>(ticks) * static_cast<long double>(step) * 1e9L;
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(std::llround(nanoseconds)));
  return stamp;
}

Clock::Clock(const ClockSettings& settings, ros::NodeHandle node)
    : settings_(settings), shortest_interval_(1.0 / settings.rate) {
  if (settings_.mode == ClockMode::publish) publisher_ = node.advertise<rosgraph_msgs::Clock>(names::kClock, 10);
  if (settings_.mode == ClockMode::follow) followed_.emplace(settings_.step, ros::Time::now());
}

void Clock::start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (followed_) followed_->start();
}

void Clock::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (followed_) followed_->stop();
}

bool Clock::isDue() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !followed_ || followed_->isDue();
}

void Clock::hear(const ros::Time& now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (followed_) followed_->hear(now);
}

bool Clock::takeBackwardJump() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return followed_ && followed_->takeBackwardJump();
}

std::uint64_t Clock::overruns() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return followed_ ? followed_->overruns() : 0;
}

void Clock::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (followed_) followed_->reset();
  if (settings_.reset_time == ResetTime::keep_time) return;
  ticks_ = 0;
  last_published_ = {};  // whoever listens is told at once
}

ros::Time Clock::tick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++ticks_;
  switch (settings_.mode) {
    case ClockMode::publish:
      stamp_ = stampOf(ticks_, settings_.step);
      is_published_ = false;
      if (ros::SteadyTime::now() - last_published_ >= shortest_interval_) publish();
      break;
    case ClockMode::follow:
      stamp_ = followed_->tick();
      break;
    case ClockMode::wall:
      stamp_ = std::max(ros::Time::now(), stamp_ + ros::Duration(0, 1));
      break;
  }
  return stamp_;
}

void Clock::flush() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_published_) publish();
}

void Clock::keepAlive() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (settings_.mode != ClockMode::publish || ticks_ == 0) return;
  if (ros::SteadyTime::now() - last_published_ >= ros::WallDuration(kKeepAliveInterval)) publish();
}

void Clock::publish() {
  rosgraph_msgs::Clock message;
  message.clock = stamp_;
  publisher_.publish(message);
  is_published_ = true;
  last_published_ = ros::SteadyTime::now();
}

}  // namespace sensory_growth::node
