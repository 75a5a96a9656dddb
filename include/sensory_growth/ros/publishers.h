#pragma once

/// The messages of a run on their topics.

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "sensory_growth/ros/reporter.h"
#include "sensory_growth/ros/wall_throttle.h"

namespace sensory_growth::node {

class Publishers : public Reporter {
 public:
  /// `counters` must outlive the publishers.
  Publishers(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
             const ros::NodeHandle& private_node);

  void onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) override;

  /// Publishes the markers of `snapshot` if anybody looks and they or their looks are new. From one thread, any.
  void showMarkers(const SnapshotPtr& snapshot);

 private:
  template <typename Content>
  void advertise(const Topic& topic, std::uint32_t queue);

  void open(const Topic& topic) override;
  void close(const Topic& topic) override;
  void publish(const Topic& topic, const Message& message) override;
  void warn(const RecordingSummary& summary) override;
  void warnOfSize(const std::string& why) override;

  ros::NodeHandle node_;
  tf2_ros::TransformBroadcaster tf_broadcaster_;
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> static_tf_broadcaster_;
  std::map<std::string, ros::Publisher> publishers_;  // by topic, but for markers
  std::uint64_t refused_ = 0;                         // commands
  WallThrottle refusals_;

  // Of the thread that calls showMarkers() alone.
  ros::Publisher markers_publisher_;
  MarkerStream live_markers_;
  SnapshotPtr shown_;
  MarkerSettingsPtr shown_settings_;
};

}  // namespace sensory_growth::node
