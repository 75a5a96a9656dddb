#include "sensory_growth/mechanics/fibre_stress.h"

#include <algorithm>
#include <cmath>

#include "sensory_growth/mechanics/energy.h"

namespace sensory_growth::mechanics {
namespace {

double stressOf(const rod::Element& element, double moment) {
  const rod::Section& section = element.section;
  const double of_bending = moment * section.radius / section.secondMoment();
  const double of_stretch = section.young_modulus * std::abs(element.strain.z() - element.rest_strain.z());
  return of_bending + of_stretch;
}

}  // namespace

double fibreStress(const rod::Rod& rod, std::size_t bend) {
  const rod::Vector3 turn = rod.bends[bend].curvature - rod.bends[bend].rest_curvature;
  const double moment = bendStiffness(rod, bend).cwiseProduct(turn).head<2>().norm();
  const double above = stressOf(rod.elements[bend], moment);
  return bend == 0 ? above : std::max(stressOf(rod.elements[bend - 1], moment), above);
}

}  // namespace sensory_growth::mechanics
