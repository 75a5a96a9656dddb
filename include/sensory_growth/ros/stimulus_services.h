#pragma once

/// The services by which stimuli change: as the topics, but with an answer.

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>

#include <optional>
#include <vector>

#include "sensory_growth/ros/simulation_loop.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/world_frame.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

/// Has a thread of its own, because it may wait for a transform.
class StimulusServices {
 public:
  /// Nothing is served before start(). The references must outlive the services.
  StimulusServices(ros::NodeHandle private_node, std::string world_frame, const WorldFrame& world, SimulationLoop& loop,
                   StimulusCounters& counters);

  void start() { spinner_.start(); }
  void stop() { spinner_.stop(); }

 private:
  Answer set(const std::optional<simulation::StimulusCommand>& command, const std_msgs::Header& header);
  Answer refuse(StimulusFate fate, const std::string& why);

  const WorldFrame& world_;
  SimulationLoop& loop_;
  StimulusCounters& counters_;
  ros::CallbackQueue queue_;
  std::vector<ros::ServiceServer> services_;
  ros::AsyncSpinner spinner_;
};

}  // namespace sensory_growth::node
