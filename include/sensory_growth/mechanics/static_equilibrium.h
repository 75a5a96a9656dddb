#pragma once

/// Static equilibrium of a rod under dead loads, by Newton's method on rotations (model.md 12).
///
/// Under dead loads the strain of every element follows from its frame, so the energy reduces to one of the n frames
/// alone, whose Hessian is block tridiagonal with 3x3 blocks: an iteration costs O(n) and the inextensible limit is
/// harmless.

#include <memory>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// What to find out about the stability of an equilibrium. Whether it is stable is always decided, mostly by a Cholesky
/// factor; the lowest eigenvalue takes about as long as two more iterations.
enum class Stability { decided, measured };

/// Owns the work space of its iterations.
class StaticEquilibrium {
 public:
  explicit StaticEquilibrium(const RelaxationSettings& settings = {});
  ~StaticEquilibrium();
  StaticEquilibrium(StaticEquilibrium&&) noexcept;
  StaticEquilibrium& operator=(StaticEquilibrium&&) noexcept;

  /// Moves the rod from the shape of its curvature to a stable equilibrium. On failure the rod is left as it was given.
  /// A rod in surroundings is left to SupportedEquilibrium.
  RelaxationReport relax(rod::Rod& rod, const Loads& loads, Stability stability = Stability::measured);

  /// So many iterations from a rod that is already close, such as one that has grown a little: each squares the error.
  /// Neither residual nor stability are looked at. A rod that is not close, or is unstable, is relaxed instead.
  RelaxationReport approach(rod::Rod& rod, const Loads& loads, int iterations = 2);

  /// Decides about stability and relaxes like relax() the rod of the last approach(), of which only curvatures have
  /// changed since: takes over no more than these.
  RelaxationReport relaxCorrected(rod::Rod& rod, const Loads& loads);

  /// For loads that are too much for relax() at once: starts again from the unloaded rod and applies them in steps, as
  /// long as the rod can follow and as short as it needs. Where several equilibria are stable, this may find another
  /// one than relax() does from where the rod stands. On failure the rod is left as it was given.
  RelaxationReport relaxInLoadSteps(rod::Rod& rod, const Loads& loads);

  /// What the surroundings do to the rod of the last relax() that converged in them.
  const Reactions& reactions() const;

  /// Lowest eigenvalue of the Hessian of the rod as it stands, surroundings left aside [N m].
  double lowestEigenvalue(const rod::Rod& rod, const Loads& loads);

 private:
  struct Workspace;
  RelaxationReport relaxAssigned(rod::Rod& rod, const Loads& loads, Stability stability, bool is_close);

  RelaxationSettings settings_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace sensory_growth::mechanics
