#pragma once

/// Numbers with units as people write them ("0.8 mm"), turned into SI. The units are those of udunits2.

#include <string>

namespace sensory_growth::simulation {

/// What a number measures, and how to ask for it.
struct Dimension {
  const char* name;     ///< with its article
  const char* unit;     ///< of SI; parsed numbers are multiples of it
  const char* example;  ///< as a file may give it
};

namespace dimension {

inline constexpr Dimension length{"a length", "m", "0.8 mm"};
inline constexpr Dimension time{"a time", "s", "10 min"};
inline constexpr Dimension rate{"a rate", "1/s", "0.05 1/h"};
inline constexpr Dimension angle{"an angle", "rad", "0.1 rad"};
inline constexpr Dimension angle_gradient{"an angle per length", "rad/m", "10 deg/cm"};
inline constexpr Dimension curvature{"a curvature", "1/m", "5 1/m"};
inline constexpr Dimension acceleration{"an acceleration", "m/s^2", "9.81 m/s^2"};
inline constexpr Dimension modulus{"an elastic modulus", "Pa", "10 MPa"};
inline constexpr Dimension density{"a density", "kg/m^3", "1000 kg/m^3"};
inline constexpr Dimension force{"a force", "N", "2 mN"};
inline constexpr Dimension line_force{"a force per length", "N/m", "5 mN/m"};
inline constexpr Dimension stiffness{"a stiffness", "N/m", "20 N/m"};
inline constexpr Dimension couple{"a couple", "N.m", "3 uN.m"};
inline constexpr Dimension energy{"an energy", "J", "1e-12 J"};

}  // namespace dimension

/// The finite decimal number that is the whole of `text`, whatever the locale. Throws std::invalid_argument; its
/// message continues a sentence that begins with the text, such as "is not a finite number".
double parseNumber(const std::string& text);

/// The value in SI of a number, blanks and a unit of that dimension. An angle is a dimension of its own here, and units
/// with an origin ("degC") are refused. Throws std::invalid_argument as parseNumber() does, and std::runtime_error if
/// udunits2 cannot read its database. Thread-safe.
double parseQuantity(const std::string& text, const Dimension& dimension);

}  // namespace sensory_growth::simulation
