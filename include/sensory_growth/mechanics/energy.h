#pragma once

/// The energy of a rod (model.md 1.5), for reports and tests.

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

struct Energy {
  double bending = 0.0;       ///< bending and twist [J]
  double stretching = 0.0;    ///< stretch and shear [J]
  double load = 0.0;          ///< minus the dead forces times the positions of their vertices [J]
  double surroundings = 0.0;  ///< of springs and walls that yield; rigid ones store none [J]

  double total() const { return bending + stretching + load + surroundings; }
};

/// Diagonal of the stiffness of bend j [N m^2]: compliances of the two half cells add (model.md 1.5).
rod::Vector3 bendStiffness(const rod::Rod& rod, std::size_t bend);

/// Energy of the rod as it stands. An inextensible element stores no stretching energy.
Energy energy(const rod::Rod& rod, const Loads& loads);

/// Energy of the velocities of the rod [J]; zero at rest.
double kineticEnergy(const rod::Rod& rod);

}  // namespace sensory_growth::mechanics
