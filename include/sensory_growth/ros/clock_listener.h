#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <rosgraph_msgs/Clock.h>

#include <functional>

#include "sensory_growth/ros/wall_throttle.h"

namespace sensory_growth::node {

/// Tells what /clock says, on a thread of its own, so that no flood on other topics holds it up.
class ClockListener {
 public:
  ClockListener(ros::NodeHandle node, std::function<void(const ros::Time&)> heard);
  ~ClockListener() { spinner_.stop(); }

 private:
  void hear(const ros::Time& now);

  const std::function<void(const ros::Time&)> heard_;
  ros::Time last_;  // of the listening thread alone, like the next
  WallThrottle warnings_;
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::AsyncSpinner spinner_;
};

}  // namespace sensory_growth::node
