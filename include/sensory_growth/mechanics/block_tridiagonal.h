#pragma once

/// Symmetric block-tridiagonal matrices with 3x3 blocks: the Hessian of a rod under dead loads (model.md 12.3).

#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>

#include "sensory_growth/rod/rotations.h"

namespace sensory_growth::mechanics {

/// One rotation vector per element.
using RotationField = std::vector<rod::Vector3>;

struct BlockTridiagonal {
  std::vector<rod::Matrix3> diagonal;  ///< n symmetric blocks
  std::vector<rod::Matrix3> upper;     ///< n - 1 blocks: row e, column e + 1

  std::size_t size() const { return diagonal.size(); }
  double largestDiagonal() const;  ///< largest |entry| on the diagonal

  /// y = A x; both of size n.
  void multiply(const RotationField& x, RotationField& y) const;
};

/// Cholesky factor of A + shift * 1. Factor and solve cost O(n).
class BlockCholesky {
 public:
  /// False if A + shift * 1 is not positive definite; the factor is then unusable.
  bool factor(const BlockTridiagonal& matrix, double shift);

  /// Solves (A + shift * 1) x = b in place. Needs a successful factor().
  void solve(RotationField& b) const;

 private:
  std::vector<Eigen::LLT<rod::Matrix3>> pivots_;
  std::vector<rod::Matrix3> lower_;  ///< row e + 1, column e of the unit lower factor
};

double dot(const RotationField& a, const RotationField& b);

/// Largest rotation angle in the field; NaN if any is.
double largestRotation(const RotationField& field);

struct Eigenpair {
  double value = 0.0;
  RotationField vector;  ///< Euclidean norm 1
};

/// Lowest eigenpair by shifted inverse iteration from `start`, which must not be orthogonal to it. In a degenerate
/// eigenspace the result is the projection of `start`, so it is reproducible. `tolerance` is relative to the value.
Eigenpair lowestEigenpair(const BlockTridiagonal& matrix, const RotationField& start, double tolerance);

}  // namespace sensory_growth::mechanics
