#include "sensory_growth/mechanics/rest_shape.h"

#include <algorithm>
#include <cmath>

namespace sensory_growth::mechanics {

RelaxationReport assumeRestShape(rod::Rod& rod, const RelaxationSettings& settings) {
  RelaxationReport report;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double turn = j < rod.firstBend() ? 0.0 : rod.voronoiLength(j) * rod.bends[j].rest_curvature.norm();
    if (!std::isfinite(turn) || !rod.elements[j].rest_strain.allFinite()) {
      report.reason = RelaxationReason::not_finite;
      return report;
    }
    report.largest_bend = std::max(report.largest_bend, turn);
  }
  if (report.largest_bend > settings.max_bend_angle) {
    report.reason = RelaxationReason::unresolved_bend;
    return report;
  }
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) rod.bends[j].curvature = rod.bends[j].rest_curvature;
  for (rod::Element& element : rod.elements) element.strain = element.rest_strain;
  rod.rebuild();
  return report;
}

}  // namespace sensory_growth::mechanics
