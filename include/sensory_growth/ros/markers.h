#pragma once

/// Organs, what holds them, lamps and lights as rviz markers. Building is a pure function of the snapshot; only what
/// was drawn before is remembered, so that it can be deleted.

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/snapshot.h"

namespace sensory_growth::node {

struct MarkerSettings {
  std::string frame = "world";
  MarkerShape shape = MarkerShape::tube;
  MarkerField field = MarkerField::curvature;
  double color_limit = 0.0;    ///< value of the brightest colour [SI]; 0: the largest of the organ at present
  double radius_scale = 1.0;   ///< of organs [-]
  double lamp_diameter = 0.0;  ///< [m]
  double scene_size = 0.0;     ///< of the longest organ at the start: light arrows begin so far from the tips [m]
};

using MarkerSettingsPtr = std::shared_ptr<const MarkerSettings>;

/// Settings that fit the organs of `first`, the state at the start.
MarkerSettings makeMarkerSettings(const Parameters& parameters, const Snapshot& first);

/// Everything there is to see, all with action ADD; no namespace and id twice.
visualization_msgs::MarkerArray buildMarkers(const Snapshot& snapshot, const MarkerSettings& settings);

/// One stream of marker arrays: what is gone is deleted, and after a reset everything is drawn afresh.
class MarkerStream {
 public:
  visualization_msgs::MarkerArray next(const Snapshot& snapshot, const MarkerSettings& settings);

 private:
  std::optional<std::uint32_t> epoch_;
  std::set<std::pair<std::string, int>> drawn_;
};

/// A colour of the viridis map, whose lightness rises evenly; x is clamped to [0, 1].
std_msgs::ColorRGBA viridis(double x);

}  // namespace sensory_growth::node
