#pragma once

#include <string>
#include <vector>

namespace sensory_growth::simulation {

/// The known name that was probably meant by `name`: the nearest, if at most a third of its letters are wrong. Null if
/// there is none; points into `known`.
const std::string* nearestName(const std::string& name, const std::vector<std::string>& known);

}  // namespace sensory_growth::simulation
