#include "sensory_growth/simulation/range.h"

#include <cmath>
#include <sstream>
#include <vector>

namespace sensory_growth::simulation {

bool Range::contains(double value) const {
  if (std::isinf(value)) return infinity && value > 0.0;
  return (includes_low ? value >= low : value > low) && (includes_high ? value <= high : value < high);
}

std::string Range::describe(const char* unit) const {
  std::vector<std::string> bounds;
  const auto add = [&](const char* sign, double bound) {
    std::ostringstream text;
    text.precision(15);
    text << sign << ' ' << bound << (*unit ? " " : "") << unit;
    bounds.push_back(text.str());
  };
  if (std::isfinite(low)) add(includes_low ? ">=" : ">", low);
  if (std::isfinite(high)) add(includes_high ? "<=" : "<", high);
  if (bounds.empty()) return "must be finite";
  return "must be " + bounds[0] + (bounds.size() > 1 ? " and " + bounds[1] : "") +
         (infinity ? std::string(" or ") + infinity : "");
}

}  // namespace sensory_growth::simulation
