#include "sensory_growth/growth/stress_coupling.h"

#include <algorithm>
#include <cstddef>

namespace sensory_growth::growth {

double axialStress(const rod::Element& element) {
  return element.section.young_modulus * (element.strain - element.rest_strain).z();
}

void stressFactors(const StressCoupling& coupling, const rod::Rod& rod, GrowthFactors& factors) {
  factors.resize(rod.size());
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const double relative_stress = coupling.sign * axialStress(rod.elements[e]) / coupling.yield_margin;
    factors[e] = std::clamp(1.0 + relative_stress, 0.0, coupling.largest_factor);
  }
}

}  // namespace sensory_growth::growth
