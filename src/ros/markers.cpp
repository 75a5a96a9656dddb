#include "sensory_growth/ros/markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/marker_colors.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr std::size_t kSides = 10;       // of the tube
constexpr std::size_t kMostRings = 129;  // bounds the size of a message, whatever the number of elements

std_msgs::ColorRGBA color(float r, float g, float b, float a = 1.0F) {
  std_msgs::ColorRGBA c;
  c.r = r;
  c.g = g;
  c.b = b;
  c.a = a;
  return c;
}

const std_msgs::ColorRGBA kPlainOrgan = color(0.35F, 0.65F, 0.25F);
const std_msgs::ColorRGBA kTip = color(0.85F, 0.90F, 0.40F);
const std_msgs::ColorRGBA kAttracting = color(1.0F, 0.75F, 0.10F);
const std_msgs::ColorRGBA kRepelling = color(0.35F, 0.45F, 0.95F);
const std_msgs::ColorRGBA kWall = color(0.60F, 0.75F, 0.90F, 0.25F);
const std_msgs::ColorRGBA kTie = color(0.75F, 0.60F, 0.40F);
const std_msgs::ColorRGBA kLabel = color(0.15F, 0.15F, 0.20F);

/// What is drawn at one vertex.
struct Ring {
  rod::Pose pose;
  double radius = 0.0;  // [m]
  double value = 0.0;   // of the field that is shown
};

rod::Pose poseAt(const rod::Rod& rod, std::size_t vertex) {
  if (vertex == 0) return rod.base;
  if (vertex == rod.size()) return rod.apex();
  return {rod.vertices[vertex].position, rod.bendFrame(vertex)};
}

std::vector<Ring> makeRings(const OrganSnapshot& organ, const MarkerSettings& settings) {
  const rod::Rod& rod = organ.rod;
  const std::size_t n = rod.size();
  const std::size_t count = std::min(n + 1, kMostRings);
  std::vector<Ring> rings;
  rings.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t vertex = i * n / (count - 1);
    const double radius = rod.elements[std::min(vertex, n - 1)].section.radius;
    rings.push_back({poseAt(rod, vertex), settings.radius_scale * radius, fieldAt(organ, vertex, settings.field)});
  }
  return rings;
}

std::vector<std_msgs::ColorRGBA> ringColors(const std::vector<Ring>& rings, MarkerField field, double limit) {
  std::vector<std_msgs::ColorRGBA> colors;
  colors.reserve(rings.size());
  for (const Ring& ring : rings) {
    colors.push_back(field == MarkerField::none ? kPlainOrgan : viridis(ring.value / limit));
  }
  return colors;
}

Marker makeMarker(const Snapshot& snapshot, const MarkerSettings& settings, const std::string& ns, int id, int type) {
  Marker marker;
  marker.header = makeHeader(snapshot, settings.frame);
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.color = kPlainOrgan;
  return marker;
}

void setScale(Marker& marker, double x, double y, double z) {
  marker.scale.x = x;
  marker.scale.y = y;
  marker.scale.z = z;
}

void addTriangle(Marker& mesh, const std::array<geometry_msgs::Point, 3>& points,
                 const std::array<std_msgs::ColorRGBA, 3>& colors) {
  mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  mesh.colors.insert(mesh.colors.end(), colors.begin(), colors.end());
}

std::array<geometry_msgs::Point, kSides> corners(const Ring& ring) {
  std::array<geometry_msgs::Point, kSides> points;
  for (std::size_t k = 0; k < kSides; ++k) {
    const double angle = 2.0 * M_PI * static_cast<double>(k) / kSides;
    const rod::Vector3 spoke(ring.radius * std::cos(angle), ring.radius * std::sin(angle), 0.0);
    points[k] = toPoint(ring.pose.position + ring.pose.frame * spoke);
  }
  return points;
}

/// A closed tube through the rings. Seen from outside, every triangle turns counter-clockwise.
Marker makeTube(Marker marker, const std::vector<Ring>& rings, const std::vector<std_msgs::ColorRGBA>& colors) {
  setScale(marker, 1.0, 1.0, 1.0);
  auto lower = corners(rings.front());
  for (std::size_t k = 0; k < kSides; ++k) {
    addTriangle(marker, {toPoint(rings.front().pose.position), lower[(k + 1) % kSides], lower[k]},
                {colors.front(), colors.front(), colors.front()});
  }
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const auto upper = corners(rings[i]);
    const std_msgs::ColorRGBA &below = colors[i - 1], &above = colors[i];
    for (std::size_t k = 0; k < kSides; ++k) {
      const std::size_t next = (k + 1) % kSides;
      addTriangle(marker, {lower[k], lower[next], upper[next]}, {below, below, above});
      addTriangle(marker, {lower[k], upper[next], upper[k]}, {below, above, above});
    }
    lower = upper;
  }
  for (std::size_t k = 0; k < kSides; ++k) {
    addTriangle(marker, {toPoint(rings.back().pose.position), lower[k], lower[(k + 1) % kSides]},
                {colors.back(), colors.back(), colors.back()});
  }
  return marker;
}

Marker makeLine(Marker marker, const std::vector<Ring>& rings, const std::vector<std_msgs::ColorRGBA>& colors) {
  marker.scale.x = 2.0 * rings.front().radius;
  for (const Ring& ring : rings) marker.points.push_back(toPoint(ring.pose.position));
  marker.colors = colors;
  return marker;
}

void addOrgan(const OrganSnapshot& organ, double color_limit, const Snapshot& snapshot, const MarkerSettings& settings,
              MarkerArray& array) {
  const std::vector<Ring> rings = makeRings(organ, settings);
  const std::vector<std_msgs::ColorRGBA> colors = ringColors(rings, settings.field, color_limit);
  const std::string ns = organ.id + "/" + names::kBodyMarker;
  if (settings.shape == MarkerShape::tube) {
    array.markers.push_back(makeTube(makeMarker(snapshot, settings, ns, 0, Marker::TRIANGLE_LIST), rings, colors));
  } else {
    array.markers.push_back(makeLine(makeMarker(snapshot, settings, ns, 0, Marker::LINE_STRIP), rings, colors));
  }

  Marker tip = makeMarker(snapshot, settings, organ.id + "/" + names::kTipMarker, 0, Marker::SPHERE);
  tip.pose = toPose(rings.back().pose);
  const double diameter = 2.4 * rings.back().radius;  // a little more than the tube, so that it shows
  setScale(tip, diameter, diameter, diameter);
  tip.color = kTip;
  array.markers.push_back(std::move(tip));
}

const std_msgs::ColorRGBA& colorOf(double strength) { return strength < 0.0 ? kRepelling : kAttracting; }

Marker makeLabel(const Snapshot& snapshot, const MarkerSettings& settings, const std::string& ns, int id,
                 const std::string& text, const rod::Vector3& position, double height) {
  Marker label = makeMarker(snapshot, settings, ns, id, Marker::TEXT_VIEW_FACING);
  label.pose.position = toPoint(position);
  label.scale.z = height;
  label.color = kLabel;
  label.text = text;
  return label;
}

/// A glow round the tissue that the other organs sense.
void addSource(const OrganSnapshot& organ, const Snapshot& snapshot, const MarkerSettings& settings,
               MarkerArray& array) {
  if (!organ.source) return;
  Marker glow = makeMarker(snapshot, settings, organ.id + "/" + names::kSourceMarker, 0, Marker::SPHERE);
  glow.pose.position = toPoint(organ.source->position);
  const double diameter =
      0.1 * settings.scene_size + 2.0 * settings.radius_scale * organ.rod.elements[0].section.radius;
  setScale(glow, diameter, diameter, diameter);
  glow.color = colorOf(organ.source->strength);
  glow.color.a = 0.4F;
  array.markers.push_back(std::move(glow));
}

/// A column in all colours, with the range of the field.
void addLegend(double color_limit, const Snapshot& snapshot, const MarkerSettings& settings, MarkerArray& array) {
  if (settings.field == MarkerField::none) return;
  constexpr std::size_t kRings = 33;
  const double height = settings.scene_size;
  const auto above = [&](double z) -> rod::Vector3 { return settings.legend_foot + z * rod::Vector3::UnitZ(); };
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < kRings; ++i) {
    const double fraction = static_cast<double>(i) / (kRings - 1);
    rings.push_back({{above(fraction * height), rod::Quaternion::Identity()}, 0.025 * height, fraction * color_limit});
  }
  const std::vector<std_msgs::ColorRGBA> colors = ringColors(rings, settings.field, color_limit);
  const std::string ns = names::kLegendMarker;
  array.markers.push_back(makeTube(makeMarker(snapshot, settings, ns, 0, Marker::TRIANGLE_LIST), rings, colors));
  const auto write = [&](int id, const std::string& text, double z) {
    array.markers.push_back(makeLabel(snapshot, settings, ns, id, text, above(z), 0.09 * height));
  };
  write(1, "0", -0.08 * height);
  write(2, inUnit(color_limit, settings.field), 1.08 * height);
  write(3, describe(settings.field).title, 1.2 * height);
}

/// The plane as far as the organ can reach.
Marker makeWall(Marker marker, const mechanics::Wall& wall, const rod::Rod& rod) {
  const double side = 2.2 * rod.restLength();
  const double thickness = 1e-3 * side;
  const double offset = (wall.point - rod.base.position).dot(wall.normal) - 0.5 * thickness;
  marker.pose = toPose(
      {rod.base.position + offset * wall.normal, rod::Quaternion::FromTwoVectors(rod::Vector3::UnitZ(), wall.normal)});
  setScale(marker, side, side, thickness);
  marker.color = kWall;
  return marker;
}

Marker makeSpring(Marker marker, const mechanics::Spring& spring, const rod::Rod& rod, double width) {
  marker.points = {toPoint(rod.vertices[mechanics::tiedVertex(rod, spring)].position), toPoint(spring.anchor)};
  marker.scale.x = width;
  marker.color = kTie;
  return marker;
}

Marker makeHeldApex(Marker marker, const mechanics::HeldApex& apex, double size) {
  marker.pose = toPose({apex.position, apex.frame.value_or(rod::Quaternion::Identity())});
  setScale(marker, size, size, 0.2 * size);
  marker.color = kTie;
  return marker;
}

void addSurroundings(const OrganSnapshot& organ, const Snapshot& snapshot, const MarkerSettings& settings,
                     MarkerArray& array) {
  const mechanics::Surroundings& surroundings = organ.surroundings;
  const auto begin = [&](const char* layer, std::size_t i, int type) {
    return makeMarker(snapshot, settings, organ.id + "/" + layer, static_cast<int>(i), type);
  };
  for (std::size_t i = 0; i < surroundings.walls.size(); ++i) {
    array.markers.push_back(makeWall(begin(names::kWallMarker, i, Marker::CUBE), surroundings.walls[i], organ.rod));
  }
  for (std::size_t i = 0; i < surroundings.springs.size(); ++i) {
    array.markers.push_back(makeSpring(begin(names::kSpringMarker, i, Marker::LINE_STRIP), surroundings.springs[i],
                                       organ.rod, 0.01 * settings.scene_size));
  }
  if (surroundings.held_apex) {
    array.markers.push_back(makeHeldApex(begin(names::kHeldApexMarker, 0, Marker::CUBE), *surroundings.held_apex,
                                         0.05 * settings.scene_size));
  }
}

/// The id, with the strength if it is not 1.
std::string labelOf(const std::string& id, double strength) {
  std::ostringstream text;
  text.precision(3);
  text << id;
  if (strength != 1.0) text << " (" << strength << ')';
  return text.str();
}

void addLamp(const growth::PointSource& source, const Snapshot& snapshot, const MarkerSettings& settings,
             MarkerArray& array) {
  const std::string ns = std::string(names::kLampMarker) + "/" + source.id;
  Marker lamp = makeMarker(snapshot, settings, ns, 0, Marker::SPHERE);
  lamp.pose.position = toPoint(source.position);
  setScale(lamp, settings.lamp_diameter, settings.lamp_diameter, settings.lamp_diameter);
  lamp.color = colorOf(source.strength);
  array.markers.push_back(std::move(lamp));
  array.markers.push_back(makeLabel(snapshot, settings, ns, 1, labelOf(source.id, source.strength),
                                    source.position + 1.2 * settings.lamp_diameter * rod::Vector3::UnitZ(),
                                    0.8 * settings.lamp_diameter));
}

/// An arrow that comes with the light and ends before the tips.
void addLight(const growth::LightDirection& light, const rod::Vector3& target, const Snapshot& snapshot,
              const MarkerSettings& settings, MarkerArray& array) {
  const std::string ns = std::string(names::kLightMarker) + "/" + light.id;
  const rod::Vector3 tail = lightTail(light, target, settings);
  Marker arrow = makeMarker(snapshot, settings, ns, 0, Marker::ARROW);
  arrow.points = {toPoint(tail), toPoint(target + 0.4 * settings.scene_size * light.towards)};
  setScale(arrow, 0.3 * settings.lamp_diameter, 0.8 * settings.lamp_diameter, settings.lamp_diameter);
  arrow.color = colorOf(light.strength);
  array.markers.push_back(std::move(arrow));
  array.markers.push_back(
      makeLabel(snapshot, settings, ns, 1, labelOf(light.id, light.strength), tail, 0.8 * settings.lamp_diameter));
}

/// Left of all organs, so that they do not hide it at the start.
rod::Vector3 legendFoot(const Snapshot& first, double scene_size) {
  rod::Vector3 foot = rod::Vector3::Zero();
  double left = std::numeric_limits<double>::max();
  for (const OrganSnapshot& organ : first.organs) {
    foot += organ.rod.base.position / static_cast<double>(first.organs.size());
    for (const rod::Vertex& vertex : organ.rod.vertices) left = std::min(left, vertex.position.x());
  }
  foot.x() = left - 0.7 * scene_size;
  return foot;
}

}  // namespace

rod::Vector3 meanTip(const Snapshot& snapshot) {
  rod::Vector3 sum = rod::Vector3::Zero();
  for (const OrganSnapshot& organ : snapshot.organs) sum += organ.rod.vertices.back().position;
  return sum / static_cast<double>(std::max<std::size_t>(snapshot.organs.size(), 1));
}

rod::Vector3 lightTail(const growth::LightDirection& light, const rod::Vector3& target,
                       const MarkerSettings& settings) {
  return target + settings.scene_size * light.towards;
}

MarkerSettings makeMarkerSettings(const Parameters& parameters, const Snapshot& first) {
  double longest = 0.0;
  for (const OrganSnapshot& organ : first.organs) longest = std::max(longest, organ.rod.restLength());
  MarkerSettings settings;
  settings.frame = parameters.world_frame;
  settings.shape = parameters.marker_style;
  settings.field = parameters.marker_color;
  settings.color_limit = parameters.marker_color_limit;
  settings.radius_scale = parameters.marker_radius_scale;
  settings.lamp_diameter = parameters.marker_lamp_diameter > 0.0 ? parameters.marker_lamp_diameter : 0.15 * longest;
  settings.scene_size = longest;
  settings.legend_foot = legendFoot(first, longest);
  return settings;
}

MarkerArray buildMarkers(const Snapshot& snapshot, const MarkerSettings& settings) {
  MarkerArray array;
  const double color_limit = colorLimit(snapshot, settings.field, settings.color_limit);
  for (const OrganSnapshot& organ : snapshot.organs) {
    addOrgan(organ, color_limit, snapshot, settings, array);
    addSource(organ, snapshot, settings, array);
    addSurroundings(organ, snapshot, settings, array);
  }
  addLegend(color_limit, snapshot, settings, array);
  for (const growth::PointSource& source : snapshot.environment.point_sources) {
    addLamp(source, snapshot, settings, array);
  }
  const rod::Vector3 target = meanTip(snapshot);
  for (const growth::LightDirection& light : snapshot.environment.light_directions) {
    addLight(light, target, snapshot, settings, array);
  }
  return array;
}

MarkerArray MarkerStream::next(const Snapshot& snapshot, const MarkerSettings& settings) {
  MarkerArray built = buildMarkers(snapshot, settings);
  std::set<std::pair<std::string, int>> drawn;
  for (const Marker& marker : built.markers) drawn.emplace(marker.ns, marker.id);

  MarkerArray array;
  if (epoch_ != snapshot.epoch) {
    Marker& all = array.markers.emplace_back();
    all.header = makeHeader(snapshot, settings.frame);
    all.action = Marker::DELETEALL;
    all.pose.orientation.w = 1.0;
  } else {
    for (const auto& [ns, id] : drawn_) {
      if (drawn.count({ns, id})) continue;
      array.markers.push_back(makeMarker(snapshot, settings, ns, id, Marker::SPHERE));
      array.markers.back().action = Marker::DELETE;
    }
  }
  std::move(built.markers.begin(), built.markers.end(), std::back_inserter(array.markers));
  epoch_ = snapshot.epoch;
  drawn_ = std::move(drawn);
  return array;
}

}  // namespace sensory_growth::node
