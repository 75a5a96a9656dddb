#pragma once

/// Rods with prescribed stiffness and weight, in the units of the reference solutions (length 1, bending stiffness 1).

#include <cmath>
#include <cstddef>
#include <random>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::support {

/// Frame with d3 along +x and d1 along +z: a horizontal rod that bends in the x-z plane under gravity along -z.
inline rod::Quaternion alongX() {
  rod::Matrix3 directors;
  directors.col(0) = rod::Vector3::UnitZ();
  directors.col(1) = -rod::Vector3::UnitY();
  directors.col(2) = rod::Vector3::UnitX();
  return rod::Quaternion(directors);
}

/// Rotation about the rod's own axis.
inline rod::Quaternion rolled(const rod::Quaternion& frame, double angle) {
  return frame * rod::exp(angle * rod::Vector3::UnitZ());
}

/// Section with E I = bending_stiffness, 2 G I = E I / 1.5 and weight per length = weight under unit gravity.
inline rod::Section section(double radius, double bending_stiffness, double weight) {
  rod::Section s;
  s.radius = radius;
  s.young_modulus = bending_stiffness / (M_PI * std::pow(radius, 4) / 4.0);
  s.shear_modulus = s.young_modulus / 3.0;
  s.density = weight / (M_PI * radius * radius);
  return s;
}

inline rod::Section inextensibleSection(double bending_stiffness, double weight) {
  rod::Section s = section(0.01, bending_stiffness, weight);
  s.inextensible = true;
  return s;
}

inline mechanics::Loads unitGravity() {
  mechanics::Loads loads;
  loads.gravity = -rod::Vector3::UnitZ();
  return loads;
}

inline rod::Vector3 randomVector(std::mt19937& generator, double scale) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

/// A rod with random lengths, curvatures, rest curvatures, strains, sections and base.
inline rod::Rod randomRod(std::mt19937& generator, std::size_t elements) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  rod::Rod rod = rod::straightRod({randomVector(generator, 1.0), rod::exp(randomVector(generator, 1.5))}, 1.0, elements,
                                  section(0.05, 1.0, 2.0));
  for (rod::Element& e : rod.elements) {
    e.rest_length *= uniform(generator);
    e.reference_length = e.rest_length / uniform(generator);
    e.section.radius *= uniform(generator);
    e.strain = randomVector(generator, 0.05);
    e.rest_strain = randomVector(generator, 0.05);
  }
  for (rod::Bend& b : rod.bends) {
    b.curvature = randomVector(generator, 3.0);
    b.rest_curvature = randomVector(generator, 3.0);
  }
  rod.rebuild();
  return rod;
}

/// The same with all that random rods leave alike: no field has a value that another one could be mistaken for.
inline rod::Rod randomMovingRod(std::mt19937& generator, std::size_t elements) {
  rod::Rod rod = randomRod(generator, elements);
  std::uniform_real_distribution<double> label(0.0, 0.9 / static_cast<double>(elements));
  std::uniform_real_distribution<double> factor(0.5, 1.5);
  for (std::size_t v = 0; v <= elements; ++v) {
    if (v > 0 && v < elements) rod.vertices[v].label += label(generator);
    rod.vertices[v].velocity = randomVector(generator, 2.0);
  }
  bool is_inextensible = false;
  for (rod::Element& e : rod.elements) {
    e.angular_velocity = randomVector(generator, 4.0);
    e.age = 3600.0 * factor(generator);
    e.section.young_modulus *= factor(generator);
    e.section.shear_modulus *= factor(generator);
    e.section.density *= factor(generator);
    e.section.shear_correction *= factor(generator);
    e.section.inextensible = is_inextensible = !is_inextensible;
  }
  return rod;
}

/// Observed order of convergence from the errors at step h and h / 2.
inline double order(double coarse_error, double fine_error) { return std::log2(std::abs(coarse_error / fine_error)); }

}  // namespace sensory_growth::support
