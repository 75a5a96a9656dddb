#pragma once

/// What pushes or holds a rod from outside with a force that depends on where the rod is (model.md 12.3, V). The base
/// vertex is held anyway and feels none of it.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// A linear spring of no rest length between a vertex and a fixed point.
struct Spring {
  double label = 1.0;                          ///< of the vertex it is tied to: the nearest one; 1 is the apex
  rod::Vector3 anchor = rod::Vector3::Zero();  ///< [m]
  double stiffness = 0.0;                      ///< [N/m]
};

/// A frictionless plane that vertices cannot pass. It pushes with stiffness times depth on every vertex behind it.
struct Wall {
  rod::Vector3 point = rod::Vector3::Zero();                   ///< any point of the plane [m]
  rod::Vector3 normal = rod::Vector3::UnitZ();                 ///< unit vector towards the free side
  double stiffness = std::numeric_limits<double>::infinity();  ///< per vertex [N/m]; infinite for a rigid wall
};

/// The apex is held in place: position always, direction and roll if `frame` is given.
struct HeldApex {
  rod::Vector3 position = rod::Vector3::Zero();  ///< [m]
  std::optional<rod::Quaternion> frame;          ///< of the apex (model.md 1.4); without it the apex turns freely
};

struct Surroundings {
  std::vector<Spring> springs;
  std::vector<Wall> walls;
  std::optional<HeldApex> held_apex;

  bool empty() const { return springs.empty() && walls.empty() && !held_apex; }
};

/// What the surroundings do to the rod, in the world frame.
struct Reactions {
  std::vector<rod::Vector3> springs;                ///< force of each spring [N]
  std::vector<rod::Vector3> walls;                  ///< force of each wall, summed over the vertices [N]
  rod::Vector3 apex_force = rod::Vector3::Zero();   ///< that holds the apex [N]
  rod::Vector3 apex_couple = rod::Vector3::Zero();  ///< that holds the frame of the apex [N m]
};

/// The vertex a spring is tied to: the one with the nearest label, of two equally near ones that closer to the base.
std::size_t tiedVertex(const rod::Rod& rod, const Spring& spring);

/// Why the surroundings make sense for no rod (number not finite or out of range, normal not of unit length), or
/// nothing.
std::optional<std::string> findFault(const Surroundings& surroundings);

}  // namespace sensory_growth::mechanics
