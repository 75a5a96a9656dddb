#include "sensory_growth/ros/reporter.h"

#include <algorithm>
#include <ctime>
#include <exception>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/loaded_scenario.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

template <typename Content>
boost::shared_ptr<const Content> shared(Content message) {
  return boost::make_shared<const Content>(std::move(message));
}

Message textMessage(const std::string& text) {
  std_msgs::String message;
  message.data = text;
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

constexpr std::size_t kLongestHistory = std::size_t{4} << 20U;  // [byte]

}  // namespace

Reporter::Reporter(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
                   const Resolve& resolve)
    : parameters_(parameters),
      sources_(sources),
      topics_(makeTopics(resolve)),
      resolve_(resolve),
      frames_{parameters.world_frame, parameters.frame_prefix, parameters.stations},
      counters_(counters),
      recorder_({parameters.recording_directory,
                 static_cast<std::uint64_t>(parameters.recording_split_size),
                 {parameters.recording_compression, parameters.recording_minimum_free_space, sources.node}}) {}

Reporter::Topics Reporter::makeTopics(const Resolve& resolve) {
  Topics topics;
  topics.status = {resolve(names::kStatus), true};
  topics.stimuli = {resolve(names::kStimuli), true};
  topics.applied = {resolve(names::kAppliedCommands), false};
  topics.checkpoint = {resolve(names::kCheckpoint), true};
  topics.scenario = {resolve(names::kScenario), true};
  topics.protocol = {resolve(names::kProtocol), true};
  topics.parameters = {resolve(names::kParameters), true};
  topics.markers = {resolve(names::kMarkers), true};
  topics.tf = {resolve(names::kTf), false};
  topics.tf_static = {resolve(names::kTfStatic), true};
  return topics;
}

void Reporter::onCheckpoint(const simulation::Checkpoint& checkpoint, const Snapshot& snapshot) {
  // Not recorded: the texts in a bag are those that it began with, the others are in its checkpoints.
  sources_.scenario = checkpoint.scenario;
  sources_.protocol = checkpoint.protocol;
  publishSources();
  beginHistory(snapshot.epoch);
  origin_ = shared(toMessage(checkpoint, snapshot, parameters_.world_frame));
  send(topics_.checkpoint, snapshot.stamp, *origin_);
  if (!first_) return;
  sendBases(snapshot);
  first_ = std::make_shared<const Snapshot>(snapshot);  // of another scenario, perhaps of another size
  setMarkerSettings();
}

void Reporter::onState(const SnapshotPtr& snapshot) {
  const bool begins = !first_ || snapshot->epoch != history_epoch_;
  if (!first_) {
    first_ = snapshot;
    setMarkerSettings();
  }
  if (snapshot->epoch != history_epoch_) beginHistory(snapshot->epoch);
  followOrgans(*snapshot);
  if (snapshot->stamp < last_stamp_) {
    goBack(*snapshot);
  } else if (begins) {
    sendBases(*snapshot);
  }
  for (const OrganSnapshot& organ : snapshot->organs) sendState(organ, *snapshot);
  sendTransforms(*snapshot);
  recordMarkers(*snapshot);
}

void Reporter::onOrgans(const SnapshotPtr& snapshot) {
  const std::set<std::string> fresh = followOrgans(*snapshot);
  sendBases(*snapshot);
  for (const OrganSnapshot& organ : snapshot->organs) {
    if (fresh.count(organ.id)) sendState(organ, *snapshot);
  }
  sendTransforms(*snapshot);
  recordMarkers(*snapshot);
}

void Reporter::onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) {
  const auto message = shared(toMessage(command, snapshot, parameters_.world_frame));
  send(topics_.applied, snapshot.stamp, message);
  history_.push_back(message);
  history_size_ += ros::serialization::serializationLength(*message);
}

void Reporter::onStimuli(const Snapshot& snapshot) {
  send(topics_.stimuli, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
}

void Reporter::onStatus(const RunStatus& status, const Snapshot& snapshot) {
  if (const auto failure = recorder_.takeFailure()) warn(*failure);
  Status message;
  message.header = makeHeader(snapshot, parameters_.world_frame);
  message.mode = toConstant(status.mode);
  message.message = status.message;
  message.scenario = snapshot.scenario;
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
  message.recording = recorder_.path();
  const Message shown = shared(std::move(message));
  send(topics_.status, snapshot.stamp, shown);
  if (!recorder_.isFull()) return;
  if (const auto refusal = splitRecording(snapshot)) return warnOfSize(*refusal);
  record(topics_.status, snapshot.stamp, shown);
}

/// However many commands are taken, a bag begins with few: of a long history the state that it led to is enough.
void Reporter::onSettled(const Run& run) {
  if (history_size_ <= kLongestHistory) return;
  const SnapshotPtr snapshot = run.snapshot();
  beginHistory(snapshot->epoch);
  origin_ = shared(toMessage(checkpointOf(run.state()), *snapshot, parameters_.world_frame));
}

simulation::Checkpoint Reporter::checkpointOf(simulation::SimulationState state) const {
  return {version(), sources_.scenario, sources_.protocol, std::move(state)};
}

void Reporter::setParameters(const Parameters& parameters, const Snapshot& snapshot) {
  parameters_ = parameters;
  sources_.parameters = describeEffective(parameters_, sources_.node);
  setMarkerSettings();
  send(topics_.parameters, snapshot.stamp, textMessage(sources_.parameters));
}

std::optional<std::string> Reporter::startRecording(const std::string& file, const Snapshot& snapshot) {
  if (auto refusal = recorder_.start(file.empty() ? datedFile(snapshot) : file)) return refusal;
  beginBag(snapshot);
  recordState(snapshot);
  return std::nullopt;
}

std::optional<std::string> Reporter::splitRecording(const Snapshot& snapshot) {
  if (auto refusal = recorder_.split()) return refusal;
  beginBag(snapshot);
  recordState(snapshot);
  return std::nullopt;
}

std::unique_ptr<Recording> Reporter::takeRecording() { return recorder_.take(); }

void Reporter::publishSources() {
  for (const auto& [topic, message] : sources()) publish(topic, message);
}

MarkerSettingsPtr Reporter::markerSettings() const {
  const std::lock_guard<std::mutex> lock(markers_mutex_);
  return marker_settings_;
}

void Reporter::setMarkerSettings() {
  auto settings = std::make_shared<const MarkerSettings>(makeMarkerSettings(parameters_, *first_));
  const std::lock_guard<std::mutex> lock(markers_mutex_);
  marker_settings_ = std::move(settings);
}

/// Opens and closes topics as organs came and went. Returns the ids of those that came.
std::set<std::string> Reporter::followOrgans(const Snapshot& snapshot) {
  std::set<std::string> present, fresh;
  for (const OrganSnapshot& organ : snapshot.organs) present.insert(organ.id);
  for (auto state = states_.begin(); state != states_.end();) {
    if (present.count(state->first)) {
      ++state;
    } else {
      close(state->second);
      state = states_.erase(state);
    }
  }
  for (const std::string& organ : present) {
    if (states_.count(organ)) continue;
    const Topic topic{resolve_(std::string(names::kOrgans) + "/" + organ + "/" + names::kState), true};
    states_.emplace(organ, topic);
    open(topic);
    fresh.insert(organ);
  }
  return fresh;
}

void Reporter::sendBases(const Snapshot& snapshot) {
  send(topics_.tf_static, snapshot.stamp, shared(staticTransforms(snapshot, frames_)));
}

void Reporter::sendState(const OrganSnapshot& organ, const Snapshot& snapshot) {
  send(states_.at(organ.id), snapshot.stamp, shared(toMessage(organ, snapshot, parameters_.world_frame)));
}

void Reporter::send(const Topic& topic, const ros::Time& stamp, const Message& message) {
  publish(topic, message);
  record(topic, stamp, message);
}

void Reporter::record(const Topic& topic, const ros::Time& stamp, const Message& message) {
  Recording* recording = recorder_.recording();
  if (!recording) return;
  std::visit([&](const auto& content) { recording->write(topic.name, topic.is_latched, stamp, content); }, message);
}

void Reporter::beginHistory(std::uint32_t epoch) {
  origin_.reset();
  history_.clear();
  history_size_ = 0;
  history_epoch_ = epoch;
}

void Reporter::sendTransforms(const Snapshot& snapshot) {
  if (snapshot.stamp != last_stamp_) frames_sent_.clear();
  last_stamp_ = snapshot.stamp;
  tf2_msgs::TFMessage message = movingTransforms(snapshot, frames_);
  const auto is_sent = [this](const geometry_msgs::TransformStamped& transform) {
    return !frames_sent_.insert(transform.child_frame_id).second;  // tf2 warns about repeated stamps
  };
  auto& transforms = message.transforms;
  transforms.erase(std::remove_if(transforms.begin(), transforms.end(), is_sent), transforms.end());
  if (!transforms.empty()) send(topics_.tf, snapshot.stamp, shared(std::move(message)));
}

void Reporter::goBack(const Snapshot& snapshot) {
  // Listeners forget what they hold when time runs backwards, and a bag in which it does cannot be played.
  publishSources();
  publish(topics_.tf_static, shared(staticTransforms(snapshot, frames_)));
  if (!recorder_.recording()) return;
  if (const auto refusal = recorder_.split()) return recorder_.stop(*refusal);
  beginBag(snapshot);
}

void Reporter::beginBag(const Snapshot& snapshot) {
  recorded_markers_.reset();
  for (const auto& [topic, message] : sources()) record(topic, snapshot.stamp, message);
  record(topics_.tf_static, snapshot.stamp, shared(staticTransforms(snapshot, frames_)));
  if (origin_) record(topics_.checkpoint, snapshot.stamp, *origin_);
  for (const Message& command : history_) record(topics_.applied, snapshot.stamp, command);
  if (Recording* recording = recorder_.recording()) recording->countFromHere();
}

void Reporter::recordState(const Snapshot& snapshot) {
  record(topics_.stimuli, snapshot.stamp, shared(toStimuli(snapshot, parameters_.world_frame)));
  for (const OrganSnapshot& organ : snapshot.organs) {
    record(states_.at(organ.id), snapshot.stamp, shared(toMessage(organ, snapshot, parameters_.world_frame)));
  }
  record(topics_.tf, snapshot.stamp, shared(movingTransforms(snapshot, frames_)));
  recordMarkers(snapshot);
}

void Reporter::recordMarkers(const Snapshot& snapshot) {
  if (!recorder_.recording() || parameters_.recording_marker_every == 0) return;
  const bool is_first = !recorded_markers_;
  if (is_first) recorded_markers_.emplace();
  if (!is_first && snapshot.step_index % static_cast<std::uint64_t>(parameters_.recording_marker_every) != 0) return;
  record(topics_.markers, snapshot.stamp, shared(recorded_markers_->next(snapshot, *markerSettings())));
}

std::vector<std::pair<Reporter::Topic, Message>> Reporter::sources() const {
  return {{topics_.parameters, textMessage(sources_.parameters)},
          {topics_.scenario, textMessage(sources_.scenario)},
          {topics_.protocol, textMessage(sources_.protocol)}};
}

std::string Reporter::datedFile(const Snapshot& snapshot) const {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%d-%H-%M-%S", &local);
  return snapshot.scenario + "_" + date + ".bag";
}

}  // namespace sensory_growth::node
