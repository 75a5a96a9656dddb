#pragma once

/// The simulation as a ROS node: wires loop, clock, topics, services and diagnostics together.

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <ros/wall_timer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/Command.h"
#include "sensory_growth/LoadCheckpoint.h"
#include "sensory_growth/RemoveOrgan.h"
#include "sensory_growth/SaveCheckpoint.h"
#include "sensory_growth/SetGravity.h"
#include "sensory_growth/SetParameter.h"
#include "sensory_growth/SetRealTimeFactor.h"
#include "sensory_growth/SpawnOrgan.h"
#include "sensory_growth/SplitRecording.h"
#include "sensory_growth/StartRecording.h"
#include "sensory_growth/Step.h"
#include "sensory_growth/StopRecording.h"
#include "sensory_growth/ros/checkpoints.h"
#include "sensory_growth/ros/clock.h"
#include "sensory_growth/ros/clock_listener.h"
#include "sensory_growth/ros/diagnostics.h"
#include "sensory_growth/ros/live_parameters.h"
#include "sensory_growth/ros/loaded_scenario.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/publishers.h"
#include "sensory_growth/ros/signals.h"
#include "sensory_growth/ros/simulation_loop.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/stimulus_handles.h"
#include "sensory_growth/ros/stimulus_intake.h"
#include "sensory_growth/ros/stimulus_services.h"
#include "sensory_growth/ros/world_frame.h"

namespace sensory_growth::node {

class Node {
 public:
  /// Throws std::exception if the simulation cannot be built or the bag of ~record not opened.
  Node(const Parameters& parameters, LoadedScenario loaded);

  /// Answers waiting services, closes the bag.
  ~Node();

  /// Runs until a signal, a shutdown of ROS, or the end of the scenario if ~exit_when_finished. Returns the exit code.
  int run(const Signals& signals);

 private:
  void startRecording(const StartRecording::Request& request, StartRecording::Response& response);
  void splitRecording(SplitRecording::Response& response);
  void stopRecording(StopRecording::Response& response);
  void advertiseServices();
  void startTimers();
  void showMarkers();
  Answer setRealTimeFactor(double factor);
  std::optional<std::string> use(const Parameters& before, const Parameters& now);
  void logProgress() const;

  const Parameters parameters_;
  const double step_;  // ROS time [s]
  ros::NodeHandle node_, private_node_;

  // A service that blocks must not keep others waiting, nor the topics: each kind has its own queue and thread.
  ros::CallbackQueue control_queue_, step_queue_, health_queue_;  // the last asks the master, which may be gone

  StimulusCounters counters_;
  Clock clock_;
  Publishers publishers_;
  WorldFrame world_;  // before the loop, so that it hears the transforms of the first state
  StimulusIntake intake_;
  SimulationLoop loop_;
  Checkpoints checkpoints_;
  StimulusServices stimulus_services_;
  LiveParameters live_;
  std::unique_ptr<Diagnostics> diagnostics_;
  std::unique_ptr<ClockListener> clock_listener_;
  std::unique_ptr<StimulusHandles> handles_;  // if ~interactive_markers
  std::vector<ros::ServiceServer> services_;
  std::vector<ros::WallTimer> timers_;
  ros::WallTimer marker_timer_;
  ros::AsyncSpinner topic_spinner_, control_spinner_, step_spinner_, health_spinner_;
};

/// Everything from the parameters to the exit code. `ros::init` comes before.
int runNode(const Signals& signals);

}  // namespace sensory_growth::node
