#include "sensory_growth/ros/handle_shapes.h"

#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using simulation::StimulusCommand;
using simulation::StimulusKind;
using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

/// The frame whose x axis has the direction given.
rod::Quaternion turnedTo(const rod::Vector3& x) { return rod::Quaternion::FromTwoVectors(rod::Vector3::UnitX(), x); }

InteractiveMarker makeEmptyHandle(const std::string& name, const geometry_msgs::Pose& pose, double size,
                                  const MarkerSettings& settings) {
  InteractiveMarker handle;
  handle.header.frame_id = settings.frame;  // without a stamp, so that it stays there as time goes on
  handle.name = name;
  handle.pose = pose;
  handle.scale = static_cast<float>(size);
  return handle;
}

/// A control with the shape that rviz gives to its mode.
void addControl(InteractiveMarker& handle, const char* name, std::uint8_t mode, const rod::Vector3& axis) {
  InteractiveMarkerControl& control = handle.controls.emplace_back();
  control.name = name;
  control.interaction_mode = mode;
  control.orientation = toQuaternion(turnedTo(axis));
}

/// A veil round what the markers show.
Marker makeVeil(int type) {
  Marker veil;
  veil.type = type;
  veil.pose.orientation.w = 1.0;
  veil.color.r = veil.color.g = veil.color.b = 0.5F;
  veil.color.a = 0.25F;
  return veil;
}

/// A ball that can be dragged in the plane of the screen.
void addBall(InteractiveMarker& handle, double diameter) {
  InteractiveMarkerControl& control = handle.controls.emplace_back();
  control.name = "across";
  control.interaction_mode = InteractiveMarkerControl::MOVE_PLANE;
  control.orientation_mode = InteractiveMarkerControl::VIEW_FACING;
  control.orientation.w = 1.0;
  control.independent_marker_orientation = true;
  Marker ball = makeVeil(Marker::SPHERE);
  ball.scale.x = ball.scale.y = ball.scale.z = diameter;
  control.markers.push_back(std::move(ball));
}

/// An arrow along the light, for the menu; rings turn it.
void addArrow(InteractiveMarker& handle, const MarkerSettings& settings) {
  InteractiveMarkerControl& control = handle.controls.emplace_back();
  control.name = "arrow";
  control.interaction_mode = InteractiveMarkerControl::MENU;
  control.orientation.w = 1.0;
  Marker arrow = makeVeil(Marker::ARROW);
  arrow.points.resize(2);
  arrow.points[1].x = -0.6 * settings.scene_size;
  arrow.scale.x = 0.5 * settings.lamp_diameter;
  arrow.scale.y = arrow.scale.z = 1.1 * settings.lamp_diameter;
  control.markers.push_back(std::move(arrow));
}

}  // namespace

std::string handleName(const StimulusCommand& stimulus) {
  const bool is_lamp = stimulus.kind == StimulusKind::point_source;
  return std::string(is_lamp ? names::kLampMarker : names::kLightMarker) + "/" + stimulus.id;
}

geometry_msgs::Pose handlePose(const StimulusCommand& stimulus, const rod::Vector3& target,
                               const MarkerSettings& settings) {
  if (stimulus.kind == StimulusKind::point_source) return toPose({stimulus.vector, rod::Quaternion::Identity()});
  const rod::Vector3 tail = lightTail({stimulus.id, stimulus.vector, stimulus.strength}, target, settings);
  return toPose({tail, turnedTo(stimulus.vector)});
}

rod::Vector3 handleVector(StimulusKind kind, const geometry_msgs::Pose& pose) {
  if (kind == StimulusKind::point_source) return {pose.position.x, pose.position.y, pose.position.z};
  const rod::Quaternion turn(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (turn.norm() == 0.0) return rod::Vector3::Zero();
  return turn.normalized() * rod::Vector3::UnitX();
}

InteractiveMarker makeHandle(const StimulusCommand& stimulus, const geometry_msgs::Pose& pose,
                             const MarkerSettings& settings) {
  const double diameter = settings.lamp_diameter;
  if (stimulus.kind == StimulusKind::point_source) {
    InteractiveMarker handle = makeEmptyHandle(handleName(stimulus), pose, 2.5 * diameter, settings);
    addBall(handle, 1.3 * diameter);
    addControl(handle, "along_x", InteractiveMarkerControl::MOVE_AXIS, rod::Vector3::UnitX());
    addControl(handle, "along_y", InteractiveMarkerControl::MOVE_AXIS, rod::Vector3::UnitY());
    addControl(handle, "along_z", InteractiveMarkerControl::MOVE_AXIS, rod::Vector3::UnitZ());
    return handle;
  }
  InteractiveMarker handle = makeEmptyHandle(handleName(stimulus), pose, 3.0 * diameter, settings);
  addArrow(handle, settings);
  addControl(handle, "about_y", InteractiveMarkerControl::ROTATE_AXIS, rod::Vector3::UnitY());
  addControl(handle, "about_z", InteractiveMarkerControl::ROTATE_AXIS, rod::Vector3::UnitZ());
  return handle;
}

InteractiveMarker makeNewHandle(const geometry_msgs::Pose& pose, const MarkerSettings& settings) {
  InteractiveMarker handle = makeEmptyHandle(names::kNewHandle, pose, 2.0 * settings.lamp_diameter, settings);
  addBall(handle, settings.lamp_diameter);
  // Not by handle.description, which rviz writes in white.
  Marker label = makeVeil(Marker::TEXT_VIEW_FACING);
  label.text = "right click: add";
  label.pose.position.z = 0.9 * settings.lamp_diameter;
  label.scale.z = 0.5 * settings.lamp_diameter;
  label.color.a = 1.0F;
  handle.controls.front().markers.push_back(std::move(label));
  return handle;
}

}  // namespace sensory_growth::node
