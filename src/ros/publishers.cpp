#include "sensory_growth/ros/publishers.h"

#include <ros/console.h>

#include <utility>
#include <variant>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

constexpr std::uint32_t kQueue = 100;

}  // namespace

Publishers::Publishers(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
                       ros::NodeHandle private_node)
    : Reporter(parameters, sources, counters, [&](const std::string& name) { return private_node.resolveName(name); }),
      node_(std::move(private_node)) {
  advertise<Status>(topics_.status, kQueue);
  advertise<Stimuli>(topics_.stimuli, kQueue);
  advertise<AppliedCommand>(topics_.applied, kQueue);
  advertise<Checkpoint>(topics_.checkpoint, 1);
  advertise<std_msgs::String>(topics_.scenario, 1);
  advertise<std_msgs::String>(topics_.protocol, 1);
  advertise<std_msgs::String>(topics_.parameters, 1);
  advertise<visualization_msgs::MarkerArray>(topics_.markers, 10);
  for (const auto& [organ, topic] : topics_.states) advertise<OrganState>(topic, kQueue);

  publishSources();
}

void Publishers::onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) {
  Reporter::onCommand(command, snapshot);
  if (!command.refusal.empty()) ROS_WARN_STREAM_NAMED(names::kLogSimulation, "command refused: " << command.refusal);
}

void Publishers::showMarkers(const SnapshotPtr& snapshot) {
  if (snapshot == shown_) return;
  const ros::Publisher& publisher = publishers_.at(topics_.markers.name);
  // Drawn once even if nobody looks, so that there is something to latch.
  if (shown_ && publisher.getNumSubscribers() == 0) return;
  // Viewers forget what they drew when time runs backwards.
  if (shown_ && snapshot->stamp < shown_->stamp) live_markers_.reset();
  if (!live_markers_) live_markers_.emplace(*marker_settings_);
  publisher.publish(boost::make_shared<const visualization_msgs::MarkerArray>(live_markers_->next(*snapshot)));
  shown_ = snapshot;
}

template <typename Content>
void Publishers::advertise(const Topic& topic, std::uint32_t queue) {
  publishers_[topic.name] = node_.advertise<Content>(topic.name, queue, topic.is_latched);
}

void Publishers::publish(const Topic& topic, const Message& message) {
  if (const auto* transforms = std::get_if<boost::shared_ptr<const tf2_msgs::TFMessage>>(&message)) {
    const bool is_static = topic.name == topics_.tf_static.name;
    if (is_static) static_tf_broadcaster_.sendTransform((*transforms)->transforms);
    if (!is_static) tf_broadcaster_.sendTransform((*transforms)->transforms);
    return;
  }
  std::visit([&](const auto& content) { publishers_.at(topic.name).publish(content); }, message);
}

void Publishers::warn(const RecordingSummary& summary) {
  ROS_WARN_STREAM_NAMED(names::kLogRecording, "recording of " << summary.path << " stopped after " << summary.messages
                                                              << " messages: " << summary.error);
}

}  // namespace sensory_growth::node
