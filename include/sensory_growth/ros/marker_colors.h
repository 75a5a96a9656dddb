#pragma once

/// What colours organs: the fields, their scales, and the colour map.

#include <std_msgs/ColorRGBA.h>

#include <cstddef>
#include <string>

#include "sensory_growth/ros/parameters.h"
#include "sensory_growth/ros/snapshot.h"

namespace sensory_growth::node {

/// How a field is called and in what unit people read it.
struct FieldName {
  const char* title;
  const char* unit;
  double unit_in_si;
};

FieldName describe(MarkerField field);

/// Value of the field at a vertex [SI], never negative but for tissue that shrinks.
double fieldAt(const OrganSnapshot& organ, std::size_t vertex, MarkerField field);

/// Value of the brightest colour [SI], above zero; that of the darkest is zero. It is `fixed` if that is not 0, else
/// the largest value of all organs, rounded up in the unit of the field, so that it stands still while an organ grows.
double colorLimit(const Snapshot& snapshot, MarkerField field, double fixed);

/// A value [SI] in the unit of the field, such as "20 1/m".
std::string inUnit(double value, MarkerField field);

/// Smallest number of 1, 2 and 5 times a power of ten that is not below x > 0.
double roundUp(double x);

/// A colour of the viridis map, whose lightness rises evenly; x is clamped to [0, 1].
std_msgs::ColorRGBA viridis(double x);

}  // namespace sensory_growth::node
