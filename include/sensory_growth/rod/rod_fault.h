#pragma once

#include <optional>
#include <string>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::rod {

/// Why these numbers are the state of no rod (sizes that do not belong together, lengths that are not positive, frames
/// that are no rotations, numbers that are not finite or beyond 1e30 in SI), or nothing.
std::optional<std::string> findFault(const Rod& rod);

}  // namespace sensory_growth::rod
