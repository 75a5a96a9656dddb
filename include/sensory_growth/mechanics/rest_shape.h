#pragma once

#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// Relaxation without elasticity ("kinematic mode"): the rod takes the shape of its rest state. On failure (numbers
/// that are not finite, unresolved bends) the rod is left as it was given.
RelaxationReport assumeRestShape(rod::Rod& rod, const RelaxationSettings& settings);

}  // namespace sensory_growth::mechanics
