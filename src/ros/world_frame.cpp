#include "sensory_growth/ros/world_frame.h"

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <algorithm>
#include <utility>

#include "sensory_growth/ros/conversions.h"

namespace sensory_growth::node {
namespace {

constexpr double kLongestMemory = 600.0;  // [s] of ROS time, which may pass much faster than wall time
constexpr double kMostTransforms = 1e4;   // of each frame that moves with every step

}  // namespace

double transformMemory(double step) { return std::min(kLongestMemory, kMostTransforms * step); }

WorldFrame::WorldFrame(std::string name, double step)
    : name_(std::move(name)), transforms_(ros::Duration(transformMemory(step))), listener_(transforms_) {}

std::optional<std::string> WorldFrame::transform(simulation::StimulusCommand& command, const std_msgs::Header& header,
                                                 bool is_overdue) const {
  if (command.operation == simulation::StimulusOperation::remove) return std::nullopt;
  if (header.frame_id.empty() || header.frame_id == name_) return std::nullopt;
  geometry_msgs::TransformStamped transform;
  try {
    transform = transformOf(header, is_overdue);
  } catch (const tf2::TransformException& error) {
    return error.what();
  }
  if (command.kind == simulation::StimulusKind::light_direction) {
    geometry_msgs::Vector3 direction = toVector(command.vector);
    tf2::doTransform(direction, direction, transform);
    command.vector = {direction.x, direction.y, direction.z};
  } else {
    geometry_msgs::Point position = toPoint(command.vector);
    tf2::doTransform(position, position, transform);
    command.vector = {position.x, position.y, position.z};
  }
  return std::nullopt;
}

geometry_msgs::TransformStamped WorldFrame::transformOf(const std_msgs::Header& header, bool is_overdue) const {
  try {
    return transforms_.lookupTransform(name_, header.frame_id, header.stamp);
  } catch (const tf2::TransformException&) {
    if (!is_overdue) throw;
    // Nothing is sent on tf while a simulation is paused: what moved last still stands there.
    const auto latest = transforms_.lookupTransform(name_, header.frame_id, ros::Time(0));
    if (latest.header.stamp > header.stamp) throw;
    return latest;
  }
}

}  // namespace sensory_growth::node
