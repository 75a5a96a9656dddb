#pragma once

#include <string>

namespace sensory_growth::support {

/// An entry of `organs`: a shoot of 20 mm that stands 5 cm beside the origin.
inline std::string organText(const std::string& id) {
  return "id: " + id + R"(
base: {position: [5 cm, 0 m, 0 m], direction: [0, 0, 1]}
length: 20 mm
elements: 10
radius: 0.8 mm
material: {young_modulus: 10 MPa, poisson_ratio: 0.5, density: 1000 kg/m^3}
growth: {profile: apical_flat, rate: 0.6 1/h, zone_length: 15 mm}
sensitivities: {gravity: 0.4, light_direction: 0.8, point_source: 0.8, softening_length: 1 mm}
proprioception: {intrinsic_length: 8 mm}
division: {longest_element: 3 mm}
)";
}

}  // namespace sensory_growth::support
