#include "sensory_growth/rod/rod_fault.h"

#include <cmath>
#include <cstddef>

namespace sensory_growth::rod {
namespace {

/// Beyond these, in SI, energies and stiffnesses are no longer finite.
constexpr double kLargest = 1e30;
constexpr double kSmallest = 1e-30;

bool isNumber(double value) { return std::abs(value) <= kLargest; }

bool isVector(const Vector3& v) { return isNumber(v.x()) && isNumber(v.y()) && isNumber(v.z()); }

bool isPositive(double value) { return value >= kSmallest && value <= kLargest; }

bool isTurn(const Quaternion& q) { return std::abs(q.coeffs().stableNorm() - 1.0) < 1e-6; }

bool isSection(const Section& s) {
  return isPositive(s.radius) && isPositive(s.young_modulus) && isPositive(s.shear_modulus) &&
         isPositive(s.shear_correction) && isNumber(s.density) && s.density >= 0.0;
}

bool isElement(const Element& e) {
  return isPositive(e.rest_length) && isPositive(e.reference_length) && isSection(e.section) && isNumber(e.age) &&
         e.age >= 0.0 && isVector(e.strain) && isVector(e.rest_strain) && isTurn(e.frame) &&
         isVector(e.angular_velocity);
}

bool isSupport(BaseSupport support) {
  return support == BaseSupport::clamped || support == BaseSupport::frozen_first_element ||
         support == BaseSupport::hinged;
}

}  // namespace

std::optional<std::string> findFault(const Rod& rod) {
  const std::size_t n = rod.size();
  if (n == 0 || rod.bends.size() != n || rod.vertices.size() != n + 1) {
    return "has " + std::to_string(n) + " elements, " + std::to_string(rod.bends.size()) + " bends and " +
           std::to_string(rod.vertices.size()) + " vertices; n >= 1, n and n + 1 belong together";
  }
  if (!isVector(rod.base.position) || !isTurn(rod.base.frame) || !isSupport(rod.base_support)) {
    return "its base is none";
  }
  for (std::size_t e = 0; e < n; ++e) {
    if (!isElement(rod.elements[e])) return "element " + std::to_string(e) + " is none";
    const Bend& bend = rod.bends[e];
    if (!isVector(bend.curvature) || !isVector(bend.rest_curvature)) return "bend " + std::to_string(e) + " is none";
  }
  double below = -1.0;
  for (std::size_t i = 0; i <= n; ++i) {
    const Vertex& vertex = rod.vertices[i];
    const bool is_in_order = vertex.label > below && vertex.label >= 0.0 && vertex.label <= 1.0;
    if (!is_in_order || !isVector(vertex.position) || !isVector(vertex.velocity)) {
      return "vertex " + std::to_string(i) + " is none";
    }
    below = vertex.label;
  }
  return std::nullopt;
}

}  // namespace sensory_growth::rod
