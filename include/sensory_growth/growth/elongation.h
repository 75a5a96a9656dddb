#pragma once

/// Elongation of the rest state over one step (model.md 3).

#include <vector>

#include "sensory_growth/growth/profile.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// Relative elongation rate of every element [1/s], averaged over it exactly; size n.
void elementRates(const Profile& profile, const rod::Rod& rod, std::vector<double>& rates);

/// How much elements and bends elongate during a step.
struct GrowthStrain {
  std::vector<double> elements;  ///< log of new over old rest length; size n
  std::vector<double> bends;     ///< the same of the Voronoi length; size n
};

/// Integrates the logarithms of the rest lengths with classical RK4, so that lengths stay positive for every step and
/// uniform growth is exact. Owns its work space.
class Elongation {
 public:
  /// Growth strain of `dt` [s]; the rod is not changed.
  const GrowthStrain& strain(const Profile& profile, const rod::Rod& rod, double dt);

  /// The same with all lengths held ("elongation off"): strain is rate times dt.
  const GrowthStrain& strainAtFixedLength(const Profile& profile, const rod::Rod& rod, double dt);

 private:
  GrowthStrain strain_;
  std::vector<double> initial_, stage_, slope_, sum_;
};

/// Lengthens the elements by the strain and dilutes the rest twist, so that the twist angle is carried along
/// (model.md 3.2).
void elongate(rod::Rod& rod, const GrowthStrain& strain);

}  // namespace sensory_growth::growth
