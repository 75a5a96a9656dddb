#pragma once

/// Energy of a rod in its surroundings as a function of frames and strains, with gradient and Hessian (model.md 12.2,
/// 12.3). Positions are rebuilt from the base. Perturbations are R_e -> R_e exp(w_e), sigma_e -> sigma_e + dsigma_e.

#include <cstddef>
#include <vector>

#include "chain_cholesky.h"
#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/rod/rod.h"
#include "surroundings_potential.h"

namespace sensory_growth::mechanics {

/// What a rod in its surroundings is free to choose.
struct Configuration {
  std::vector<rod::Quaternion> frames;  ///< n
  Field strains;                        ///< sigma, n columns [-]
};

/// Derivative of the energy with respect to a Configuration, and changes of one.
struct Variation {
  Field rotations;  ///< w [rad], or the couples conjugate to it [N m]
  Field strains;    ///< dsigma [-], or the couples conjugate to it [N m]

  double dot(const Variation& other) const {
    return rotations.cwiseProduct(other.rotations).sum() + strains.cwiseProduct(other.strains).sum();
  }
};

class SupportedEnergy {
 public:
  /// Takes what stays constant during one relaxation. Reuses the memory of earlier calls.
  void assign(const rod::Rod& rod, const Loads& loads);

  std::size_t size() const { return rest_length_.size(); }
  SurroundingsPotential& surroundings() { return surroundings_; }

  /// Energy [J] up to a constant. Keeps the configuration for the calls below.
  double evaluate(const Configuration& configuration);

  /// Sum of the magnitudes of the terms of the last evaluate() [J], which bounds its round-off.
  double magnitude() const { return magnitude_; }

  /// Largest turn between neighbours, including base and held apex, of the last evaluate() [rad].
  double largestBend() const;

  /// Gradient at the last evaluated configuration. The body couple on the apex, which has no potential, is part of it.
  void differentiate(Variation& gradient);

  /// Hessian at the last configuration for which differentiate() was called, with the penalty of rigid surroundings
  /// multiplied by `emphasis`.
  void differentiateTwice(double emphasis, ChainHessian& hessian) const;

  /// Newton step from a factor of that Hessian; includes the antisymmetric part that the body couple has.
  void newtonStep(const ChainHessian& hessian, const ChainCholesky& factor, const Variation& gradient, Variation& step);

  /// Strains that go with rotations and changes of element forces.
  Field strainsOf(const ChainResponse& response) const;

  /// Largest gradient over what makes it dimensionless, the sums of the forces at the last configuration (12.4).
  Residual residual(const Variation& gradient) const;

  /// How much of the residual the round-off of positions causes.
  double residualRoundOff() const;

  double bendingScale() const { return stiffest_ / length_; }  ///< B / L, the couple that bends by about 1 rad [N m]

  rod::Vector3 tipCouple() const { return tip_couple_; }

  /// Curvature of bend j at the last configuration [1/m].
  rod::Vector3 curvature(std::size_t j) const { return angle_[j] / voronoi_[j]; }

  /// Forces and couple of the surroundings at the last configuration.
  Reactions reactions() const;

 private:
  double forceScale() const;
  rod::Vector3 bendMoment(std::size_t j) const;

  rod::Quaternion base_frame_;
  rod::BaseSupport support_ = rod::BaseSupport::clamped;
  bool frame_is_held_ = false;
  rod::Quaternion held_frame_;
  rod::Vector3 tip_couple_;
  std::vector<double> rest_length_;
  std::vector<rod::Vector3> stiffness_, compliance_, rest_strain_;
  Field vertex_force_;
  double dead_force_ = 0.0;  ///< sum of magnitudes [N]
  double stiffest_ = 0.0;    ///< largest bending stiffness [N m^2]
  double length_ = 0.0;      ///< of the rod at rest [m]

  // Bends 0 to n - 1, and bend n if the frame of the apex is held.
  std::vector<double> voronoi_;
  std::vector<rod::Vector3> bend_stiffness_, rest_curvature_;

  SurroundingsPotential surroundings_;

  // At the last configuration.
  std::vector<rod::Quaternion> frames_;
  Field strains_, positions_;  ///< positions relative to the base
  std::vector<rod::Vector3> angle_;
  std::vector<rod::Vector3> material_force_;  ///< p, of elements [N]
  double magnitude_ = 0.0;

  ChainResponse response_;
  Field couples_, gaps_;
};

}  // namespace sensory_growth::mechanics
