#pragma once

/// Stimuli that were sent in other frames, in that of the world.

#include <geometry_msgs/TransformStamped.h>
#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/transform_listener.h>

#include <chrono>
#include <optional>
#include <string>

#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

/// How long transforms are kept [ROS time, s] if the frames of the organs are sent every `step` [s]: for as long as a
/// stimulus may be on its way, but no more of them than memory takes, however short the step.
double transformMemory(double step);

/// Thread-safe.
class WorldFrame {
 public:
  /// How long a transform may be waited for, in wall time, as ROS time may stand still; and how often to look.
  static constexpr std::chrono::seconds kPatience{1};
  static constexpr std::chrono::milliseconds kRetryInterval{50};

  /// `step` is the ROS time between two states [s].
  WorldFrame(std::string name, double step);

  /// Turns the vector of the command from the frame of its header into that of the world, or leaves it and returns why
  /// not. `is_overdue` after patience has ended: then what moved last is taken to stand there still.
  std::optional<std::string> transform(simulation::StimulusCommand& command, const std_msgs::Header& header,
                                       bool is_overdue) const;

 private:
  geometry_msgs::TransformStamped transformOf(const std_msgs::Header& header, bool is_overdue) const;

  const std::string name_;
  tf2::BufferCore transforms_;
  tf2_ros::TransformListener listener_;
};

}  // namespace sensory_growth::node
