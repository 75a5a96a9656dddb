#pragma once

namespace sensory_growth::mechanics {

inline constexpr double kArmijo = 1e-4;       // share of the decrease the slope promises that a step must bring
inline constexpr double kUnstable = 1e-9;     // of B / L: eigenvalues below minus this are unstable, model.md 12.4
inline constexpr double kUnresolvable = 3.0;  // rad: near pi the rotation vector of a bend jumps

}  // namespace sensory_growth::mechanics
