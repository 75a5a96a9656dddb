#pragma once

/// What the handles of stimuli look like in rviz and what their poses mean. Pure functions.

#include <visualization_msgs/InteractiveMarker.h>

#include <string>

#include "sensory_growth/ros/markers.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

/// Name of the handle of a stimulus.
std::string handleName(const simulation::StimulusCommand& stimulus);

/// Where the handle of a stimulus is: a lamp at its position; a light where its arrow begins if it shines on `target`,
/// with x towards the light.
geometry_msgs::Pose handlePose(const simulation::StimulusCommand& stimulus, const rod::Vector3& target,
                               const MarkerSettings& settings);

/// The vector of a stimulus whose handle is there: position [m] or direction towards the light, zero if the
/// quaternion has no direction.
rod::Vector3 handleVector(simulation::StimulusKind kind, const geometry_msgs::Pose& pose);

/// A handle without a menu, at the pose given: for a lamp axes and a ball to be dragged across the view, for a light
/// an arrow with rings to turn it.
visualization_msgs::InteractiveMarker makeHandle(const simulation::StimulusCommand& stimulus,
                                                 const geometry_msgs::Pose& pose, const MarkerSettings& settings);

/// The handle whose menu adds stimuli: a ball that can be dragged.
visualization_msgs::InteractiveMarker makeNewHandle(const geometry_msgs::Pose& pose, const MarkerSettings& settings);

}  // namespace sensory_growth::node
