#include "sensory_growth/simulation/commands.h"

#include <sstream>

namespace sensory_growth::simulation {

std::optional<std::string> findFault(const GravityCommand& command) {
  const rod::Vector3& g = command.acceleration;
  std::ostringstream text;
  text << "gravity (" << g.x() << ", " << g.y() << ", " << g.z() << ") m/s^2 ";
  if (!g.allFinite()) return text.str() + "is not finite";
  if (g.stableNorm() <= kMaxGravity) return std::nullopt;
  text << "is more than " << kMaxGravity << " m/s^2";
  return text.str();
}

}  // namespace sensory_growth::simulation
