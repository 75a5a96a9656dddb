#include "sensory_growth/rod/division.h"

#include <algorithm>
#include <stdexcept>

namespace sensory_growth::rod {
namespace {

/// Curvature of the bend between the daughters: two quarter turns composed, so that constant curvature stays constant.
Vector3 dividedCurvature(double length, const Vector3& lower, const Vector3& upper) {
  return (2.0 / length) * log(exp(0.25 * length * lower) * exp(0.25 * length * upper));
}

struct Daughters {
  Element lower, upper;
};

/// Each daughter lies on the geodesic from its parent to the neighbour on its side.
Daughters daughters(const Element& parent, const Vector3& lower_curvature, const Vector3& upper_curvature,
                    DivisionMode mode) {
  const double quarter = 0.25 * parent.rest_length;
  Daughters d{parent, parent};
  d.lower.rest_length = d.upper.rest_length = 0.5 * parent.rest_length;
  d.lower.reference_length = d.upper.reference_length = 0.5 * parent.reference_length;
  d.lower.frame = (parent.frame * exp(-quarter * lower_curvature)).normalized();
  d.upper.frame = (parent.frame * exp(quarter * upper_curvature)).normalized();
  if (mode == DivisionMode::keep_positions) {
    // The mean of two different rotations shortens vectors; both daughters share the defect.
    const Vector3 v = Vector3::UnitZ() + parent.strain;
    const Vector3 defect = parent.frame * v - 0.5 * (d.lower.frame * v + d.upper.frame * v);
    d.lower.strain += d.lower.frame.conjugate() * defect;
    d.upper.strain += d.upper.frame.conjugate() * defect;
  }
  return d;
}

}  // namespace

std::size_t divide(Rod& rod, const std::vector<bool>& selected, DivisionMode mode) {
  const auto count = static_cast<std::size_t>(std::count(selected.begin(), selected.end(), true));
  if (count == 0) return 0;

  Rod divided;
  divided.base = rod.base;
  divided.elements.reserve(rod.size() + count);
  divided.bends.reserve(rod.size() + count);
  divided.vertices.reserve(rod.size() + count + 1);
  divided.vertices.push_back(rod.vertices.front());
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const Element& element = rod.elements[e];
    const Bend& below = rod.bends[e];
    divided.bends.push_back(below);
    if (selected[e]) {
      const Bend& above = rod.bends[std::min(e + 1, rod.size() - 1)];
      const Daughters d = daughters(element, below.curvature, above.curvature, mode);
      Bend between;
      between.curvature = dividedCurvature(element.rest_length, below.curvature, above.curvature);
      between.rest_curvature = dividedCurvature(element.rest_length, below.rest_curvature, above.rest_curvature);
      Vertex middle;
      middle.label = 0.5 * (rod.vertices[e].label + rod.vertices[e + 1].label);
      // From below the new vertex is at l/2 R_a (v + R_a^T c), which is the chord midpoint plus the sagitta.
      middle.position =
          rod.vertices[e].position + d.lower.rest_length * (d.lower.frame * (Vector3::UnitZ() + d.lower.strain));
      divided.elements.push_back(d.lower);
      divided.elements.push_back(d.upper);
      divided.bends.push_back(between);
      divided.vertices.push_back(middle);
    } else {
      divided.elements.push_back(element);
    }
    divided.vertices.push_back(rod.vertices[e + 1]);
  }
  rod = std::move(divided);
  if (mode == DivisionMode::keep_strain) rod.rebuildPositions();
  return count;
}

std::size_t divideLongElements(Rod& rod, double longest, DivisionMode mode) {
  if (!(longest > 0.0)) throw std::invalid_argument("the longest element must be positive");
  std::size_t count = 0;
  std::vector<bool> too_long;
  while (true) {
    too_long.assign(rod.size(), false);
    for (std::size_t e = 0; e < rod.size(); ++e) too_long[e] = rod.elements[e].rest_length > longest;
    const std::size_t divided = divide(rod, too_long, mode);
    if (divided == 0) return count;
    count += divided;
  }
}

}  // namespace sensory_growth::rod
