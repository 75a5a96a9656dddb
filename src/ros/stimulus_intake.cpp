#include "sensory_growth/ros/stimulus_intake.h"

#include <ros/console.h>

#include <set>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;
using std::chrono::steady_clock;

constexpr std::uint32_t kQueue = 100;
constexpr std::size_t kMostWaiting = 64;

std::string describe(const StimulusCommand& command) {
  return std::string(name(command.kind)) + " '" + command.id + "'";
}

}  // namespace

StimulusIntake::StimulusIntake(ros::NodeHandle node, ros::NodeHandle private_node, const WorldFrame& world,
                               StimulusCounters& counters, Outputs outputs)
    : world_(world), counters_(counters), outputs_(std::move(outputs)), warnings_(std::chrono::seconds(1)) {
  const auto subscribe = [this](ros::NodeHandle& from, const char* topic, auto message) {
    using Message = decltype(message);
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [this](const boost::shared_ptr<const Message>& received) { receive(toCommand(*received), received->header); };
    return from.subscribe<Message>(topic, kQueue, callback);
  };
  point_source_ = subscribe(private_node, names::kPointSource, PointSource());
  light_direction_ = subscribe(private_node, names::kLightDirection, LightDirection());
  clicked_point_ = subscribe(node, names::kClickedPoint, geometry_msgs::PointStamped());
  sun_ = subscribe(node, names::kSun, geometry_msgs::Vector3Stamped());
  const ros::WallDuration interval(std::chrono::duration<double>(WorldFrame::kRetryInterval).count());
  retry_ = node.createWallTimer(interval, [this](const ros::WallTimerEvent&) { drain(); });
}

void StimulusIntake::receive(const std::optional<StimulusCommand>& command, const std_msgs::Header& header) {
  if (!command) {
    return refuse(StimulusFate::unknown_operation, kNoOperation);
  }
  if (const auto fault = findFault(*command)) {
    return refuse(StimulusFate::malformed, describe(*command) + ": " + *fault);
  }
  if (waiting_.size() == kMostWaiting) {
    return refuse(StimulusFate::too_many_waiting, describe(*command) + ": too many stimuli wait for a transform");
  }
  waiting_.push_back({*command, header, steady_clock::now() + WorldFrame::kPatience});
  drain();
}

void StimulusIntake::drain() {
  std::set<std::pair<StimulusKind, std::string>> held_up;  // stimuli of one id keep their order
  std::deque<Waiting> still_waiting;
  for (Waiting& waiting : waiting_) {
    StimulusCommand& command = waiting.command;
    const auto key = std::make_pair(command.kind, command.id);
    if (held_up.count(key)) {
      still_waiting.push_back(waiting);
      continue;
    }
    const bool is_overdue = steady_clock::now() >= waiting.deadline;
    const auto why_not = world_.transform(command, waiting.header, is_overdue);
    if (!why_not) {
      if (!outputs_.send(command)) {
        refuse(StimulusFate::too_many_waiting, describe(command) + ": too many stimuli wait for the next step");
      }
    } else if (!is_overdue) {
      held_up.insert(key);
      still_waiting.push_back(waiting);
    } else {
      refuse(StimulusFate::no_transform, describe(command) + ": " + *why_not);
    }
  }
  waiting_.swap(still_waiting);
}

void StimulusIntake::refuse(StimulusFate fate, const std::string& why) {
  counters_.count(fate);
  if (warnings_.due()) {
    ROS_WARN_STREAM_NAMED(names::kLogRos,
                          "stimulus refused (" << name(fate) << ", " << counters_.refused() << " so far): " << why);
  }
  outputs_.refused();
}

}  // namespace sensory_growth::node
