#include "sensory_growth/ros/reporter.h"

#include <ctime>
#include <exception>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

template <typename Content>
boost::shared_ptr<const Content> shared(Content message) {
  return boost::make_shared<const Content>(std::move(message));
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

Reporter::Reporter(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
                   const Resolve& resolve)
    : parameters_(parameters),
      sources_(sources),
      topics_(makeTopics(sources.organs, resolve)),
      frames_{parameters.world_frame, parameters.frame_prefix, parameters.stations},
      counters_(counters) {}

Reporter::Topics Reporter::makeTopics(const std::vector<std::string>& organs, const Resolve& resolve) {
  Topics topics;
  topics.status = {resolve(names::kStatus), true};
  topics.stimuli = {resolve(names::kStimuli), true};
  topics.applied = {resolve(names::kAppliedCommands), false};
  topics.scenario = {resolve(names::kScenario), true};
  topics.protocol = {resolve(names::kProtocol), true};
  topics.parameters = {resolve(names::kParameters), true};
  topics.markers = {resolve(names::kMarkers), true};
  topics.tf = {resolve(names::kTf), false};
  topics.tf_static = {resolve(names::kTfStatic), true};
  for (const std::string& organ : organs) {
    topics.states[organ] = {resolve(std::string(names::kOrgans) + "/" + organ + "/" + names::kState), true};
  }
  return topics;
}

void Reporter::onState(const SnapshotPtr& snapshot) {
  if (!marker_settings_) {
    marker_settings_ = makeMarkerSettings(parameters_, *snapshot);
    publish(topics_.tf_static, shared(staticTransforms(*snapshot, frames_)));
  }
  if (snapshot->epoch != history_epoch_) {
    history_.clear();
    history_epoch_ = snapshot->epoch;
  }
  for (const OrganSnapshot& organ : snapshot->organs) {
    send(topics_.states.at(organ.id), snapshot->stamp, shared(toMessage(organ, *snapshot, parameters_.world_frame)));
  }
  sendTransforms(*snapshot);
  recordMarkers(*snapshot);
}

void Reporter::onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) {
  history_.push_back(shared(toMessage(command, snapshot, parameters_.world_frame)));
  send(topics_.applied, snapshot.stamp, history_.back());
}

void Reporter::onStimuli(const Snapshot& snapshot) {
  send(topics_.stimuli, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
}

void Reporter::onStatus(const RunStatus& status, const Snapshot& snapshot) {
  dropFailedRecording();
  Status message;
  message.header = makeHeader(snapshot, parameters_.world_frame);
  message.mode = toConstant(status.mode);
  message.message = status.message;
  message.scenario = sources_.scenario_name;
  message.step_index = snapshot.step_index;
  message.epoch = snapshot.epoch;
  message.checksum = snapshot.checksum;
  message.growth_time = snapshot.growth_time;
  message.growth_time_scale = parameters_.growth_time_scale;
  message.real_time_factor = status.real_time_factor;
  message.achieved_real_time_factor = status.achieved_real_time_factor;
  message.overruns = status.overruns;
  message.stimuli_accepted = counters_.of(StimulusFate::accepted);
  message.stimuli_refused = counters_.refused();
  message.recording = recording_ ? recording_->path() : "";
  send(topics_.status, snapshot.stamp, shared(std::move(message)));
}

std::optional<std::string> Reporter::startRecording(const std::string& file, const Snapshot& snapshot) {
  if (recording_) return "already recording " + recording_->path();
  try {
    const std::string path = node::recordingPath(parameters_.recording_directory, file.empty() ? datedFile() : file);
    setRecording(std::make_unique<Recording>(
        path,
        RecordingSettings{parameters_.recording_compression, parameters_.recording_minimum_free_space, sources_.node}));
  } catch (const std::exception& refusal) {
    return refusal.what();
  }
  recordPreamble(snapshot);
  return std::nullopt;
}

std::unique_ptr<Recording> Reporter::takeRecording() {
  std::unique_ptr<Recording> recording = std::move(recording_);
  setRecording(nullptr);
  return recording;
}

std::string Reporter::recordingPath() const {
  const std::lock_guard<std::mutex> lock(path_mutex_);
  return recording_path_;
}

Message Reporter::textMessage(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  return shared(std::move(message));
}

void Reporter::send(const Topic& topic, const ros::Time& stamp, const Message& message) {
  publish(topic, message);
  record(topic, stamp, message);
}

void Reporter::record(const Topic& topic, const ros::Time& stamp, const Message& message) {
  if (!recording_) return;
  std::visit([&](const auto& content) { recording_->write(topic.name, topic.is_latched, stamp, content); }, message);
}

void Reporter::sendTransforms(const Snapshot& snapshot) {
  if (snapshot.stamp <= last_tf_stamp_) return;  // tf2 warns about repeated stamps
  last_tf_stamp_ = snapshot.stamp;
  send(topics_.tf, snapshot.stamp, shared(movingTransforms(snapshot, frames_)));
}

void Reporter::recordPreamble(const Snapshot& snapshot) {
  record(topics_.parameters, snapshot.stamp, textMessage(sources_.parameters));
  record(topics_.scenario, snapshot.stamp, textMessage(sources_.scenario));
  if (!sources_.protocol.empty()) record(topics_.protocol, snapshot.stamp, textMessage(sources_.protocol));
  record(topics_.tf_static, snapshot.stamp, shared(staticTransforms(snapshot, frames_)));
  for (const auto& command : history_) record(topics_.applied, snapshot.stamp, command);
  record(topics_.stimuli, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
  for (const OrganSnapshot& organ : snapshot.organs) {
    record(topics_.states.at(organ.id), snapshot.stamp, shared(toMessage(organ, snapshot, parameters_.world_frame)));
  }
  record(topics_.tf, snapshot.stamp, shared(movingTransforms(snapshot, frames_)));
  recordMarkers(snapshot);
}

void Reporter::recordMarkers(const Snapshot& snapshot) {
  if (!recording_ || parameters_.recording_marker_every == 0) return;
  const bool is_first = !recorded_markers_;
  if (is_first) recorded_markers_.emplace(*marker_settings_);
  if (!is_first && snapshot.step_index % static_cast<std::uint64_t>(parameters_.recording_marker_every) != 0) return;
  record(topics_.markers, snapshot.stamp, shared(recorded_markers_->next(snapshot)));
}

void Reporter::dropFailedRecording() {
  if (!recording_ || !recording_->failed()) return;
  warn(takeRecording()->finish());
}

void Reporter::setRecording(std::unique_ptr<Recording> recording) {
  recording_ = std::move(recording);
  recorded_markers_.reset();
  const std::lock_guard<std::mutex> lock(path_mutex_);
  recording_path_ = recording_ ? recording_->path() : "";
}

std::string Reporter::datedFile() const {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d-%H-%M-%S", &local);
  return sources_.scenario_name + "_" + date + ".bag";
}

}  // namespace sensory_growth::node
