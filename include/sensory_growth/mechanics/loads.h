#pragma once

#include <vector>

#include "sensory_growth/mechanics/surroundings.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// What acts on a rod. Forces are dead: they keep their size and direction in the world while the rod moves. The couple
/// turns with the cross-section, because a dead couple has no potential (model.md 1.5).
struct Loads {
  /// Acceleration that makes mass heavy [m/s^2]; zero for a weightless rod.
  rod::Vector3 gravity = rod::Vector3::Zero();
  rod::Vector3 tip_force = rod::Vector3::Zero();   ///< on the last vertex [N]
  rod::Vector3 line_force = rod::Vector3::Zero();  ///< per rest length, on the whole rod [N/m]
  rod::Vector3 tip_couple = rod::Vector3::Zero();  ///< on the apex, components in its own frame [N m]
  Surroundings surroundings;                       ///< springs, walls and a held apex
};

/// The same loads, all `factor` times as large; surroundings stay.
Loads scaled(const Loads& loads, double factor);

/// Dead force on `vertex` [N].
rod::Vector3 vertexForce(const rod::Rod& rod, const Loads& loads, std::size_t vertex);

/// The couple on the apex in the frame of the last element, whose middle is half a cell below it [N m]. It is
/// constant: the curvature between the two is what the couple makes it.
rod::Vector3 coupleOnLastElement(const rod::Rod& rod, const Loads& loads);

/// Dead force that element e carries, the sum of the forces on all vertices beyond it [N]; size n.
void elementForces(const rod::Rod& rod, const Loads& loads, std::vector<rod::Vector3>& forces);

}  // namespace sensory_growth::mechanics
