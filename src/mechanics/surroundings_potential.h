#pragma once

/// The surroundings as a potential of the vertex positions, with force and stiffness (model.md 12.3, V).
///
/// Rigid walls and a held apex are augmented Lagrangians (Hestenes 1969, Powell 1969): a penalty and a multiplier, the
/// force, which is corrected from round to round. Every term is convex. The frame of a held apex is not part of it.

#include <cstddef>
#include <vector>

#include "chain_cholesky.h"
#include "sensory_growth/mechanics/surroundings.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// Positions of the vertices relative to the base; n + 1 columns.
Field positionsFromBase(const rod::Rod& rod);

class SurroundingsPotential {
 public:
  /// Forgets multipliers. Rigid surroundings start with `penalty` [N/m].
  void assign(const rod::Rod& rod, const Surroundings& surroundings, double penalty);

  /// True if there are rigid walls or a held apex.
  bool isRigid() const { return is_rigid_; }

  /// Energy [J] at the positions relative to the base (n + 1 columns), which keeps their digits. Keeps them for the
  /// calls below.
  double evaluate(const Field& positions);

  /// Force on every vertex [N], and the sum of the magnitudes of its parts.
  const Field& forces() const { return forces_; }
  double totalForce() const { return total_force_; }

  /// Writes the Hessian at every vertex into the links [N/m], with the penalty multiplied by `emphasis`.
  void writeStiffness(double emphasis, std::vector<ChainLink>& links) const;

  /// Largest stiffness that acts at the moment [N/m].
  double largestStiffness() const;

  /// Largest distance by which the rigid surroundings are not met, or press where they are not touched [m].
  double violation() const;

  /// Makes the forces of rigid surroundings their multipliers.
  void updateMultipliers();

  double penalty() const { return penalty_; }
  void setPenalty(double penalty);

  /// Forces of springs, walls and apex; the couple is left zero.
  Reactions reactions() const;

 private:
  struct Contact {
    double depth = 0.0;       ///< behind the wall [m]
    double multiplier = 0.0;  ///< [N]
  };

  double stiffnessOf(const Wall& wall) const;
  double push(const Wall& wall, const Contact& contact) const;

  Surroundings surroundings_;
  std::vector<std::size_t> tied_;               ///< per spring
  std::vector<std::vector<Contact>> contacts_;  ///< per wall and vertex
  rod::Vector3 apex_gap_ = rod::Vector3::Zero();
  rod::Vector3 apex_multiplier_ = rod::Vector3::Zero();
  double penalty_ = 0.0;
  bool is_rigid_ = false;

  Field positions_, forces_;
  double total_force_ = 0.0;
};

}  // namespace sensory_growth::mechanics
