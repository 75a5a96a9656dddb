#pragma once

#include <cstddef>
#include <string>

#include "sensory_growth/mechanics/relaxation.h"

namespace sensory_growth::simulation {

/// Why a step of an organ was given up.
enum class OrganFault {
  none,
  relaxation,         ///< no equilibrium, however small the part of the step
  too_many_elements,  ///< more than kMostElements: growth outran longest_element
  step_limits,        ///< the step limits ask for smaller parts than Stepping allows: the step is far too long
};

/// What happened in one step of one organ.
struct OrganReport {
  OrganFault fault = OrganFault::none;
  mechanics::RelaxationReport relaxation;  ///< of the last relaxation
  int substeps = 0;                        ///< parts the step was cut into
  int retries = 0;                         ///< parts that were cut again because relaxation failed
  int iterations = 0;                      ///< Newton iterations or time steps, of all relaxations
  int branch_switches = 0;                 ///< unstable equilibria left, in all relaxations
  std::size_t divisions = 0;

  /// Largest differential growth [-]; above 1, tissue on one side of the organ would have to shrink.
  double largest_differential_growth = 0.0;

  bool ok() const { return fault == OrganFault::none; }
};

/// One sentence for people, with the figures.
std::string describe(const OrganReport& report);

}  // namespace sensory_growth::simulation
