#include "sensory_growth/ros/clock_listener.h"

#include <ros/console.h>
#include <ros/subscribe_options.h>

#include <cstdint>
#include <utility>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

constexpr std::uint32_t kClockQueue = 10;

}  // namespace

ClockListener::ClockListener(ros::NodeHandle node, std::function<void(const ros::Time&)> heard)
    : heard_(std::move(heard)), warnings_(std::chrono::seconds(1)), spinner_(1, &queue_) {
  ros::SubscribeOptions options;
  options.init<rosgraph_msgs::Clock>(names::kClock, kClockQueue,
                                     [this](const rosgraph_msgs::Clock::ConstPtr& message) { hear(message->clock); });
  options.callback_queue = &queue_;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscriber_ = node.subscribe(options);
  spinner_.start();
}

void ClockListener::hear(const ros::Time& now) {
  if (now < last_ && warnings_.due()) {
    ROS_WARN_STREAM_NAMED(names::kLogRos, names::kClock << " went back from " << last_ << " to " << now << " s");
  }
  last_ = now;
  heard_(now);
}

}  // namespace sensory_growth::node
