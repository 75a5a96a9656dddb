#pragma once

/// The state of one rod (model.md 1): a chain of n elements between n + 1 vertices, held at its base.
///
/// Element e joins vertices e and e + 1. Bend j >= 1 sits at vertex j between elements j - 1 and j; bend 0 joins the
/// base frame to element 0 over half a cell, which keeps the clamp second order (model.md 1.4). Without a clamp bend 0
/// has no stiffness and its curvature only says how element 0 stands to the base frame. Frames have the
/// directors d1, d2, d3 as columns; d3 is the tangent of the unsheared rod and points from base to apex. "Rest" is the
/// stress-free state with growth included. SI units; vectors called curvature and strain are components in the material
/// frame.

#include <cstddef>
#include <type_traits>
#include <vector>

#include "sensory_growth/rod/rotations.h"
#include "sensory_growth/rod/section.h"

namespace sensory_growth::rod {

/// Position and orientation of a cross-section in the world.
struct Pose {
  Vector3 position = Vector3::Zero();         ///< [m]
  Quaternion frame = Quaternion::Identity();  ///< columns are d1, d2, d3
};

/// How the rod is held at its base.
enum class BaseSupport {
  clamped,               ///< bend 0 joins the base frame to element 0 over half a cell: second order
  frozen_first_element,  ///< element 0 has the base frame, as in classical codes: first order (model.md 1.4)
  hinged,                ///< vertex 0 stays, element 0 turns freely
};

struct Element {
  double rest_length = 0.0;       ///< growth included [m]
  double reference_length = 0.0;  ///< rest length of the same tissue before any growth [m]
  Section section;
  double age = 0.0;                       ///< of the material, by the clock of its organ [s]
  Vector3 strain = Vector3::Zero();       ///< sigma: shear along d1, d2 and stretch along d3 [-]
  Vector3 rest_strain = Vector3::Zero();  ///< sigma of the stress-free element [-]
  Quaternion frame = Quaternion::Identity();
  Vector3 angular_velocity = Vector3::Zero();  ///< material components [rad/s]; zero at rest

  double mass() const { return section.lineDensity() * rest_length; }  ///< [kg]
};

struct Bend {
  Vector3 curvature = Vector3::Zero();       ///< kappa: turning about d1, d2 and twist per unit rest length [1/m]
  Vector3 rest_curvature = Vector3::Zero();  ///< kappa of the stress-free rod [1/m]
};

struct Vertex {
  Vector3 position = Vector3::Zero();  ///< [m]
  double label = 0.0;                  ///< material coordinate in [0, 1], fixed for life
  Vector3 velocity = Vector3::Zero();  ///< [m/s]; zero at rest
};

/// The strains (curvature, strain) are the state; frames and positions follow from them and the base by rebuild(). A
/// rod that moves carries its velocities along, so that whoever copies, divides or takes back a rod does so with them.
struct Rod {
  Pose base;  ///< at vertex 0
  BaseSupport base_support = BaseSupport::clamped;
  std::vector<Element> elements;  ///< n
  std::vector<Bend> bends;        ///< n
  std::vector<Vertex> vertices;   ///< n + 1

  std::size_t size() const { return elements.size(); }

  /// The first bend that has stiffness: 0 on a clamp, else 1.
  std::size_t firstBend() const { return base_support == BaseSupport::clamped ? 0 : 1; }

  double restLength() const;                      ///< rest arc length of the whole rod [m]
  double length() const;                          ///< current length of the polyline [m]
  double voronoiLength(std::size_t bend) const;   ///< rest length that bend answers for [m]
  double vertexMass(std::size_t vertex) const;    ///< half the mass of each neighbouring element [kg]
  double vertexLength(std::size_t vertex) const;  ///< half the rest length of each neighbouring element [m]

  /// Frame at bend j: half-way along the geodesic between its neighbours. Everything sensed at a bend uses this frame.
  Quaternion bendFrame(std::size_t bend) const;

  /// Curvature with which an element ends at a bend: zero at one without stiffness, whose turn is not the element's.
  Vector3 curvatureTowards(std::size_t bend) const;

  /// Position of the last vertex with the frame extrapolated over the last half cell (model.md 1.4).
  Pose apex() const;

  /// Pose at rest arc length s [m], clamped to [0, restLength()]: position linear along the element, frame along the
  /// geodesic.
  Pose at(double s) const;

  /// Recomputes frames and positions from base, curvature and strain.
  void rebuild();

  /// Recomputes positions from base, frames and strain.
  void rebuildPositions();
};

/// Mean over the Voronoi cell of a bend of what value(e) gives for its elements: weighted by rest length.
template <typename Value>
auto voronoiMean(const Rod& rod, std::size_t bend, const Value& value) {
  using Mean = std::decay_t<decltype(value(bend))>;
  if (bend == 0) return Mean(value(bend));
  const double below = rod.elements[bend - 1].rest_length;
  const double above = rod.elements[bend].rest_length;
  return Mean((below * value(bend - 1) + above * value(bend)) / (below + above));
}

/// A straight, stress-free rod of `elements` equal elements. Throws std::invalid_argument unless length, radius,
/// elements and the moduli are positive and finite.
Rod straightRod(const Pose& base, double length, std::size_t elements, const Section& section);

}  // namespace sensory_growth::rod
