#pragma once

/// Static equilibrium of a clamped rod under dead loads, by Newton's method on rotations (model.md 12).
///
/// Under dead loads the strain of every element follows from its frame, so the energy reduces to one of the n frames
/// alone, whose Hessian is block tridiagonal with 3x3 blocks: an iteration costs O(n) and the inextensible limit is
/// harmless.

#include <memory>
#include <string>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// How the search for equilibrium is run; the defaults serve every shipped scenario.
struct RelaxationSettings {
  double tolerance = 1e-10;                    ///< on the scaled residual of model.md 12.4 [-]
  int max_iterations = 200;                    ///< over all branches [-]
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
  not_finite,          ///< the input or an iterate holds NaN or infinity
};

struct RelaxationReport {
  RelaxationReason reason = RelaxationReason::converged;
  int iterations = 0;              ///< Newton iterations, all branches together
  double residual = 0.0;           ///< scaled [-]
  double lowest_eigenvalue = 0.0;  ///< of the Hessian at the end [N m]; close to zero for a free azimuth
  int branch_switches = 0;         ///< unstable equilibria left along their eigenvector
  double largest_bend = 0.0;       ///< largest turn between neighbouring elements [rad]

  bool ok() const { return reason == RelaxationReason::converged; }
};

/// One sentence for people, with the figures.
std::string describe(const RelaxationReport& report);

/// Name of the reason, as in the enumeration.
const char* name(RelaxationReason reason);

/// Owns the work space, so that repeated solves of one organ allocate nothing.
class StaticEquilibrium {
 public:
  explicit StaticEquilibrium(const RelaxationSettings& settings = {});
  ~StaticEquilibrium();
  StaticEquilibrium(StaticEquilibrium&&) noexcept;
  StaticEquilibrium& operator=(StaticEquilibrium&&) noexcept;

  /// Moves the rod from where it stands to a stable equilibrium. On failure the rod is left as it was given.
  RelaxationReport relax(rod::Rod& rod, const Loads& loads);

  /// Lowest eigenvalue of the Hessian of the rod as it stands [N m].
  double lowestEigenvalue(const rod::Rod& rod, const Loads& loads);

 private:
  struct Workspace;
  RelaxationSettings settings_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace sensory_growth::mechanics
