#pragma once

/// Energy of a clamped rod under dead loads as a function of its frames alone, with gradient and Hessian
/// (model.md 12.2, 12.3).
///
/// For given frames the energy is quadratic in the strains, whose optimum is sigma = sigma0 + S^-1 p with p the element
/// force in the material frame. Perturbations are R_e -> R_e exp(w_e).

#include <cstddef>
#include <vector>

#include "sensory_growth/mechanics/block_tridiagonal.h"
#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

class ReducedEnergy {
 public:
  using Frames = std::vector<rod::Quaternion>;

  /// Takes what stays constant during one relaxation. Reuses the memory of earlier calls.
  void assign(const rod::Rod& rod, const Loads& loads);

  std::size_t size() const { return rest_length_.size(); }

  /// Energy [J] at `frames`, up to a constant. Keeps the configuration for the calls below.
  double evaluate(const Frames& frames);

  /// Sum of the magnitudes of the terms of the last evaluate() [J], which bounds its round-off.
  double magnitude() const { return magnitude_; }

  /// Largest turn between neighbouring elements of the last evaluate() [rad].
  double largestBend() const;

  /// Gradient [N m] and Hessian [N m] with respect to w at the last evaluated frames.
  void differentiate(RotationField& gradient, BlockTridiagonal& hessian) const;

  /// Optimal strain of element e at the last evaluated frames.
  const rod::Vector3& strain(std::size_t e) const { return strain_[e]; }

  /// Curvature of bend j at the last evaluated frames [1/m].
  rod::Vector3 curvature(std::size_t j) const { return angle_[j] / voronoi_[j]; }

  /// Couple that makes gradients dimensionless: max(W L, B / L) with W the sum of the forces [N m] (model.md 12.4).
  double coupleScale() const { return couple_scale_; }

  /// B / L, the couple that bends the rod by about one radian [N m].
  double bendingScale() const { return bending_scale_; }

 private:
  rod::Quaternion base_;
  std::vector<double> rest_length_, voronoi_;
  std::vector<rod::Vector3> bend_stiffness_, rest_curvature_, compliance_, rest_strain_, force_;
  double couple_scale_ = 0.0;
  double bending_scale_ = 0.0;

  // At the last evaluated frames.
  std::vector<rod::Vector3> angle_, moment_;           ///< per bend [rad], [N m]
  std::vector<rod::Vector3> material_force_, strain_;  ///< per element [N], [-]
  double magnitude_ = 0.0;
};

}  // namespace sensory_growth::mechanics
