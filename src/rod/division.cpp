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
  const Vector3 turning = parent.frame * parent.angular_velocity;  // the same for both in the world
  d.lower.angular_velocity = d.lower.frame.conjugate() * turning;
  d.upper.angular_velocity = d.upper.frame.conjugate() * turning;
  if (mode == DivisionMode::keep_positions) {
    // The mean of two different rotations shortens vectors; both daughters share the defect.
    const Vector3 v = Vector3::UnitZ() + parent.strain;
    const Vector3 defect = parent.frame * v - 0.5 * (d.lower.frame * v + d.upper.frame * v);
    d.lower.strain += d.lower.frame.conjugate() * defect;
    d.upper.strain += d.upper.frame.conjugate() * defect;
  }
  return d;
}

/// The curvature that an element continues into at its lower end. A hinge bends nothing: the element then is taken to
/// go on as it does above.
Bend bendBelow(const Rod& rod, std::size_t e) {
  if (e > 0 || rod.base_support != BaseSupport::hinged) return rod.bends[e];
  return rod.size() > 1 ? rod.bends[1] : Bend();
}

/// The same at its upper end; beyond the last element nothing changes.
Bend bendAbove(const Rod& rod, std::size_t e) {
  if (e + 1 < rod.size()) return rod.bends[e + 1];
  return e >= rod.firstBend() ? rod.bends[e] : Bend();
}

/// Of a frozen element 0 both daughters keep the base frame at the lower end: the old turn is shared by two bends.
void shareTurnAboveFrozen(Rod& rod) {
  if (rod.size() < 2) return;
  const double voronoi = rod.voronoiLength(1);
  const double share = voronoi / (voronoi + 0.25 * rod.elements[0].rest_length);
  rod.bends[1].curvature *= share;
  rod.bends[1].rest_curvature *= share;
}

}  // namespace

std::size_t divide(Rod& rod, const std::vector<bool>& selected, DivisionMode mode) {
  const auto count = static_cast<std::size_t>(std::count(selected.begin(), selected.end(), true));
  if (count == 0) return 0;

  const bool divides_frozen = selected[0] && rod.base_support == BaseSupport::frozen_first_element;
  if (divides_frozen) shareTurnAboveFrozen(rod);

  Rod divided;
  divided.base = rod.base;
  divided.base_support = rod.base_support;
  divided.elements.reserve(rod.size() + count);
  divided.bends.reserve(rod.size() + count);
  divided.vertices.reserve(rod.size() + count + 1);
  divided.vertices.push_back(rod.vertices.front());
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const Element& element = rod.elements[e];
    divided.bends.push_back(rod.bends[e]);
    if (selected[e]) {
      const Bend below = bendBelow(rod, e);
      const Bend above = bendAbove(rod, e);
      Daughters d = daughters(element, below.curvature, above.curvature, mode);
      Bend between;
      between.curvature = dividedCurvature(element.rest_length, below.curvature, above.curvature);
      between.rest_curvature = dividedCurvature(element.rest_length, below.rest_curvature, above.rest_curvature);
      if (e == 0 && divides_frozen) {
        between = above;
        d.upper.frame = (element.frame * exp(0.5 * element.rest_length * between.curvature)).normalized();
      }
      Vertex middle;
      middle.label = 0.5 * (rod.vertices[e].label + rod.vertices[e + 1].label);
      middle.velocity = 0.5 * (rod.vertices[e].velocity + rod.vertices[e + 1].velocity);
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
  if (rod.base_support == BaseSupport::hinged) {
    rod.bends[0].curvature = log(rod.base.frame.conjugate() * rod.elements[0].frame) / rod.voronoiLength(0);
  }
  if (mode == DivisionMode::keep_strain) rod.rebuildPositions();
  return count;
}

std::size_t divideLongElements(Rod& rod, double longest, DivisionMode mode) {
  if (!(longest > 0.0)) throw std::invalid_argument("the longest element must be positive");
  const auto is_too_long = [longest](const Element& element) { return element.rest_length > longest; };
  std::size_t count = 0;
  while (std::any_of(rod.elements.begin(), rod.elements.end(), is_too_long)) {
    std::vector<bool> too_long(rod.size());
    std::transform(rod.elements.begin(), rod.elements.end(), too_long.begin(), is_too_long);
    count += divide(rod, too_long, mode);
  }
  return count;
}

}  // namespace sensory_growth::rod
