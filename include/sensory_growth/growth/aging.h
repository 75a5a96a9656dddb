#pragma once

/// Tissue that has stopped elongating grows stiffer and thicker (model.md 9). What is laid down is born free of stress
/// in the shape at hand, so that aging moves nothing but by the weight it adds.

#include <cstddef>
#include <optional>
#include <vector>

#include "sensory_growth/growth/elongation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// A value of the section that goes from what it is in young tissue to what it is in mature one, as 1 - exp(-age /
/// time).
struct Maturation {
  double mature = 0.0;  ///< in SI; > 0
  double time = 0.0;    ///< of age [s]; > 0
};

/// What the age of tissue counts.
enum class AgingClock {
  maturation,  ///< time, as far as tissue elongates more slowly than the profile ever lets it
  time,        ///< all time
};

struct Aging {
  AgingClock clock = AgingClock::maturation;
  std::optional<Maturation> young_modulus;  ///< [Pa]; the shear modulus keeps its ratio to it
  std::optional<Maturation> radius;         ///< [m]
};

/// What the section of young tissue becomes at an age [s].
rod::Section agedSection(const Aging& aging, const rod::Section& young, double age);

/// Gives every element the age and the section that it has when `share` of the dt [s] have passed in which it grows by
/// `strain` from where it stood in `before`; fastest_rate [1/s] is that of the profile.
void growOlder(rod::Rod& rod, const rod::Rod& before, const Aging& aging, const rod::Section& young,
               const GrowthStrain& strain, double fastest_rate, double dt, double share = 1.0);

/// Moves the rest state of a rod whose sections have changed since `before`. A rest value takes over what the
/// compliance under its moment or force loses, so that at the same moment the shape is the same. Where compliance
/// rises, the rest state stays and the rod gives way. Owns its work space.
class Deposition {
 public:
  /// Nothing has been deposited yet on a rod of n elements.
  void begin(std::size_t n) { deposits_.assign(n, {}); }

  /// Brings the deposit up to the sections at hand, with the moments and forces of `before`.
  void predict(rod::Rod& rod, const rod::Rod& before);

  /// The same with the mean of those and of the moments and forces at hand, which makes the step second order.
  void correct(rod::Rod& rod, const rod::Rod& before);

 private:
  /// What the rest state of a bend and an element has taken over.
  struct Deposit {
    rod::Vector3 curvature = rod::Vector3::Zero();  ///< [1/m]
    rod::Vector3 strain = rod::Vector3::Zero();     ///< [-]
  };
  void bringUpTo(const rod::Vector3& curvature, const rod::Vector3& strain, rod::Rod& rod, std::size_t e);

  std::vector<Deposit> deposits_;
};

}  // namespace sensory_growth::growth
