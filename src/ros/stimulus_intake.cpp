#include "sensory_growth/ros/stimulus_intake.h"

#include <ros/console.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

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
constexpr std::chrono::seconds kPatience{1};  // for a transform; wall time, as ROS time may stand still
constexpr double kTransformMemory = 600.0;    // [s] of ROS time, which may pass much faster than wall time
constexpr double kRetryInterval = 0.05;       // [s]

std::string describe(const StimulusCommand& command) {
  return std::string(name(command.kind)) + " '" + command.id + "'";
}

}  // namespace

StimulusIntake::StimulusIntake(ros::NodeHandle node, ros::NodeHandle private_node, std::string world_frame,
                               StimulusCounters& counters, Outputs outputs)
    : world_frame_(std::move(world_frame)),
      counters_(counters),
      outputs_(std::move(outputs)),
      warnings_(std::chrono::seconds(1)),
      transforms_(ros::Duration(kTransformMemory)),
      listener_(transforms_) {
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
  retry_ = node.createWallTimer(ros::WallDuration(kRetryInterval), [this](const ros::WallTimerEvent&) { drain(); });
}

void StimulusIntake::receive(const std::optional<StimulusCommand>& command, const std_msgs::Header& header) {
  if (!command) {
    return refuse(StimulusFate::unknown_operation, "operation must be ADD (1), CHANGE (2) or REMOVE (3)");
  }
  if (const auto fault = findFault(*command)) {
    return refuse(StimulusFate::malformed, describe(*command) + ": " + *fault);
  }
  if (waiting_.size() == kMostWaiting) {
    return refuse(StimulusFate::too_many_waiting, describe(*command) + ": too many stimuli wait for a transform");
  }
  waiting_.push_back({*command, header, steady_clock::now() + kPatience});
  drain();
}

void StimulusIntake::drain() {
  std::set<std::pair<StimulusKind, std::string>> held_up;  // stimuli of one id keep their order
  std::deque<Waiting> still_waiting;
  for (Waiting& waiting : waiting_) {
    StimulusCommand& command = waiting.command;
    const auto key = std::make_pair(command.kind, command.id);
    std::string why_not;
    if (held_up.count(key)) {
      still_waiting.push_back(waiting);
    } else if (toWorld(waiting, command, why_not)) {
      if (!outputs_.send(command)) {
        refuse(StimulusFate::too_many_waiting, describe(command) + ": too many stimuli wait for the next step");
      }
    } else if (steady_clock::now() < waiting.deadline) {
      held_up.insert(key);
      still_waiting.push_back(waiting);
    } else {
      refuse(StimulusFate::no_transform, describe(command) + ": " + why_not);
    }
  }
  waiting_.swap(still_waiting);
}

geometry_msgs::TransformStamped StimulusIntake::transformOf(const std_msgs::Header& header, bool is_overdue) const {
  try {
    return transforms_.lookupTransform(world_frame_, header.frame_id, header.stamp);
  } catch (const tf2::TransformException&) {
    if (!is_overdue) throw;
    // Nothing is sent on tf while a simulation is paused: what moved last still stands there.
    const auto latest = transforms_.lookupTransform(world_frame_, header.frame_id, ros::Time(0));
    if (latest.header.stamp > header.stamp) throw;
    return latest;
  }
}

bool StimulusIntake::toWorld(const Waiting& waiting, StimulusCommand& command, std::string& why_not) const {
  const std_msgs::Header& header = waiting.header;
  if (command.operation == StimulusOperation::remove) return true;
  if (header.frame_id.empty() || header.frame_id == world_frame_) return true;
  geometry_msgs::TransformStamped transform;
  try {
    transform = transformOf(header, steady_clock::now() >= waiting.deadline);
  } catch (const tf2::TransformException& error) {
    why_not = error.what();
    return false;
  }
  if (command.kind == StimulusKind::light_direction) {
    geometry_msgs::Vector3 direction = toVector(command.vector);
    tf2::doTransform(direction, direction, transform);
    command.vector = {direction.x, direction.y, direction.z};
  } else {
    geometry_msgs::Point position = toPoint(command.vector);
    tf2::doTransform(position, position, transform);
    command.vector = {position.x, position.y, position.z};
  }
  return true;
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
