#pragma once

/// Differential growth bends the rest state (model.md 4 and 6).
///
/// Per unit growth strain the bending components b0 = (k1, k2) of the rest curvature obey
///
///   db0 = f - (gamma / R) (b0 - b*) - (gamma_a / R) (b - b*) + (gamma_r / R) (b - b0),
///
/// where f = (-Delta2, Delta1) / R, Delta is the differential growth vector in the actual material frame of the bend, b
/// are the bending components of the actual curvature and b* the set point. The last term relaxes the twist alike.

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/elongation.h"
#include "sensory_growth/growth/rest_rotation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// What growth does about the curvature there is, beside any cue: the growth laws of model.md 6, in any combination.
/// Lengths [m] act over the radius, per unit growth strain.
struct Proprioception {
  double intrinsic_length = 0.0;   ///< gamma: straightens by the rest curvature (model 1)
  double actual_length = 0.0;      ///< gamma_a: straightens by the actual curvature (model 2)
  double relaxation_length = 0.0;  ///< gamma_r: the rest curvature and twist follow the actual ones (model 3)
  Eigen::Vector2d set_point = Eigen::Vector2d::Zero();  ///< b*: curvature that counts as straight [1/m]
};

/// How the organ bends by what it senses.
struct BendingLaw {
  Proprioception proprioception;
  bool saturation = false;               ///< cues ask for at most 1, together: no side of the organ shrinks for them
  std::optional<RestRotation> rotation;  ///< circumnutation by turning of the rest curvature
};

/// Why the law makes no sense, or nothing.
std::optional<std::string> findFault(const BendingLaw& law);

/// One over the rest radius at a bend, which is the mean over its two half cells [1/m].
inline double inverseRadius(const rod::Rod& rod, std::size_t bend) {
  const rod::Element& above = rod.elements[bend];
  if (bend == 0) return 1.0 / above.section.radius;
  const rod::Element& below = rod.elements[bend - 1];
  return (below.rest_length + above.rest_length) /
         (below.rest_length * below.section.radius + above.rest_length * above.section.radius);
}

/// What drives the rest curvature and twist of every bend [1/m per unit growth strain]: all of the law but the decay
/// of the rest curvature itself, from what each bend perceives and how it is bent; size n, zero where a bend has no
/// stiffness. Returns the largest differential growth that cues ask for in a cross-section [-]: above 1, tissue on one
/// side would have to shrink (model.md 4.1).
double drive(const rod::Rod& rod, const BendingLaw& law, const CueFields& perceived, std::vector<rod::Vector3>& drive);

/// How fast the bending components of the rest curvature change under the drive [1/m per unit growth strain].
Eigen::Vector2d bendingRate(const rod::Rod& rod, const BendingLaw& law, const std::vector<rod::Vector3>& drive,
                            std::size_t bend);

/// First-order exponential step of the rest curvature with the drive held: exact in the stiff decay.
void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<rod::Vector3>& drive);

/// Correction that makes the step second order, given the drive at its start and at its predicted end.
void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<rod::Vector3>& drive,
             const std::vector<rod::Vector3>& new_drive);

/// phi1(G) = (1 - exp(-G)) / G and phi2(G) = (exp(-G) - 1 + G) / G^2, smooth through zero (Cox & Matthews 2002).
double phi1(double G);
double phi2(double G);

}  // namespace sensory_growth::growth
