#pragma once

/// Differential growth bends the rest state (model.md 4 and 6, model 1: intrinsic proprioception).
///
/// Per unit growth strain the bending components b0 = (k1, k2) of the rest curvature obey db0 = f - (gamma / R) b0,
/// where f = (-Delta2, Delta1) / R and Delta is the differential growth vector in the actual material frame of the
/// bend.

#include <vector>

#include <Eigen/Core>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/elongation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// How the organ bends by what it senses.
struct BendingLaw {
  double proprioception_length = 0.0;  ///< gamma [m]; gamma / R straightens the organ per unit growth strain
};

/// One over the rest radius at a bend, which is the mean over its two half cells [1/m].
inline double inverseRadius(const rod::Rod& rod, std::size_t bend) {
  const rod::Element& above = rod.elements[bend];
  if (bend == 0) return 1.0 / above.section.radius;
  const rod::Element& below = rod.elements[bend - 1];
  return (below.rest_length + above.rest_length) /
         (below.rest_length * below.section.radius + above.rest_length * above.section.radius);
}

/// f of every bend [1/m per unit growth strain] from what each of them perceives; size n, zero where a bend has no
/// stiffness. Returns the largest differential growth in a cross-section [-]: above 1, tissue on one side would have to
/// shrink (model.md 4.1).
double drive(const rod::Rod& rod, const CueFields& perceived, std::vector<Eigen::Vector2d>& f);

/// First-order exponential step of the rest curvature with the drive held at f: exact in the stiff proprioceptive term.
void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f);

/// Correction that makes the step second order, given the drive f0 at its start and f1 at its predicted end.
void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f0,
             const std::vector<Eigen::Vector2d>& f1);

/// phi1(G) = (1 - exp(-G)) / G and phi2(G) = (exp(-G) - 1 + G) / G^2, smooth through zero (Cox & Matthews 2002).
double phi1(double G);
double phi2(double G);

}  // namespace sensory_growth::growth
