#pragma once

/// Frames of the organs as tf messages. Pure functions. z of every frame is the tangent (d3), x and y are d1 and d2.

#include <tf2_msgs/TFMessage.h>

#include <string>

#include "sensory_growth/ros/snapshot.h"

namespace sensory_growth::node {

struct FrameSettings {
  std::string world = "world";  ///< parent of all others
  std::string prefix;           ///< put before the organ's id
  int stations = 0;             ///< station k of N stands at k / (N + 1) of the rest arc length
};

/// <organ>/base of every organ.
tf2_msgs::TFMessage staticTransforms(const Snapshot& snapshot, const FrameSettings& settings);

/// <organ>/tip and <organ>/station_<k> of every organ. A frame that is not finite is left out, as tf2 would drop it.
tf2_msgs::TFMessage movingTransforms(const Snapshot& snapshot, const FrameSettings& settings);

}  // namespace sensory_growth::node
