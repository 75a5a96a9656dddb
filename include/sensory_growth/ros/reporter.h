#pragma once

/// Says in messages what happens in a run. Each message is built once and goes to whoever derives from this and, while
/// one is open, to the bag. Needs no master.

#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/Checkpoint.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/Status.h"
#include "sensory_growth/Stimuli.h"
#include "sensory_growth/ros/markers.h"
#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/recorder.h"
#include "sensory_growth/ros/run.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/ros/transforms.h"

namespace sensory_growth::node {

/// The texts a run started from, or those of the checkpoint that it went on from.
struct Sources {
  std::string node;        ///< its name, such as "/sensory_growth"
  std::string scenario;    ///< YAML as read
  std::string protocol;    ///< YAML as read; empty: none
  std::string parameters;  ///< YAML of the parameters in effect
  std::vector<std::string> organs;
};

/// Anything that is published.
using Message = std::variant<
    boost::shared_ptr<const Status>, boost::shared_ptr<const Stimuli>, boost::shared_ptr<const AppliedCommand>,
    boost::shared_ptr<const Checkpoint>, boost::shared_ptr<const OrganState>, boost::shared_ptr<const std_msgs::String>,
    boost::shared_ptr<const tf2_msgs::TFMessage>, boost::shared_ptr<const visualization_msgs::MarkerArray>>;

class Reporter : public RunListener {
 public:
  /// Makes the full name of a topic from one of ros/names.h.
  using Resolve = std::function<std::string(const std::string&)>;

  /// `counters` must outlive the reporter.
  Reporter(const Parameters& parameters, const Sources& sources, const StimulusCounters& counters,
           const Resolve& resolve);

  void onCheckpoint(const simulation::Checkpoint& checkpoint, const Snapshot& snapshot) override;
  void onState(const SnapshotPtr& snapshot) override;
  void onOrgans(const SnapshotPtr& snapshot) override;
  void onCommand(const simulation::AppliedCommand& command, const Snapshot& snapshot) override;
  void onStimuli(const Snapshot& snapshot) override;
  void onStatus(const RunStatus& status, const Snapshot& snapshot) override;

  /// A checkpoint of the run at that state. On the thread of the run.
  simulation::Checkpoint checkpointOf(simulation::SimulationState state) const;

  /// Goes on with other parameters for markers and says so. On the thread of the run.
  void setParameters(const Parameters& parameters, const Snapshot& snapshot);

  /// Opens a bag and writes what is needed to run the same again. On the thread of the run. `file` may be empty.
  /// Returns why it failed, or nothing.
  std::optional<std::string> startRecording(const std::string& file, const Snapshot& snapshot);

  /// Goes on in another bag, which begins like the first, so that it runs the same without the one before. On the
  /// thread of the run. Returns why it failed and the open bag goes on, or nothing.
  std::optional<std::string> splitRecording(const Snapshot& snapshot);

  /// Hands the open bag over, to be finished elsewhere; null if there is none. On the thread of the run.
  std::unique_ptr<Recording> takeRecording();

  /// Path of the bag being written; empty if there is none. From any thread.
  std::string recordingPath() const { return recorder_.path(); }

  /// Why recording ended early; empty if it did not, or has begun again. From any thread.
  std::string recordingFailure() const { return recorder_.failure(); }

 protected:
  struct Topic {
    std::string name;  // resolved
    bool is_latched = false;
  };

  struct Topics {
    Topic status, stimuli, applied, checkpoint, scenario, protocol, parameters, markers, tf, tf_static;
  };

  /// Called before the first message on the topic of an organ, and when the organ is gone.
  virtual void open(const Topic& topic) = 0;
  virtual void close(const Topic& topic) = 0;

  /// Called on the thread of the run with every message but the markers, once.
  virtual void publish(const Topic& topic, const Message& message) = 0;

  /// Called when recording ended early.
  virtual void warn(const RecordingSummary& summary) = 0;

  /// Called when the open bag grows beyond its size, because the next cannot be begun.
  virtual void warnOfSize(const std::string& why) = 0;

  /// Publishes the texts that the run started from.
  void publishSources();

  /// How markers look at present; null before the first state. From any thread.
  MarkerSettingsPtr markerSettings() const;

  Parameters parameters_;  // of the run's thread alone once there is a run
  Sources sources_;        // the same
  const Topics topics_;

 private:
  static Topics makeTopics(const Resolve& resolve);
  std::set<std::string> followOrgans(const Snapshot& snapshot);
  void setMarkerSettings();
  void sendState(const OrganSnapshot& organ, const Snapshot& snapshot);
  void send(const Topic& topic, const ros::Time& stamp, const Message& message);
  void record(const Topic& topic, const ros::Time& stamp, const Message& message);
  void beginHistory(std::uint32_t epoch);
  void goBack(const Snapshot& snapshot);
  void keep(Message command);
  void sendBases(const Snapshot& snapshot);
  void sendTransforms(const Snapshot& snapshot);
  void beginBag(const Snapshot& snapshot);
  void recordState(const Snapshot& snapshot);
  void recordMarkers(const Snapshot& snapshot);
  std::vector<std::pair<Topic, Message>> sources() const;
  std::string datedFile(const Snapshot& snapshot) const;

  const Resolve resolve_;
  const FrameSettings frames_;
  const StimulusCounters& counters_;

  // Of the run's thread alone.
  SnapshotPtr first_;                    // state at the start
  std::map<std::string, Topic> states_;  // by organ
  Recorder recorder_;
  std::optional<MarkerStream> recorded_markers_;
  std::optional<Message> origin_;  // the checkpoint that the epoch began with
  std::vector<Message> history_;   // commands since it began, as far as they are kept
  bool history_is_cut_ = false;
  std::uint32_t history_epoch_ = 0;
  ros::Time last_stamp_;
  std::set<std::string> frames_sent_;  // with that stamp

  mutable std::mutex markers_mutex_;
  MarkerSettingsPtr marker_settings_;
};

}  // namespace sensory_growth::node
