#pragma once

/// Rods that move.

#include <algorithm>
#include <cstddef>
#include <random>

#include "sensory_growth/mechanics/dynamics.h"
#include "support/rods.h"

namespace sensory_growth::support {

using mechanics::DynamicsSettings;
using mechanics::Loads;
using rod::Vector3;

inline rod::Rod horizontal(std::size_t elements, const rod::Section& section) {
  return rod::straightRod({Vector3::Zero(), alongX()}, 1.0, elements, section);
}

inline DynamicsSettings undamped() {
  DynamicsSettings settings;
  settings.damping = 0.0;
  return settings;
}

inline double largestDistance(const rod::Rod& a, const rod::Rod& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v <= a.size(); ++v) {
    largest = std::max(largest, (a.vertices[v].position - b.vertices[v].position).norm());
  }
  return largest;
}

inline rod::Rod randomRod(unsigned seed) {
  std::mt19937 generator(seed);
  return randomRod(generator, 12);
}

inline Loads allKinds() {
  Loads loads;
  loads.gravity = {0.5, -0.3, -1.0};
  loads.line_force = {0.0, 0.4, 0.2};
  loads.tip_force = {0.3, 0.5, -0.4};
  return loads;
}

}  // namespace sensory_growth::support
