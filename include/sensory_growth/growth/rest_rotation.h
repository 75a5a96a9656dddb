#pragma once

/// Circumnutation that turns the rest curvature itself (model.md 5, the draft's (7)): regular where growth ends, but
/// a straight organ never starts to move.

#include <vector>

#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// The bending components of the rest curvature turn from d1 to d2 at one rate, wherever tissue grows.
struct RestRotation {
  double period = 0.0;  ///< of growth time [s]; negative turns from d2 to d1; not 0
  double gate = 1e-3;   ///< tissue turns that grows faster than this fraction of the fastest [-]

  double angularVelocity() const { return 6.283185307179586 / period; }  ///< [rad/s]
};

/// Turns the rest curvature, and with it the actual one and the drive that acts on it, by dt [s], given the elongation
/// rates of the elements at its start and end. Tissue that crosses the gate turns for its share of dt. An exact
/// rotation: with drive and straightening in the turning frame, the step stays of second order.
void turn(rod::Rod& rod, const RestRotation& rotation, const std::vector<double>& rates,
          const std::vector<double>& end_rates, double dt, std::vector<rod::Vector3>& drive);

}  // namespace sensory_growth::growth
