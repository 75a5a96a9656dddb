#include "sensory_growth/ros/publishers.h"

#include <ros/console.h>
#include <ros/this_node.h>
#include <tf2_msgs/TFMessage.h>

#include <ctime>
#include <stdexcept>

#include "sensory_growth/Stimuli.h"
#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

constexpr std::uint32_t kQueue = 100;

template <typename Message>
boost::shared_ptr<const Message> shared(Message message) {
  return boost::make_shared<const Message>(std::move(message));
}

boost::shared_ptr<const std_msgs::String> text(const std::string& data) {
  std_msgs::String message;
  message.data = data;
  return shared(std::move(message));
}

std::uint8_t toConstant(Mode mode) {
  switch (mode) {
    case Mode::paused:
      return Status::PAUSED;
    case Mode::running:
      return Status::RUNNING;
    case Mode::finished:
      return Status::FINISHED;
    case Mode::fault:
      return Status::FAULT;
  }
  return Status::UNKNOWN;
}

}  // namespace

Publishers::Publishers(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
                       ros::NodeHandle private_node)
    : parameters_(parameters),
      sources_(sources),
      frames_{parameters.world_frame, parameters.frame_prefix, parameters.stations},
      counters_(counters),
      node_(std::move(private_node)) {
  status_ = advertise<Status>(names::kStatus, kQueue, true);
  stimuli_ = advertise<Stimuli>(names::kStimuli, kQueue, true);
  applied_ = advertise<AppliedCommand>(names::kAppliedCommands, kQueue, false);
  scenario_ = advertise<std_msgs::String>(names::kScenario, 1, true);
  parameter_text_ = advertise<std_msgs::String>(names::kParameters, 1, true);
  markers_ = advertise<visualization_msgs::MarkerArray>(names::kMarkers, 10, true);
  for (const std::string& organ : sources_.organs) {
    states_[organ] =
        advertise<OrganState>(std::string(names::kOrgans) + "/" + organ + "/" + names::kState, kQueue, true);
  }
  tf_ = {node_.resolveName(names::kTf), false, {}};
  tf_static_ = {node_.resolveName(names::kTfStatic), true, {}};

  parameter_text_.publisher.publish(text(sources_.parameters));
  scenario_.publisher.publish(text(sources_.scenario));
  if (!sources_.protocol.empty()) {
    protocol_ = advertise<std_msgs::String>(names::kProtocol, 1, true);
    protocol_.publisher.publish(text(sources_.protocol));
  }
}

void Publishers::onState(const SnapshotPtr& snapshot) {
  if (!marker_settings_) {
    marker_settings_ = makeMarkerSettings(parameters_, *snapshot);
    static_tf_broadcaster_.sendTransform(staticTransforms(*snapshot, frames_).transforms);
  }
  if (snapshot->epoch != history_epoch_) {
    history_.clear();
    history_epoch_ = snapshot->epoch;
  }
  for (const OrganSnapshot& organ : snapshot->organs) {
    send(states_.at(organ.id), snapshot->stamp, shared(toMessage(organ, *snapshot, parameters_.world_frame)));
  }
  sendTransforms(*snapshot);
  recordMarkers(*snapshot);
}

void Publishers::onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) {
  history_.push_back(shared(toMessage(command, snapshot, parameters_.world_frame)));
  send(applied_, snapshot.stamp, history_.back());
  if (!command.refusal.empty()) ROS_WARN_STREAM_NAMED(names::kLogSimulation, "command refused: " << command.refusal);
}

void Publishers::onStimuli(const Snapshot& snapshot) {
  send(stimuli_, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
}

void Publishers::onStatus(const LoopStatus& status, const Snapshot& snapshot) {
  dropFailedRecording();
  Status message;
  message.header = makeHeader(snapshot, parameters_.world_frame);
  message.mode = toConstant(status.mode);
  message.message = status.message;
  message.scenario = sources_.scenario_name;
  message.step_index = snapshot.step_index;
  message.epoch = snapshot.epoch;
  message.growth_time = snapshot.growth_time;
  message.growth_time_scale = parameters_.growth_time_scale;
  message.real_time_factor = parameters_.real_time_factor;
  message.achieved_real_time_factor = status.achieved_real_time_factor;
  message.overruns = status.overruns;
  message.stimuli_accepted = counters_.of(StimulusFate::accepted);
  message.stimuli_refused = counters_.refused();
  message.recording = recording_ ? recording_->path() : "";
  send(status_, snapshot.stamp, shared(std::move(message)));
}

void Publishers::showMarkers(const SnapshotPtr& snapshot) {
  if (snapshot == shown_) return;
  // Drawn once even if nobody looks, so that there is something to latch.
  if (shown_ && markers_.publisher.getNumSubscribers() == 0) return;
  if (!live_markers_) live_markers_.emplace(*marker_settings_);
  markers_.publisher.publish(shared(live_markers_->next(*snapshot)));
  shown_ = snapshot;
}

std::optional<std::string> Publishers::startRecording(const std::string& file, const Snapshot& snapshot) {
  if (recording_) return "already recording " + recording_->path();
  try {
    const std::string path = node::recordingPath(parameters_.recording_directory, file.empty() ? datedFile() : file);
    setRecording(std::make_unique<Recording>(
        path, RecordingSettings{parameters_.recording_compression, parameters_.recording_minimum_free_space,
                                ros::this_node::getName()}));
  } catch (const std::exception& refusal) {
    return refusal.what();
  }
  recordPreamble(snapshot);
  return std::nullopt;
}

std::unique_ptr<Recording> Publishers::takeRecording() {
  std::unique_ptr<Recording> recording = std::move(recording_);
  setRecording(nullptr);
  return recording;
}

std::string Publishers::recordingPath() const {
  const std::lock_guard<std::mutex> lock(path_mutex_);
  return recording_path_;
}

template <typename Message>
Publishers::Topic Publishers::advertise(const std::string& name, std::uint32_t queue, bool is_latched) {
  Topic topic{node_.resolveName(name), is_latched, node_.advertise<Message>(name, queue, is_latched)};
  return topic;
}

template <typename Message>
void Publishers::send(const Topic& topic, const ros::Time& stamp, const boost::shared_ptr<const Message>& message) {
  topic.publisher.publish(message);
  record(topic, stamp, message);
}

template <typename Message>
void Publishers::record(const Topic& topic, const ros::Time& stamp, const boost::shared_ptr<const Message>& message) {
  if (recording_) recording_->write(topic.name, topic.is_latched, stamp, message);
}

void Publishers::sendTransforms(const Snapshot& snapshot) {
  if (snapshot.stamp <= last_tf_stamp_) return;  // tf2 warns about repeated stamps
  last_tf_stamp_ = snapshot.stamp;
  const auto message = shared(movingTransforms(snapshot, frames_));
  tf_broadcaster_.sendTransform(message->transforms);
  record(tf_, snapshot.stamp, message);
}

void Publishers::recordPreamble(const Snapshot& snapshot) {
  record(parameter_text_, snapshot.stamp, text(sources_.parameters));
  record(scenario_, snapshot.stamp, text(sources_.scenario));
  if (!sources_.protocol.empty()) record(protocol_, snapshot.stamp, text(sources_.protocol));
  record(tf_static_, snapshot.stamp, shared(staticTransforms(snapshot, frames_)));
  for (const auto& command : history_) record(applied_, snapshot.stamp, command);
  record(stimuli_, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
  for (const OrganSnapshot& organ : snapshot.organs) {
    record(states_.at(organ.id), snapshot.stamp, shared(toMessage(organ, snapshot, parameters_.world_frame)));
  }
  record(tf_, snapshot.stamp, shared(movingTransforms(snapshot, frames_)));
  recordMarkers(snapshot);
}

void Publishers::recordMarkers(const Snapshot& snapshot) {
  if (!recording_ || parameters_.recording_marker_every == 0) return;
  const bool is_first = !recorded_markers_;
  if (is_first) recorded_markers_.emplace(*marker_settings_);
  if (!is_first && snapshot.step_index % static_cast<std::uint64_t>(parameters_.recording_marker_every) != 0) return;
  record(markers_, snapshot.stamp, shared(recorded_markers_->next(snapshot)));
}

void Publishers::dropFailedRecording() {
  if (!recording_ || !recording_->failed()) return;
  const RecordingSummary summary = takeRecording()->finish();
  ROS_WARN_STREAM_NAMED(names::kLogRecording, "recording of " << summary.path << " stopped after " << summary.messages
                                                              << " messages: " << summary.error);
}

void Publishers::setRecording(std::unique_ptr<Recording> recording) {
  recording_ = std::move(recording);
  recorded_markers_.reset();
  const std::lock_guard<std::mutex> lock(path_mutex_);
  recording_path_ = recording_ ? recording_->path() : "";
}

std::string Publishers::datedFile() const {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d-%H-%M-%S", &local);
  return sources_.scenario_name + "_" + date + ".bag";
}

}  // namespace sensory_growth::node
