#include "sensory_growth/ros/transforms.h"

#include <cmath>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

bool isSendable(const rod::Pose& pose) {
  return pose.position.allFinite() && pose.frame.coeffs().allFinite() && pose.frame.norm() > 0.5;
}

void append(const rod::Pose& pose, const std::string& child, const Snapshot& snapshot, const FrameSettings& settings,
            tf2_msgs::TFMessage& message) {
  if (!isSendable(pose)) return;
  const geometry_msgs::Pose converted = toPose(pose);
  geometry_msgs::TransformStamped transform;
  transform.header = makeHeader(snapshot, settings.world);
  transform.child_frame_id = child;
  transform.transform.translation = toVector(pose.position);
  transform.transform.rotation = converted.orientation;
  message.transforms.push_back(transform);
}

std::string frameName(const OrganSnapshot& organ, const std::string& frame, const FrameSettings& settings) {
  return settings.prefix + organ.id + "/" + frame;
}

}  // namespace

tf2_msgs::TFMessage staticTransforms(const Snapshot& snapshot, const FrameSettings& settings) {
  tf2_msgs::TFMessage message;
  for (const OrganSnapshot& organ : snapshot.organs) {
    append(organ.rod.base, frameName(organ, names::kBaseFrame, settings), snapshot, settings, message);
  }
  return message;
}

tf2_msgs::TFMessage movingTransforms(const Snapshot& snapshot, const FrameSettings& settings) {
  tf2_msgs::TFMessage message;
  for (const OrganSnapshot& organ : snapshot.organs) {
    append(organ.rod.apex(), frameName(organ, names::kTipFrame, settings), snapshot, settings, message);
    const double length = organ.rod.restLength();
    for (int k = 1; k <= settings.stations; ++k) {
      append(organ.rod.at(length * k / (settings.stations + 1)),
             frameName(organ, names::kStationFrame + std::to_string(k), settings), snapshot, settings, message);
    }
  }
  return message;
}

}  // namespace sensory_growth::node
