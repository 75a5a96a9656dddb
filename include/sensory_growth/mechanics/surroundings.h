#pragma once

/// What pushes or holds a rod from outside with a force that depends on where the rod is (model.md 12.3, V).

#include <cstddef>
#include <limits>
#include <optional>
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

}  // namespace sensory_growth::mechanics
