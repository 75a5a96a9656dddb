#include "sensory_growth/ros/stimulus_intake.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;
using std::chrono::steady_clock;

constexpr std::uint32_t kStimulusQueue = 100;
constexpr std::size_t kMostWaiting = 64;

std::string describe(const StimulusCommand& command) {
  return std::string(name(command.kind)) + " '" + command.id + "'";
}

}  // namespace

StimulusIntake::StimulusIntake(ros::NodeHandle node, ros::NodeHandle private_node, const WorldFrame& world,
                               StimulusCounters& counters, Outputs outputs)
    : world_(world), counters_(counters), outputs_(std::move(outputs)), warnings_(std::chrono::seconds(1)) {
  const auto subscribe = [this](ros::NodeHandle& from, const char* topic, auto message, auto convert) {
    using Message = decltype(message);
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this, convert](const boost::shared_ptr<const Message>& received) {
          receive(convert(*received), received->header);
        };
    return from.subscribe<Message>(topic, kStimulusQueue, callback);
  };
  const auto as_it_says = [](const auto& message) { return toCommand(message); };
  const auto one_more = [this](const auto& click) { return toCommand(click, ++clicks_); };
  point_source_ = subscribe(private_node, names::kPointSource, PointSource(), as_it_says);
  light_direction_ = subscribe(private_node, names::kLightDirection, LightDirection(), as_it_says);
  clicked_point_ = subscribe(node, names::kClickedPoint, geometry_msgs::PointStamped(), one_more);
  sun_ = subscribe(node, names::kSun, geometry_msgs::Vector3Stamped(), as_it_says);
  const ros::WallDuration interval(std::chrono::duration<double>(WorldFrame::kRetryInterval).count());
  retry_ = node.createWallTimer(interval, [this](const ros::WallTimerEvent&) { lookAgain(); });
}

void StimulusIntake::receive(const std::optional<StimulusCommand>& command, const std_msgs::Header& header) {
  if (!command) {
    return refuse(StimulusFate::unknown_operation, kNoOperation);
  }
  if (const auto fault = findFault(*command)) {
    return refuse(StimulusFate::malformed, describe(*command) + ": " + *fault);
  }
  Stimulus stimulus{*command, header, steady_clock::now() + WorldFrame::kPatience};
  if (handOn(stimulus, waiting_)) return;
  if (waiting_.size() == kMostWaiting) {
    return refuse(StimulusFate::too_many_waiting, describe(*command) + ": too many stimuli wait for a transform");
  }
  waiting_.push_back(std::move(stimulus));
}

void StimulusIntake::lookAgain() {
  std::vector<Stimulus> still_waiting;
  for (Stimulus& stimulus : waiting_) {
    if (!handOn(stimulus, still_waiting)) still_waiting.push_back(std::move(stimulus));
  }
  waiting_.swap(still_waiting);
  if (std::exchange(has_refused_, false)) outputs_.refused();
}

/// Sends or refuses the stimulus; false if it has to wait for its transform, or for one of the same id, as those keep
/// their order.
bool StimulusIntake::handOn(Stimulus& stimulus, const std::vector<Stimulus>& earlier) {
  StimulusCommand& command = stimulus.command;
  const auto is_same = [&](const Stimulus& e) { return e.command.kind == command.kind && e.command.id == command.id; };
  if (std::any_of(earlier.begin(), earlier.end(), is_same)) return false;
  const bool is_overdue = steady_clock::now() >= stimulus.deadline;
  const auto why_not = world_.transform(command, stimulus.header, is_overdue);
  if (why_not && !is_overdue) return false;
  if (why_not) {
    refuse(StimulusFate::no_transform, describe(command) + ": " + *why_not);
  } else if (!outputs_.send(command)) {
    refuse(StimulusFate::too_many_waiting, describe(command) + ": too many stimuli wait for the next step");
  }
  return true;
}

void StimulusIntake::refuse(StimulusFate fate, const std::string& why) {
  counters_.count(fate);
  if (warnings_.due()) {
    ROS_WARN_STREAM_NAMED(names::kLogRos,
                          "stimulus refused (" << name(fate) << ", " << counters_.refused() << " so far): " << why);
  }
  has_refused_ = true;
}

}  // namespace sensory_growth::node
