#include "sensory_growth/rod/section.h"

namespace sensory_growth::rod {

double Section::area() const { return M_PI * radius * radius; }

double Section::secondMoment() const { return 0.25 * M_PI * radius * radius * radius * radius; }

double Section::lineDensity() const { return density * area(); }

Vector3 Section::bendStiffness() const {
  const double moment = secondMoment();
  return {young_modulus * moment, young_modulus * moment, 2.0 * shear_modulus * moment};
}

Vector3 Section::stretchCompliance() const {
  if (inextensible) return Vector3::Zero();
  const double shear = 1.0 / (shear_correction * shear_modulus * area());
  return {shear, shear, 1.0 / (young_modulus * area())};
}

}  // namespace sensory_growth::rod
