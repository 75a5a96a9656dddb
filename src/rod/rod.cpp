#include "sensory_growth/rod/rod.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sensory_growth::rod {
namespace {

/// From the lower vertex of the element to its upper one [m].
[[gnu::always_inline]] inline Vector3 chord(const Element& element) {
  return element.rest_length * (element.frame * (Vector3::UnitZ() + element.strain));
}

}  // namespace

double Rod::restLength() const {
  double sum = 0.0;
  for (const Element& element : elements) sum += element.rest_length;
  return sum;
}

double Rod::length() const {
  double sum = 0.0;
  for (std::size_t e = 0; e < size(); ++e) sum += (vertices[e + 1].position - vertices[e].position).norm();
  return sum;
}

double Rod::voronoiLength(std::size_t bend) const {
  const double below = bend > 0 ? elements[bend - 1].rest_length : 0.0;
  return 0.5 * (below + elements[bend].rest_length);
}

double Rod::vertexMass(std::size_t vertex) const {
  const double below = vertex > 0 ? elements[vertex - 1].mass() : 0.0;
  const double above = vertex < size() ? elements[vertex].mass() : 0.0;
  return 0.5 * (below + above);
}

double Rod::vertexLength(std::size_t vertex) const {
  const double below = vertex > 0 ? elements[vertex - 1].rest_length : 0.0;
  const double above = vertex < size() ? elements[vertex].rest_length : 0.0;
  return 0.5 * (below + above);
}

Quaternion Rod::bendFrame(std::size_t bend) const {
  if (bend < firstBend()) return elements[bend].frame;
  return halfWay(bend > 0 ? elements[bend - 1].frame : base.frame, elements[bend].frame);
}

Vector3 Rod::curvatureTowards(std::size_t bend) const {
  return bend < firstBend() ? Vector3(Vector3::Zero()) : bends[bend].curvature;
}

Pose Rod::apex() const {
  const Element& last = elements.back();
  return {vertices.back().position,
          (last.frame * exp(0.5 * last.rest_length * curvatureTowards(size() - 1))).normalized()};
}

Pose Rod::at(double s) const {
  std::size_t e = 0;
  while (e + 1 < size() && s > elements[e].rest_length) s -= elements[e++].rest_length;
  const Element& element = elements[e];
  s = std::clamp(s, 0.0, element.rest_length);
  const double fraction = s / element.rest_length;
  const double from_middle = s - 0.5 * element.rest_length;
  const Vector3 curvature = curvatureTowards(from_middle < 0.0 ? e : std::min(e + 1, size() - 1));
  return {(1.0 - fraction) * vertices[e].position + fraction * vertices[e + 1].position,
          (element.frame * exp(from_middle * curvature)).normalized()};
}

void Rod::rebuild() {
  for (std::size_t e = 0; e < size(); ++e) elements[e].frame = exp(voronoiLength(e) * bends[e].curvature);
  // Frames are normalised beside the chain, not in it: what a product of n unit quaternions loses is round-off.
  Quaternion frame = base.frame;
  Vector3 position = base.position;
  vertices.front().position = position;
  for (std::size_t e = 0; e < size(); ++e) {
    frame = frame * elements[e].frame;
    elements[e].frame = frame.normalized();
    vertices[e + 1].position = position += chord(elements[e]);
  }
}

void Rod::rebuildPositions() {
  Vector3 position = base.position;
  vertices.front().position = position;
  for (std::size_t e = 0; e < size(); ++e) vertices[e + 1].position = position += chord(elements[e]);
}

Rod straightRod(const Pose& base, double length, std::size_t elements, const Section& section) {
  const auto require = [](const char* what, double value) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw std::invalid_argument(std::string(what) + " is " + std::to_string(value) + "; it must be positive");
    }
  };
  require("length", length);
  require("number of elements", static_cast<double>(elements));
  require("radius", section.radius);
  require("Young's modulus", section.young_modulus);
  require("shear modulus", section.shear_modulus);

  Rod rod;
  rod.base = base;
  rod.base.frame.normalize();
  Element element;
  element.rest_length = element.reference_length = length / static_cast<double>(elements);
  element.section = section;
  rod.elements.assign(elements, element);
  rod.bends.resize(elements);
  rod.vertices.resize(elements + 1);
  for (std::size_t v = 0; v <= elements; ++v) {
    rod.vertices[v].label = static_cast<double>(v) / static_cast<double>(elements);
  }
  rod.rebuild();
  return rod;
}

}  // namespace sensory_growth::rod
