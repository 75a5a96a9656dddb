#pragma once

/// The rules by which rviz refuses or silently drops markers (ros.md 41-44), as a test helper.

#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sensory_growth::node::testing {

/// What is wrong with one marker of an array.
class MarkerLint {
 public:
  MarkerLint(const visualization_msgs::Marker& marker, std::vector<std::string>& faults)
      : marker_(marker), who_(marker.ns + " " + std::to_string(marker.id)), faults_(faults) {}

  void require(bool holds, const std::string& rule) {
    if (!holds) faults_.push_back(who_ + ": " + rule);
  }

  void added() {
    checkPose();
    checkColors();
    checkShape();
    require(marker_.lifetime.isZero(), "lifetime is judged in ROS time, so there must be none");
    require(!marker_.frame_locked, "it must not be locked to a frame: its stamp is that of the state");
    require(marker_.mesh_resource.empty(), "there are no meshes");
    for (const auto& point : marker_.points) require(isFinite(point), "points must be finite");
  }

 private:
  using Marker = visualization_msgs::Marker;

  template <typename Xyz>
  static bool isFinite(const Xyz& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  }

  static bool isOpaqueColor(const std_msgs::ColorRGBA& c) {
    const auto in_range = [](float value) { return value >= 0.0F && value <= 1.0F; };  // false for NaN
    return in_range(c.r) && in_range(c.g) && in_range(c.b) && in_range(c.a) && c.a > 0.0F;
  }

  void checkPose() {
    const geometry_msgs::Quaternion& q = marker_.pose.orientation;
    require(std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) < 1e-6, "the orientation must be normalised");
    require(isFinite(marker_.pose.position), "the position must be finite");
  }

  void checkColors() {
    require(marker_.colors.empty() || marker_.colors.size() == marker_.points.size(),
            "a colour for each point, or none");
    require(!marker_.colors.empty() || isOpaqueColor(marker_.color), "a colour within 0 to 1 that can be seen");
    require(std::all_of(marker_.colors.begin(), marker_.colors.end(), isOpaqueColor),
            "colours of points within 0 to 1 that can be seen");
  }

  void checkShape() {
    const std::size_t points = marker_.points.size();
    require(isFinite(marker_.scale), "the scale must be finite");
    const bool is_text = marker_.type == Marker::TEXT_VIEW_FACING;
    require(is_text || marker_.text.empty(), "only text has a text");
    switch (marker_.type) {
      case Marker::LINE_STRIP:
        require(marker_.scale.x > 0.0, "a line needs a width");
        require(marker_.scale.y == 0.0 && marker_.scale.z == 0.0, "a line has nothing but a width");
        return require(points >= 2 && points <= 16384, "2 to 16384 points");
      case Marker::TRIANGLE_LIST:
        checkSolid();
        return require(points > 0 && points % 3 == 0, "whole triangles");
      case Marker::ARROW:
        require(marker_.scale.x > 0.0 && marker_.scale.y > 0.0, "an arrow needs a shaft and a head");
        require(points == 2 && !(marker_.points[0] == marker_.points[1]), "an arrow goes from one point to another");
        return require(marker_.colors.empty(), "an arrow has one colour");
      case Marker::TEXT_VIEW_FACING:
        require(marker_.scale.z > 0.0, "text needs a height");
        require(marker_.scale.x == 0.0 && marker_.scale.y == 0.0, "text has nothing but a height");
        require(marker_.text.find_first_not_of(" \t\n") != std::string::npos, "there must be something to read");
        return checkNoPoints();
      case Marker::SPHERE:
      case Marker::CUBE:
      case Marker::CYLINDER:
        checkSolid();
        return checkNoPoints();
      default:
        require(false, "no rules are known for type " + std::to_string(marker_.type));
    }
  }

  void checkSolid() {
    require(marker_.scale.x > 0.0 && marker_.scale.y > 0.0 && marker_.scale.z > 0.0, "the scale must be positive");
  }

  void checkNoPoints() { require(marker_.points.empty() && marker_.colors.empty(), "points would be ignored"); }

  const Marker& marker_;
  const std::string who_;
  std::vector<std::string>& faults_;
};

/// Everything rviz would complain about; empty if nothing. `frames` have a way to the fixed frame.
inline std::vector<std::string> lint(const visualization_msgs::MarkerArray& array,
                                     const std::set<std::string>& frames = {"world"}) {
  using visualization_msgs::Marker;
  std::vector<std::string> faults;
  std::set<std::pair<std::string, int>> seen;
  bool is_first = true;
  for (const Marker& marker : array.markers) {
    MarkerLint check(marker, faults);
    check.require(frames.count(marker.header.frame_id) > 0, "nothing is known of frame " + marker.header.frame_id);
    check.require(!marker.header.stamp.isZero(), "no stamp");
    if (marker.action == Marker::DELETEALL) {
      check.require(is_first, "DELETEALL must come first");
    } else {
      check.require(!marker.ns.empty(), "no namespace");
      check.require(seen.emplace(marker.ns, marker.id).second, "twice in one array");
      check.require(marker.action == Marker::ADD || marker.action == Marker::DELETE, "unknown action");
    }
    if (marker.action == Marker::ADD) check.added();
    is_first = false;
  }
  return faults;
}

/// What rviz shows after the arrays it was sent, one after the other.
class MarkerScene {
 public:
  void take(const visualization_msgs::MarkerArray& array) {
    using visualization_msgs::Marker;
    for (const Marker& marker : array.markers) {
      if (marker.action == Marker::DELETEALL) shown_.clear();
      if (marker.action == Marker::DELETE) shown_.erase({marker.ns, marker.id});
      if (marker.action == Marker::ADD) shown_.emplace(marker.ns, marker.id);
    }
  }

  bool shows(const std::string& ns, int id = 0) const { return shown_.count({ns, id}) > 0; }

 private:
  std::set<std::pair<std::string, int>> shown_;
};

}  // namespace sensory_growth::node::testing
