#pragma once

/// What every way of relaxing takes and reports.

#include <cstddef>
#include <optional>
#include <string>

namespace sensory_growth::mechanics {

/// How the search for equilibrium is run; the defaults serve every shipped scenario.
struct RelaxationSettings {
  /// On the scaled residual of model.md 12.4 [-]; below the round-off of n elements, 10 n epsilon, that takes its
  /// place.
  double tolerance = 1e-10;
  int max_iterations = 2000;                   ///< over all branches [-]
  int max_branch_switches = 4;                 ///< moves away from unstable equilibria [-]
  double max_rotation = 0.6;                   ///< largest turn of an element per iteration [rad]
  double max_bend_angle = 1.5707963267948966;  ///< larger turns between neighbours are refused as unresolved [rad]
};

enum class RelaxationReason {
  converged,
  too_many_iterations,
  line_search_failed,  ///< no step along the Newton direction lowers the energy
  unstable,            ///< every branch that was followed ended in an unstable equilibrium
  unresolved_bend,     ///< neighbouring elements turned by more than max_bend_angle: the rod needs more elements
  out_of_reach,        ///< rigid walls or a held apex ask for what the rod cannot do
  not_finite,          ///< the input or an iterate holds NaN or infinity
  no_time_step,  ///< dynamics: elements without mass or stretch and rigid surroundings would need infinitely short
                 ///< time steps
};

/// What is out of balance most.
struct Residual {
  double value = 0.0;       ///< scaled [-]; NaN if anything is
  std::size_t element = 0;  ///< where, counted from the base
};

struct RelaxationReport {
  RelaxationReason reason = RelaxationReason::converged;
  int iterations = 0;             ///< Newton iterations, all branches together, or time steps
  double residual = 0.0;          ///< scaled [-]
  std::size_t worst_element = 0;  ///< where it is largest, counted from the base; only if relaxation failed
  /// Of the Hessian at the end [N m], if it was measured; close to zero for a free azimuth.
  std::optional<double> lowest_eigenvalue;
  int branch_switches = 0;      ///< unstable equilibria left along their eigenvector
  int load_steps = 0;           ///< parts in which the loads were applied; 0 if they were applied at once
  double largest_bend = 0.0;    ///< largest turn between neighbouring elements [rad]
  bool in_time = false;         ///< the rod moved in time: iterations are time steps
  double time = 0.0;            ///< for how long it moved [s]
  double kinetic_energy = 0.0;  ///< at the end [J]

  bool ok() const { return reason == RelaxationReason::converged; }
};

/// One sentence for people, with the figures.
std::string describe(const RelaxationReport& report);

/// Name of the reason, as in the enumeration.
const char* name(RelaxationReason reason);

}  // namespace sensory_growth::mechanics
