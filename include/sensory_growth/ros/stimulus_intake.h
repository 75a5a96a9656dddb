#pragma once

/// From topics to stimulus commands in the world frame. Nothing gets through that is malformed; everything refused is
/// counted and reported.

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/LightDirection.h"
#include "sensory_growth/PointSource.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/wall_throttle.h"
#include "sensory_growth/ros/world_frame.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

/// All callbacks come from the global queue, which one thread serves.
class StimulusIntake {
 public:
  struct Outputs {
    std::function<bool(const simulation::StimulusCommand&)> send;  ///< false: too many wait already
    std::function<void()> refused;                                 ///< called soon after refusals, once for many
  };

  /// `world` and `counters` must outlive the intake.
  StimulusIntake(ros::NodeHandle node, ros::NodeHandle private_node, const WorldFrame& world,
                 StimulusCounters& counters, Outputs outputs);

  /// Takes what came by a topic, or by hand; the vector is in the frame of `header`. Nothing: its operation is unknown.
  void receive(const std::optional<simulation::StimulusCommand>& command, const std_msgs::Header& header);

 private:
  /// A command whose vector is still in the frame of its message.
  struct Stimulus {
    simulation::StimulusCommand command;
    std_msgs::Header header;
    std::chrono::steady_clock::time_point deadline;
  };

  void lookAgain();
  bool handOn(Stimulus& stimulus, const std::vector<Stimulus>& earlier);
  void refuse(StimulusFate fate, const std::string& why);

  const WorldFrame& world_;
  StimulusCounters& counters_;
  const Outputs outputs_;
  std::vector<Stimulus> waiting_;  // for their transforms, oldest first
  bool has_refused_ = false;
  int clicks_ = 0;
  WallThrottle warnings_;

  ros::Subscriber point_source_, light_direction_, clicked_point_, sun_;
  ros::WallTimer retry_;
};

}  // namespace sensory_growth::node
