#include "sensory_growth/ros/node.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"
#include "sensory_growth/ros/wall_throttle.h"
#include "serve.h"

namespace sensory_growth::node {
namespace {

constexpr std::chrono::milliseconds kSignalPatience{50};

// A thread that offers a topic or sets a parameter while the master is away waits no longer, least of all that of the
// simulation: MasterWatch registers later what was missed.
constexpr double kMasterPatience = 0.1;  // [s]

/// Until somebody says what time it is; false if the process is to end first.
bool waitForTime(const Signals& signals) {
  WallThrottle reminders(std::chrono::seconds(10));
  while (!ros::Time::isValid()) {
    if (reminders.due()) ROS_WARN_STREAM_NAMED(names::kLogRos, "waiting for somebody to publish " << names::kClock);
    if (!ros::ok() || signals.wait(kSignalPatience)) return false;
  }
  return true;
}

/// Makes the directories that files go to, and says what stands in the way of them.
std::vector<std::string> prepareFiles(const Parameters& parameters) {
  std::vector<std::string> problems;
  for (const std::string& directory : {parameters.recording_directory, parameters.checkpoint_directory}) {
    std::error_code failure;
    if (!directory.empty()) std::filesystem::create_directories(directory, failure);
    if (failure) problems.push_back(directory + ": cannot be created: " + failure.message());
  }
  const std::string& file = parameters.recording_file;  // empty: a new one
  if (!parameters.record || parameters.recording_directory.empty() || file.empty()) return problems;
  try {
    recordingPath(parameters.recording_directory, file);
  } catch (const std::exception& refusal) {
    problems.push_back(refusal.what());
  }
  return problems;
}

int complain(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems) ROS_FATAL_STREAM_NAMED(names::kLogRos, problem);
  return 1;
}

}  // namespace

Node::Node(const Parameters& parameters, LoadedScenario loaded)
    : parameters_(parameters),
      step_(loaded.scenario.stepping.step / parameters.growth_time_scale),
      private_node_("~"),
      clock_({parameters.clock_mode, step_, parameters.clock_rate, parameters.reset_time}, node_),
      publishers_(parameters, loaded.sources, counters_, private_node_),
      world_(parameters.world_frame, step_),
      intake_(node_, private_node_, world_, counters_,
              {[this](const simulation::StimulusCommand& command) { return loop_.send(command); },
               [this] { loop_.refreshStatus(); }}),
      loop_(simulation::Simulation(std::move(loaded.scenario), parameters.threads),
            {step_, parameters.real_time_factor, parameters.start_paused, parameters.clock_mode == ClockMode::follow,
             parameters.on_backward_jump},
            clock_, counters_, publishers_),
      checkpoints_(parameters, loaded.sources.node, step_, loop_, publishers_),
      stimulus_services_(private_node_, parameters.world_frame, world_, loop_, counters_),
      live_(parameters, private_node_, control_queue_,
            [this](const Parameters& before, const Parameters& now) { return use(before, now); }),
      topic_spinner_(1),
      control_spinner_(1, &control_queue_),
      step_spinner_(1, &step_queue_),
      health_spinner_(1, &health_queue_) {
  if (parameters_.record) {
    if (const auto refusal = publishers_.startRecording(parameters_.recording_file, *loop_.snapshot()))
      throw std::runtime_error(*refusal);
    ROS_INFO_STREAM_NAMED(names::kLogRecording, "recording " << publishers_.recordingPath());
  }
  diagnostics_ = std::make_unique<Diagnostics>(
      node_, private_node_,
      Diagnostics::Sources{[this] { return loop_.snapshot(); }, [this] { return loop_.status(); },
                           [this] { return publishers_.recordingPath(); },
                           [this] { return publishers_.recordingFailure(); }, &counters_, parameters_.clock_mode});
  if (parameters_.interactive_markers) {
    handles_ = std::make_unique<StimulusHandles>(
        private_node_.resolveName(names::kStimulusHandles), publishers_.markerSettings(),
        [this] { return loop_.snapshot(); },
        [this](const auto& command, const auto& header) { intake_.receive(command, header); });
  }
}

Node::~Node() {
  clock_listener_.reset();
  loop_.stop();  // first, because it wakes the services that wait
  topic_spinner_.stop();
  control_spinner_.stop();
  step_spinner_.stop();
  health_spinner_.stop();
  stimulus_services_.stop();
  if (const auto recording = publishers_.takeRecording()) {
    const RecordingSummary summary = recording->finish();
    ROS_INFO_STREAM_NAMED(names::kLogRecording, "closed " << summary.path << ": " << summary.messages << " messages");
    if (!summary.error.empty()) ROS_WARN_STREAM_NAMED(names::kLogRecording, summary.error);
  }
}

int Node::run(const Signals& signals) {
  advertiseServices();
  startTimers();
  loop_.start();
  if (parameters_.clock_mode == ClockMode::follow) {
    clock_listener_ = std::make_unique<ClockListener>(node_, [this](const ros::Time& now) { loop_.hearClock(now); });
  }
  topic_spinner_.start();
  control_spinner_.start();
  step_spinner_.start();
  health_spinner_.start();
  stimulus_services_.start();
  while (ros::ok() && !signals.wait(kSignalPatience)) {
    const RunStatus status = loop_.status();
    if (!parameters_.exit_when_finished) continue;
    if (status.mode == Mode::finished) break;
    if (status.mode == Mode::fault) {
      ROS_FATAL_STREAM_NAMED(names::kLogSimulation, status.message);
      return 1;
    }
  }
  if (live_.now().progress) logProgress();
  return 0;
}

void Node::advertiseServices() {
  const auto control = [this](const char* name, auto action) {
    services_.push_back(serve<sensory_growth::Command>(
        private_node_, name, control_queue_,
        [action](auto&, sensory_growth::Command::Response& response) { fill(action(), response); }));
  };
  control(names::kPause, [this] { return loop_.pause(); });
  control(names::kResume, [this] { return loop_.resume(); });
  control(names::kReset, [this] { return loop_.reset(); });
  services_.push_back(serve<SetParameter>(private_node_, names::kSetParameter, control_queue_,
                                          [this](auto& q, auto& r) { fill(loop_.apply(toCommand(q)), r); }));
  services_.push_back(serve<SetGravity>(private_node_, names::kSetGravity, control_queue_,
                                        [this](auto& q, auto& r) { fill(loop_.apply(toCommand(q)), r); }));
  services_.push_back(serve<SetRealTimeFactor>(private_node_, names::kSetRealTimeFactor, control_queue_,
                                               [this](auto& q, auto& r) { fill(setRealTimeFactor(q.factor), r); }));
  services_.push_back(serve<SpawnOrgan>(private_node_, names::kSpawnOrgan, control_queue_,
                                        [this](auto& q, auto& r) { fill(loop_.apply(toCommand(q)), r); }));
  services_.push_back(serve<RemoveOrgan>(private_node_, names::kRemoveOrgan, control_queue_,
                                         [this](auto& q, auto& r) { fill(loop_.apply(toCommand(q)), r); }));
  services_.push_back(serve<SaveCheckpoint>(private_node_, names::kSaveCheckpoint, control_queue_,
                                            [this](auto& q, auto& r) { fill(checkpoints_.save(q.file), r); }));
  services_.push_back(
      serve<LoadCheckpoint>(private_node_, names::kLoadCheckpoint, control_queue_,
                            [this](auto& q, auto& r) { fill(checkpoints_.load(q.file, q.keep_stimuli), r); }));
  services_.push_back(serve<StartRecording>(private_node_, names::kStartRecording, control_queue_,
                                            [this](auto& q, auto& r) { startRecording(q, r); }));
  services_.push_back(serve<SplitRecording>(private_node_, names::kSplitRecording, control_queue_,
                                            [this](auto&, auto& r) { splitRecording(r); }));
  services_.push_back(serve<StopRecording>(private_node_, names::kStopRecording, control_queue_,
                                           [this](auto&, auto& r) { stopRecording(r); }));
  services_.push_back(serve<Step>(private_node_, names::kStep, step_queue_,
                                  [this](auto& q, auto& r) { fill(loop_.step(q.steps), r); }));
}

void Node::startRecording(const StartRecording::Request& request, StartRecording::Response& response) {
  const Answer answer = loop_.atBoundary([&](const Snapshot& snapshot) {
    const auto refusal = publishers_.startRecording(request.file, snapshot);
    response.path = publishers_.recordingPath();
    return refusal;
  });
  fill(answer, response);
  if (answer.success) response.message = "recording";
}

void Node::splitRecording(SplitRecording::Response& response) {
  fill(loop_.atBoundary([&](const Snapshot& snapshot) {
    const auto refusal = publishers_.splitRecording(snapshot);
    response.path = publishers_.recordingPath();
    return refusal;
  }),
       response);
  if (response.success) response.message = "recording";
}

void Node::stopRecording(StopRecording::Response& response) {
  std::unique_ptr<Recording> recording;
  fill(loop_.atBoundary([&](const Snapshot&) -> std::optional<std::string> {
    recording = publishers_.takeRecording();
    if (!recording) return "nothing is being recorded";
    return std::nullopt;
  }),
       response);
  if (!recording) return;
  const RecordingSummary summary = recording->finish();  // here, so that the simulation need not wait for the disk
  response.path = summary.path;
  response.messages = summary.messages;
  response.success = summary.error.empty();
  response.message = summary.error.empty() ? "closed" : summary.error;
}

void Node::startTimers() {
  const auto every = [this](double interval, auto action, ros::CallbackQueue* queue = nullptr) {
    ros::WallTimerOptions options(
        ros::WallDuration(interval), [action](const ros::WallTimerEvent&) { action(); }, queue);
    timers_.push_back(node_.createWallTimer(options));
  };
  every(0.1, [this] { clock_.keepAlive(); });
  every(
      1.0, [this] { diagnostics_->update(); }, &health_queue_);
  every(1.0, [this] {
    if (live_.now().progress) logProgress();
  });
  marker_timer_ =
      node_.createWallTimer(ros::WallDuration(1.0 / parameters_.marker_rate), [this](const auto&) { showMarkers(); });
}

void Node::showMarkers() {
  publishers_.showMarkers(loop_.snapshot());
  if (handles_) handles_->show(publishers_.markerSettings());
}

Answer Node::setRealTimeFactor(double factor) {
  const Answer answer = loop_.setRealTimeFactor(factor);
  if (!answer.success) return answer;
  XmlRpc::XmlRpcValue change;
  change["real_time_factor"] = factor;
  live_.change(change);
  return answer;
}

/// Takes parameters into use that have changed while the node runs. Returns why it cannot, or nothing.
std::optional<std::string> Node::use(const Parameters& before, const Parameters& now) {
  if (now.real_time_factor != before.real_time_factor) {
    const Answer answer = loop_.setRealTimeFactor(now.real_time_factor);
    if (!answer.success) return answer.message;
  }
  if (now.marker_rate != before.marker_rate) marker_timer_.setPeriod(ros::WallDuration(1.0 / now.marker_rate));
  loop_.atBoundary([&](const Snapshot& snapshot) {
    publishers_.setParameters(now, snapshot);
    return std::nullopt;
  });
  return std::nullopt;
}

void Node::logProgress() const {
  constexpr double kHour = 3600.0;
  const SnapshotPtr snapshot = loop_.snapshot();
  std::ostringstream text;
  text.precision(3);
  text << "step " << snapshot->step_index << ", " << snapshot->growth_time / kHour << " h";
  if (const double duration = snapshot->duration; duration > 0.0) {
    text << " of " << duration / kHour << " h (" << 100.0 * std::min(snapshot->growth_time / duration, 1.0) << " %)";
  }
  text << ", " << loop_.status().achieved_real_time_factor * parameters_.growth_time_scale
       << " x faster than the organ grows";
  ROS_INFO_STREAM_NAMED(names::kLogSimulation, text.str());
}

int runNode(const Signals& signals) {
  if (!ros::master::check()) {
    return complain({"no ROS master at " + ros::master::getURI() + "; start one with roscore or roslaunch"});
  }
  ros::master::setRetryTimeout(ros::WallDuration(kMasterPatience));
  const ros::NodeHandle private_node("~");
  ParameterReading reading = loadParameters(private_node);
  LoadedScenario loaded;
  if (!reading.parameters.scenario.empty())
    loaded = loadScenario(reading.parameters, ros::this_node::getName(), reading.problems);
  for (std::vector<std::string> more :
       {findClockProblems(reading.parameters.clock_mode), prepareFiles(reading.parameters)}) {
    std::move(more.begin(), more.end(), std::back_inserter(reading.problems));
  }
  if (!reading.problems.empty()) return complain(reading.problems);
  ROS_INFO_STREAM_NAMED(names::kLogRos, "effective parameters:\n" << loaded.sources.parameters);
  if (reading.parameters.clock_mode == ClockMode::follow && !waitForTime(signals)) return 0;
  try {
    return Node(reading.parameters, std::move(loaded)).run(signals);
  } catch (const std::exception& error) {
    return complain({error.what()});
  }
}

}  // namespace sensory_growth::node
