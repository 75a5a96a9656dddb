#pragma once

/// The rods of the figures.

#include <cmath>
#include <cstddef>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::bench {

/// Scaled residual to which statics and dynamics are compared.
constexpr double kResidual = 1e-9;

struct LoadedRod {
  rod::Rod rod;
  mechanics::Loads loads;
};

inline rod::Quaternion alongX() { return rod::exp(0.5 * M_PI * rod::Vector3::UnitY()); }

/// A straight, horizontal rod of slenderness 100 whose weight would bend it far: beta = rho A g L^3 / E I = 10.
/// Newton's method needs five iterations (docs/model.md 12.5).
inline LoadedRod heavyCantilever(std::size_t elements) {
  rod::Section section;
  section.radius = 0.01;
  section.young_modulus = 1.0 / section.secondMoment();
  section.shear_modulus = section.young_modulus / 3.0;
  section.density = 10.0 / section.area();
  LoadedRod loaded{rod::straightRod({rod::Vector3::Zero(), alongX()}, 1.0, elements, section), {}};
  loaded.loads.gravity = -rod::Vector3::UnitZ();
  return loaded;
}

/// Section of a herbaceous stem of 1 mm radius.
inline rod::Section stemSection() {
  rod::Section section;
  section.radius = 1e-3;
  section.young_modulus = 1e7;
  section.shear_modulus = section.young_modulus / 3.0;
  section.density = 1000.0;
  return section;
}

/// A straight, horizontal stem of 0.1 m under its weight.
inline LoadedRod stem(std::size_t elements) {
  LoadedRod loaded{rod::straightRod({rod::Vector3::Zero(), alongX()}, 0.1, elements, stemSection()), {}};
  loaded.loads.gravity = -9.81 * rod::Vector3::UnitZ();
  return loaded;
}

}  // namespace sensory_growth::bench
