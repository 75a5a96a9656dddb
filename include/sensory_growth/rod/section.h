#pragma once

#include <cmath>

#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::rod {

/// Circular cross-section of an element and the tissue that fills it. SI units.
struct Section {
  double radius = 0.0;                    ///< rest radius [m]
  double young_modulus = 0.0;             ///< E [Pa]
  double shear_modulus = 0.0;             ///< G [Pa]; E/3 for an incompressible tissue
  double density = 0.0;                   ///< [kg/m^3]
  double shear_correction = 27.0 / 28.0;  ///< alpha of a circular section [-]
  bool inextensible = false;              ///< stretch and shear compliances are zero (the Kirchhoff rod)

  double area() const { return M_PI * radius * radius; }                   ///< pi R^2 [m^2]
  double secondMoment() const { return 0.25 * area() * radius * radius; }  ///< pi R^4 / 4 [m^4]
  double lineDensity() const { return density * area(); }                  ///< mass per unit rest length [kg/m]

  /// Diagonal of B: bending about d1 and d2 (E I) and twist about d3 (2 G I) [N m^2].
  Vector3 bendStiffness() const {
    const double moment = secondMoment();
    return {young_modulus * moment, young_modulus * moment, 2.0 * shear_modulus * moment};
  }

  /// Diagonal of S^-1: shear along d1 and d2 (1 / alpha G A) and stretch (1 / E A) [1/N]; zero when inextensible.
  Vector3 stretchCompliance() const {
    if (inextensible) return Vector3::Zero();
    const double shear = 1.0 / (shear_correction * shear_modulus * area());
    return {shear, shear, 1.0 / (young_modulus * area())};
  }
};

}  // namespace sensory_growth::rod
