#pragma once

/// Tissue elongates faster when pulled and slower when pressed (Lockhart 1965; model.md 8).

#include <limits>

#include "sensory_growth/growth/elongation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// Walls yield to turgor above a threshold and to whatever pulls on them besides.
struct StressCoupling {
  double yield_margin = std::numeric_limits<double>::infinity();  ///< turgor above the yield threshold, P - Y [Pa]; > 0
  double largest_factor = std::numeric_limits<double>::infinity();  ///< bound on the factor in tension [-]; >= 1
  double sign = 1.0;  ///< 1: compression slows growth down; -1: tension does, as the draft prints it
};

/// Axial stress of an element, tension positive [Pa]; zero for one that cannot stretch.
double axialStress(const rod::Element& element);

/// Factors of every element in the rod as it stands: 1 + stress / yield_margin within 0 and largest_factor.
void stressFactors(const StressCoupling& coupling, const rod::Rod& rod, GrowthFactors& factors);

}  // namespace sensory_growth::growth
