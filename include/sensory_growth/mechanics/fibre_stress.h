#pragma once

#include <cstddef>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// Largest axial stress in a cross-section at a bend [Pa], tension or compression: that of bending at the surface on
/// top of that of stretch (model.md 1.6). Of the weaker neighbour, as both carry the moment of the bend. An
/// inextensible rod does not know its axial force; there it is that of bending alone.
double fibreStress(const rod::Rod& rod, std::size_t bend);

}  // namespace sensory_growth::mechanics
