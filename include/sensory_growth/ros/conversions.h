#pragma once

/// Between the types of the core and messages. Pure functions.

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Vector3Stamped.h>

#include <optional>
#include <string>

#include "sensory_growth/AppliedCommand.h"
#include "sensory_growth/Checkpoint.h"
#include "sensory_growth/LightDirection.h"
#include "sensory_growth/OrganState.h"
#include "sensory_growth/PointSource.h"
#include "sensory_growth/Relaxation.h"
#include "sensory_growth/RemoveOrgan.h"
#include "sensory_growth/ScheduledStimulus.h"
#include "sensory_growth/SetGravity.h"
#include "sensory_growth/SetParameter.h"
#include "sensory_growth/SpawnOrgan.h"
#include "sensory_growth/Stimuli.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/ros/snapshot.h"
#include "sensory_growth/simulation/checkpoint.h"
#include "sensory_growth/simulation/commands.h"

namespace sensory_growth::node {

geometry_msgs::Point toPoint(const rod::Vector3& v);
geometry_msgs::Vector3 toVector(const rod::Vector3& v);
geometry_msgs::Quaternion toQuaternion(const rod::Quaternion& q);

/// The quaternion is normalised, as tf2 and rviz demand.
geometry_msgs::Pose toPose(const rod::Pose& pose);

std_msgs::Header makeHeader(const Snapshot& snapshot, const std::string& frame);

Relaxation toMessage(const simulation::OrganReport& report);
Checkpoint toMessage(const simulation::Checkpoint& checkpoint, const Snapshot& snapshot, const std::string& frame);
OrganState toMessage(const OrganSnapshot& organ, const Snapshot& snapshot, const std::string& frame);
ScheduledStimulus toMessage(const simulation::ScheduledStimulus& scheduled);
Stimuli toStimuli(const Snapshot& snapshot, const std::string& frame);
AppliedCommand toMessage(const simulation::AppliedCommand& applied, const Snapshot& snapshot, const std::string& frame);

/// What to say of a message without an operation.
inline constexpr char kNoOperation[] = "operation must be ADD (1), CHANGE (2) or REMOVE (3)";

/// Nothing if the operation is none of ADD, CHANGE and REMOVE. The vector stays in the frame of the message.
std::optional<simulation::StimulusCommand> toCommand(const PointSource& message);
std::optional<simulation::StimulusCommand> toCommand(const LightDirection& message);

/// The command that was echoed; nothing if its kind or operation is unknown.
std::optional<simulation::Command> toCommand(const AppliedCommand& message);

/// Adds the lamp of that number, `names::kClickedLamp` and the number.
simulation::StimulusCommand toCommand(const geometry_msgs::PointStamped& message, int number);

/// Sets the light `names::kSunLight`.
simulation::StimulusCommand toCommand(const geometry_msgs::Vector3Stamped& message);

simulation::ParameterCommand toCommand(const SetParameter::Request& request);
simulation::GravityCommand toCommand(const SetGravity::Request& request);
simulation::SpawnCommand toCommand(const SpawnOrgan::Request& request);
simulation::RemoveCommand toCommand(const RemoveOrgan::Request& request);

}  // namespace sensory_growth::node
