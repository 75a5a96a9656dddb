#pragma once

/// The quadratic model of a rod whose vertices feel stiffness, and its Cholesky factor (model.md 12.3, "with V").
///
/// Eliminating element by element from the apex to the base leaves a stiffness that couples one vertex displacement and
/// one rotation, so factor and solve cost O(n) and every pivot is symmetric. The factor exists exactly if the Hessian
/// is positive definite, which a banded LU of the same system cannot tell. Only compliances enter, so that an
/// inextensible element is one whose compliance is zero.

#include <vector>

#include <Eigen/Cholesky>

#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::mechanics {

/// One column per element, or per vertex where it says so.
using Field = Eigen::Matrix3Xd;

/// Element e and vertex e + 1. With w rotations, dr displacements of vertices and df changes of element forces:
/// dr_(e+1) = dr_e + lever w_e + flexibility flexibility^T df_e.
struct ChainLink {
  rod::Matrix3 rotation;     ///< Hessian of w_e with strains eliminated [N m]
  rod::Matrix3 coupling;     ///< Hessian of w_(e-1) (rows) and w_e [N m]; unused in the first link
  rod::Matrix3 lever;        ///< [m]
  rod::Matrix3 flexibility;  ///< square root of the compliance of the element [(m/N)^(1/2)]
  rod::Matrix3 stiffness;    ///< of the potential at vertex e + 1 [N/m]
};

struct ChainHessian {
  std::vector<ChainLink> links;
  bool first_fixed = false;  ///< w_0 = 0

  double largestDiagonal() const;  ///< of the rotation blocks [N m]
  bool isFinite() const;
};

/// What solving for a load gives.
struct ChainResponse {
  Field rotations;  ///< w
  Field forces;     ///< df, of elements
};

class ChainCholesky {
 public:
  /// False if the Hessian plus shift * 1 on all rotations is not positive definite; the factor is then unusable.
  bool factor(const ChainHessian& hessian, double shift);

  /// Response to couples [N m] on the elements and to gaps [m] by which elements fall short of their vertices:
  /// dr_(e+1) = dr_e + ... - gap_e. Needs a successful factor() of the same Hessian.
  void solve(const ChainHessian& hessian, const Field& couples, const Field& gaps, ChainResponse& response) const;

 private:
  /// Stiffness of everything beyond, as felt by dr (block stiffness), by dr and w (block mixed) and by w.
  struct Stage {
    rod::Matrix3 stiffness, mixed;            ///< at vertex e + 1
    rod::Matrix3 yielding;                    ///< (compliance^-1 + stiffness)^-1
    rod::Matrix3 near_stiffness, near_mixed;  ///< seen through the compliance of the element
    rod::Matrix3 base_mixed;                  ///< at vertex e
    Eigen::LLT<rod::Matrix3> pivot;           ///< of w_e
  };
  std::vector<Stage> stages_;
};

struct ChainEigenpair {
  double value = 0.0;      ///< [N m]
  ChainResponse response;  ///< rotations of Euclidean norm 1, with the element forces that go with them
};

/// Lowest eigenpair of the Hessian of the rotations (positions and strains eliminated) by shifted inverse iteration
/// from `start`, which must not be orthogonal to it. `tolerance` is relative to the value.
ChainEigenpair lowestEigenpair(const ChainHessian& hessian, const Field& start, double tolerance);

}  // namespace sensory_growth::mechanics
