#pragma once

/// Newton's method for a rod that carries a body couple, which has no energy to go down (model.md 12.3).

#include "reduced_energy.h"

namespace sensory_growth::mechanics {

/// Moves to where forces and the couple balance, stable or not, by steps that lower the largest gradient. Returns
/// whether that falls below `tolerance` [N m]; if not, frames are somewhere on the way. Adds to `iterations`.
bool balanceCouple(ReducedEnergy& energy, double tolerance, double max_rotation, int& iterations);

}  // namespace sensory_growth::mechanics
