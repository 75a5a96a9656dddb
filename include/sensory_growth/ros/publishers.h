#pragma once

/// Shows what the simulation does: each message is built once and goes to its topic and, while one is open, to the bag.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <std_msgs/String.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/ros/markers.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/recording.h"
#include "sensory_growth/ros/simulation_loop.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/transforms.h"

namespace sensory_growth::node {

/// The texts a run started from.
struct Sources {
  std::string scenario_name;
  std::string scenario;    ///< YAML as read
  std::string protocol;    ///< YAML as read; empty: none
  std::string parameters;  ///< YAML of the parameters in effect
  std::vector<std::string> organs;
};

class Publishers : public LoopListener {
 public:
  /// `counters` must outlive the publishers.
  Publishers(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
             ros::NodeHandle private_node);

  void onState(const SnapshotPtr& snapshot) override;
  void onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) override;
  void onStimuli(const Snapshot& snapshot) override;
  void onStatus(const LoopStatus& status, const Snapshot& snapshot) override;

  /// Publishes the markers of `snapshot` if anybody looks and they are new. From one thread, any.
  void showMarkers(const SnapshotPtr& snapshot);

  /// Opens a bag and writes what is needed to run the same again. On the thread of the loop. `file` may be empty.
  /// Returns why it failed, or nothing.
  std::optional<std::string> startRecording(const std::string& file, const Snapshot& snapshot);

  /// Hands the open bag over, to be finished elsewhere; null if there is none. On the thread of the loop.
  std::unique_ptr<Recording> takeRecording();

  /// Path of the bag being written; empty if there is none. From any thread.
  std::string recordingPath() const;

 private:
  /// Where a message goes, live and in the bag.
  struct Topic {
    std::string name;  // resolved
    bool is_latched = false;
    ros::Publisher publisher;
  };

  template <typename Message>
  Topic advertise(const std::string& name, std::uint32_t queue, bool is_latched);

  template <typename Message>
  void send(const Topic& topic, const ros::Time& stamp, const boost::shared_ptr<const Message>& message);

  template <typename Message>
  void record(const Topic& topic, const ros::Time& stamp, const boost::shared_ptr<const Message>& message);

  void sendTransforms(const Snapshot& snapshot);
  void recordPreamble(const Snapshot& snapshot);
  void recordMarkers(const Snapshot& snapshot);
  void dropFailedRecording();
  void setRecording(std::unique_ptr<Recording> recording);
  std::string datedFile() const;

  const Parameters parameters_;
  const Sources sources_;
  const FrameSettings frames_;
  const StimulusCounters& counters_;

  ros::NodeHandle node_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_tf_broadcaster_;
  Topic status_, stimuli_, applied_, scenario_, protocol_, parameter_text_, markers_, tf_, tf_static_;
  std::map<std::string, Topic> states_;

  // Of the loop's thread alone.
  std::unique_ptr<Recording> recording_;
  std::optional<MarkerStream> recorded_markers_;
  std::vector<boost::shared_ptr<const AppliedCommand>> history_;  // since the last reset
  std::uint32_t history_epoch_ = 0;
  ros::Time last_tf_stamp_;

  // Of the thread that calls showMarkers() alone.
  std::optional<MarkerStream> live_markers_;
  SnapshotPtr shown_;

  mutable std::mutex path_mutex_;
  std::string recording_path_;
  std::optional<MarkerSettings> marker_settings_;  // set with the first state, constant afterwards
};

}  // namespace sensory_growth::node
