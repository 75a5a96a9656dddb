#pragma once

#include <algorithm>

namespace sensory_growth::mechanics {

/// How far to move along an unstable direction to about the least energy [rad]: doubling until it rises, then through
/// three points. `energyAt(angle)` gives the energy there and infinity where it makes no sense; `here` is that at zero.
template <class EnergyAt>
double angleOfLeastEnergy(double here, const EnergyAt& energyAt) {
  constexpr double kFirst = 0.02;
  constexpr double kLargest = 0.75;
  double angle = kFirst;
  double before = here, middle = energyAt(angle), beyond = energyAt(2.0 * angle);
  while (beyond < middle && angle < kLargest) {
    angle *= 2.0;
    before = middle;
    middle = beyond;
    beyond = energyAt(2.0 * angle);
  }
  // Vertex of the parabola through angle / 2, angle and 2 angle (0, angle and 2 angle if the first trial was beyond
  // it).
  const double width = angle > kFirst ? 0.5 * angle : angle;
  const double left = (middle - before) / width;
  const double right = (beyond - middle) / angle;
  const double curvature = (right - left) / (0.5 * (width + angle));
  if (!(curvature > 0.0)) return angle;
  return std::clamp(angle - 0.5 * width - left / curvature, 0.25 * angle, 2.0 * angle);
}

}  // namespace sensory_growth::mechanics
