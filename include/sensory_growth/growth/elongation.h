#pragma once

/// Elongation of the rest state over one step (model.md 3).

#include <vector>

#include "sensory_growth/growth/profile.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// Relative elongation rate of every element [1/s], averaged over it exactly; size n.
void elementRates(const Profile& profile, const rod::Rod& rod, std::vector<double>& rates);

/// How much elements and bends grow during a step, and how long the elements are at its end.
struct GrowthStrain {
  std::vector<double> elements;  ///< log of new over old rest length; size n
  std::vector<double> bends;     ///< the same of the Voronoi length; size n
  std::vector<double> lengths;   ///< new rest lengths [m]; the old ones where lengths are held; size n
};

/// Integrates the logarithms of the rest lengths with classical RK4, so that lengths stay positive for every step and
/// uniform growth is exact. Owns its work space.
class Elongation {
 public:
  /// Growth strain of `dt` [s], given the elementRates() at its start; the rod is not changed.
  const GrowthStrain& strain(const Profile& profile, const rod::Rod& rod, const std::vector<double>& rates, double dt);

  /// The same with all lengths held ("elongation off"): strain is rate times dt.
  const GrowthStrain& strainAtFixedLength(const rod::Rod& rod, const std::vector<double>& rates, double dt);

 private:
  GrowthStrain strain_;
  std::vector<double> initial_, stage_, slope_;
};

/// What growth does to twist (model.md 3.2).
enum class TwistTransport {
  angle,  ///< the angle is carried along, so that the shape does not depend on how frames are labelled; twist dilutes
  rate,   ///< twist per length stays, as in tissue whose growth follows helical fibres
};

/// Gives the elements their new lengths. If the twist angle is carried along, dilutes the rest twist and the third
/// component of the drive that acts on it (differential_growth.h).
void elongate(rod::Rod& rod, const GrowthStrain& strain, TwistTransport twist, std::vector<rod::Vector3>& drive);

}  // namespace sensory_growth::growth
