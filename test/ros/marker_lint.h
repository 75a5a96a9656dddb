#pragma once

/// The rules by which rviz refuses or silently drops markers (ros.md 42, 43), as a test helper.

#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sensory_growth::node::testing {

inline bool isFinite(const geometry_msgs::Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

inline void lintAdded(const visualization_msgs::Marker& m, const std::string& who, std::vector<std::string>& faults) {
  using visualization_msgs::Marker;
  const auto require = [&](bool holds, const std::string& rule) {
    if (!holds) faults.push_back(who + ": " + rule);
  };
  const bool has_points = m.type == Marker::LINE_STRIP || m.type == Marker::TRIANGLE_LIST;
  const geometry_msgs::Quaternion& q = m.pose.orientation;
  require(std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) < 1e-6, "the orientation must be normalised");
  require(isFinite(m.pose.position), "the position must be finite");
  require(m.scale.x > 0.0 || m.type == Marker::TEXT_VIEW_FACING, "scale.x must be positive");
  if (m.type != Marker::LINE_STRIP && m.type != Marker::TEXT_VIEW_FACING) {
    require(m.scale.y > 0.0 && m.scale.z > 0.0, "the scale must be positive");
  }
  if (m.type == Marker::TEXT_VIEW_FACING) require(m.scale.z > 0.0 && !m.text.empty(), "text needs a height");
  if (m.type == Marker::LINE_STRIP) require(m.points.size() >= 2 && m.points.size() <= 16384, "2 to 16384 points");
  if (m.type == Marker::TRIANGLE_LIST) {
    require(!m.points.empty() && m.points.size() % 3 == 0, "whole triangles");
  }
  if (m.type == Marker::ARROW && !m.points.empty()) require(m.points.size() == 2, "an arrow has 2 points");
  if (!has_points) require(m.colors.empty(), "one colour is enough");
  require(m.colors.empty() || m.colors.size() == m.points.size(), "a colour for each point, or none");
  require(!m.colors.empty() || m.color.a > 0.0F, "it must not be transparent");
  for (const auto& color : m.colors) require(color.a > 0.0F, "no point may be transparent");
  for (const auto& point : m.points) require(isFinite(point), "points must be finite");
  require(m.lifetime.isZero(), "lifetime is judged in ROS time, so there must be none");
}

/// Everything rviz would complain about; empty if nothing.
inline std::vector<std::string> lint(const visualization_msgs::MarkerArray& array) {
  using visualization_msgs::Marker;
  std::vector<std::string> faults;
  std::set<std::pair<std::string, int>> seen;
  bool drawing = false;
  for (const Marker& m : array.markers) {
    const std::string who = m.ns + " " + std::to_string(m.id);
    if (m.header.frame_id.empty() || m.header.frame_id.front() == '/') faults.push_back(who + ": bad frame");
    if (m.header.stamp.isZero()) faults.push_back(who + ": no stamp");
    if (m.action == Marker::DELETEALL) {
      if (drawing) faults.push_back(who + ": DELETEALL after ADD");
      continue;
    }
    if (!seen.emplace(m.ns, m.id).second) faults.push_back(who + ": twice in one array");
    if (m.action != Marker::ADD) continue;
    drawing = true;
    lintAdded(m, who, faults);
  }
  return faults;
}

}  // namespace sensory_growth::node::testing
