#include "sensory_growth/simulation/organ_state.h"

#include <cmath>

#include "sensory_growth/rod/rod_fault.h"
#include "sensory_growth/simulation/scenario.h"

namespace sensory_growth::simulation {
namespace {

/// Of a step that was taken.
bool isSound(const OrganReport& report) {
  const mechanics::RelaxationReport& relaxation = report.relaxation;
  bool is_finite = true;
  for (const double number : {relaxation.residual, relaxation.lowest_eigenvalue.value_or(0.0), relaxation.largest_bend,
                              relaxation.time, relaxation.kinetic_energy, report.largest_differential_growth}) {
    is_finite = is_finite && std::isfinite(number);
  }
  return report.ok() && relaxation.ok() && is_finite;
}

}  // namespace

std::optional<std::string> findFault(const OrganMoment& moment) {
  if (const auto fault = rod::findFault(moment.rod)) return "the rod " + *fault;
  if (moment.rod.size() > kMostElements) return "the rod has more than " + std::to_string(kMostElements) + " elements";
  if (!isSound(moment.report)) return "the report is not that of a step that was taken";
  return std::nullopt;
}

}  // namespace sensory_growth::simulation
