#include "sensory_growth/mechanics/surroundings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sensory_growth::mechanics {
namespace {

constexpr double kUnit = 1e-9;  // how far from 1 the length of a unit vector may be

std::string text(const rod::Vector3& v) {
  std::ostringstream out;
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return out.str();
}

/// "springs[2].label is 1.5; it must lie in [0, 1]"
template <typename Value>
std::string fault(const std::string& field, const Value& value, const std::string& rule) {
  std::ostringstream out;
  out << field << " is " << value << "; it must " << rule;
  return out.str();
}

std::optional<std::string> findFault(const std::string& name, const rod::Vector3& point) {
  if (point.allFinite()) return std::nullopt;
  return fault(name, text(point), "be finite");
}

std::optional<std::string> findFault(const std::string& name, const Spring& spring) {
  if (!(spring.label >= 0.0 && spring.label <= 1.0)) return fault(name + ".label", spring.label, "lie in [0, 1]");
  if (!(spring.stiffness >= 0.0 && std::isfinite(spring.stiffness))) {
    return fault(name + ".stiffness", spring.stiffness, "be finite and not negative [N/m]");
  }
  return findFault(name + ".anchor", spring.anchor);
}

std::optional<std::string> findFault(const std::string& name, const Wall& wall) {
  if (!(std::abs(wall.normal.norm() - 1.0) <= kUnit)) {
    return fault(name + ".normal", text(wall.normal), "be a unit vector");
  }
  if (!(wall.stiffness > 0.0)) return fault(name + ".stiffness", wall.stiffness, "be positive or infinite [N/m]");
  return findFault(name + ".point", wall.point);
}

std::optional<std::string> findFault(const std::string& name, const HeldApex& apex) {
  if (apex.frame && !(std::abs(apex.frame->norm() - 1.0) <= kUnit)) {
    return fault(name + ".frame", "a quaternion of norm " + std::to_string(apex.frame->norm()), "have norm 1");
  }
  return findFault(name + ".position", apex.position);
}

template <typename Item>
std::optional<std::string> findFault(const std::string& name, const std::vector<Item>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (const auto found = findFault(name + "[" + std::to_string(i) + "]", items[i])) return found;
  }
  return std::nullopt;
}

}  // namespace

std::size_t tiedVertex(const rod::Rod& rod, const Spring& spring) {
  const auto less = [](const rod::Vertex& vertex, double label) { return vertex.label < label; };
  const auto above = std::lower_bound(rod.vertices.begin(), rod.vertices.end(), spring.label, less);
  auto nearest = above == rod.vertices.end() ? above - 1 : above;
  if (above != rod.vertices.begin() && above != rod.vertices.end()) {
    const auto below = above - 1;
    if (spring.label - below->label <= above->label - spring.label) nearest = below;
  }
  return static_cast<std::size_t>(nearest - rod.vertices.begin());
}

std::optional<std::string> findFault(const Surroundings& surroundings) {
  if (const auto found = findFault("springs", surroundings.springs)) return found;
  if (const auto found = findFault("walls", surroundings.walls)) return found;
  if (surroundings.held_apex) return findFault("held_apex", *surroundings.held_apex);
  return std::nullopt;
}

}  // namespace sensory_growth::mechanics
