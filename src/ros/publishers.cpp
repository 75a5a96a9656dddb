#include "sensory_growth/ros/publishers.h"

#include <ros/console.h>

#include <utility>
#include <variant>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

constexpr std::uint32_t kPublisherQueue = 100;

}  // namespace

Publishers::Publishers(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
                       const ros::NodeHandle& private_node)
    : Reporter(parameters, sources, counters,
               [private_node](const std::string& name) { return private_node.resolveName(name); }),
      node_(private_node),
      refusals_(std::chrono::seconds(1)) {
  advertise<Status>(topics_.status, kPublisherQueue);
  advertise<Stimuli>(topics_.stimuli, kPublisherQueue);
  advertise<AppliedCommand>(topics_.applied, kPublisherQueue);
  advertise<Checkpoint>(topics_.checkpoint, 1);
  advertise<std_msgs::String>(topics_.scenario, 1);
  advertise<std_msgs::String>(topics_.protocol, 1);
  advertise<std_msgs::String>(topics_.parameters, 1);
  markers_publisher_ = node_.advertise<visualization_msgs::MarkerArray>(topics_.markers.name, 10, true);

  publishSources();
}

void Publishers::onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) {
  Reporter::onCommand(command, snapshot);
  if (command.refusal.empty()) return;
  ++refused_;
  if (refusals_.due()) {
    ROS_WARN_STREAM_NAMED(names::kLogSimulation, "command refused (" << refused_ << " so far): " << command.refusal);
  }
}

void Publishers::showMarkers(const SnapshotPtr& snapshot) {
  const MarkerSettingsPtr settings = markerSettings();
  if (snapshot == shown_ && settings == shown_settings_) return;
  // Drawn once even if nobody looks, so that there is something to latch.
  if (shown_ && markers_publisher_.getNumSubscribers() == 0) return;
  // Viewers forget what they drew when time runs backwards.
  if (shown_ && snapshot->stamp < shown_->stamp) live_markers_ = MarkerStream();
  markers_publisher_.publish(
      boost::make_shared<const visualization_msgs::MarkerArray>(live_markers_.next(*snapshot, *settings)));
  shown_ = snapshot;
  shown_settings_ = settings;
}

void Publishers::open(const Topic& topic) { advertise<OrganState>(topic, kPublisherQueue); }

void Publishers::close(const Topic& topic) { publishers_.erase(topic.name); }

template <typename Content>
void Publishers::advertise(const Topic& topic, std::uint32_t queue) {
  publishers_[topic.name] = node_.advertise<Content>(topic.name, queue, topic.is_latched);
}

void Publishers::publish(const Topic& topic, const Message& message) {
  if (const auto* transforms = std::get_if<boost::shared_ptr<const tf2_msgs::TFMessage>>(&message)) {
    if (topic.name != topics_.tf_static.name) return tf_broadcaster_.sendTransform((*transforms)->transforms);
    // A broadcaster repeats all it ever sent; only a new one leaves out what is gone.
    static_tf_broadcaster_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
    return static_tf_broadcaster_->sendTransform((*transforms)->transforms);
  }
  std::visit([&](const auto& content) { publishers_.at(topic.name).publish(content); }, message);
}

void Publishers::warn(const RecordingSummary& summary) {
  ROS_WARN_STREAM_NAMED(names::kLogRecording, "recording of " << summary.path << " stopped after " << summary.messages
                                                              << " messages: " << summary.error);
}

void Publishers::warnOfSize(const std::string& why) {
  ROS_WARN_STREAM_NAMED(names::kLogRecording, recordingPath() << " is full and goes on: " << why);
}

}  // namespace sensory_growth::node
