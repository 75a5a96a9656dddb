#pragma once

/// Division of elements that have grown too long, by quarter turns (model.md 10).

#include <cstddef>
#include <vector>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::rod {

/// What stays exactly as it is when a curved element becomes two straight ones; both cannot (model.md 10.1).
enum class DivisionMode {
  keep_strain,     ///< daughters inherit the strain; the distal part shifts by (kappa l)^2 l / 32
  keep_positions,  ///< all old vertices stay; daughters share a strain defect of (kappa l)^2 / 32
};

/// Divides every element longer than `longest` [m], repeatedly, until none is. Returns the number of divisions.
/// Throws std::invalid_argument unless longest > 0.
std::size_t divideLongElements(Rod& rod, double longest, DivisionMode mode);

/// Divides the elements for which `selected` (size n) is true, once. Returns the number of divisions.
std::size_t divide(Rod& rod, const std::vector<bool>& selected, DivisionMode mode);

}  // namespace sensory_growth::rod
