#pragma once

#include <vector>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// Dead loads: forces that keep their size and direction in the world while the rod moves.
struct Loads {
  rod::Vector3 gravity =
      rod::Vector3::Zero();  ///< acceleration that makes mass heavy [m/s^2]; zero for a weightless rod
  rod::Vector3 tip_force = rod::Vector3::Zero();  ///< force on the last vertex [N]
};

/// Force on `vertex` [N].
rod::Vector3 vertexForce(const rod::Rod& rod, const Loads& loads, std::size_t vertex);

/// Force that element e carries, the sum of the forces on all vertices beyond it [N]; size n.
void elementForces(const rod::Rod& rod, const Loads& loads, std::vector<rod::Vector3>& forces);

}  // namespace sensory_growth::mechanics
