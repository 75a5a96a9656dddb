#include "sensory_growth/mechanics/block_tridiagonal.h"

#include <algorithm>
#include <cmath>

namespace sensory_growth::mechanics {

double BlockTridiagonal::largestDiagonal() const {
  double largest = 0.0;
  for (const rod::Matrix3& block : diagonal) largest = std::max(largest, block.diagonal().cwiseAbs().maxCoeff());
  return largest;
}

void BlockTridiagonal::multiply(const RotationField& x, RotationField& y) const {
  y.resize(size());
  for (std::size_t e = 0; e < size(); ++e) {
    y[e] = diagonal[e] * x[e];
    if (e > 0) y[e] += upper[e - 1].transpose() * x[e - 1];
    if (e + 1 < size()) y[e] += upper[e] * x[e + 1];
  }
}

bool BlockCholesky::factor(const BlockTridiagonal& matrix, double shift) {
  const std::size_t n = matrix.size();
  pivots_.resize(n);
  lower_.resize(n);
  for (std::size_t e = 0; e < n; ++e) {
    rod::Matrix3 pivot = matrix.diagonal[e];
    pivot.diagonal().array() += shift;
    if (e > 0) {
      lower_[e - 1] = pivots_[e - 1].solve(matrix.upper[e - 1]).transpose();
      pivot -= lower_[e - 1] * matrix.upper[e - 1];
    }
    pivots_[e].compute(pivot);
    if (pivots_[e].info() != Eigen::Success) return false;
  }
  return true;
}

void BlockCholesky::solve(RotationField& b) const {
  const std::size_t n = b.size();
  for (std::size_t e = 1; e < n; ++e) b[e] -= lower_[e - 1] * b[e - 1];
  for (std::size_t e = n; e-- > 0;) {
    b[e] = pivots_[e].solve(b[e]).eval();
    if (e + 1 < n) b[e] -= lower_[e].transpose() * b[e + 1];
  }
}

double dot(const RotationField& a, const RotationField& b) {
  double sum = 0.0;
  for (std::size_t e = 0; e < a.size(); ++e) sum += a[e].dot(b[e]);
  return sum;
}

double largestRotation(const RotationField& field) {
  double largest = 0.0;
  for (const rod::Vector3& w : field) {
    const double angle = w.norm();
    if (std::isnan(angle)) return angle;
    largest = std::max(largest, angle);
  }
  return largest;
}

namespace {

void normalise(RotationField& x) {
  const double scale = 1.0 / std::sqrt(dot(x, x));
  for (rod::Vector3& w : x) w *= scale;
}

}  // namespace

Eigenpair lowestEigenpair(const BlockTridiagonal& matrix, const RotationField& start, double tolerance) {
  constexpr int kMaxIterations = 200;
  constexpr int kIterationsPerShift = 8;

  BlockCholesky factor;
  const double scale = matrix.largestDiagonal();
  double shift = 0.0;
  while (!factor.factor(matrix, shift)) shift = shift > 0.0 ? 4.0 * shift : 1e-12 * scale;

  Eigenpair pair{0.0, start};
  normalise(pair.vector);
  RotationField product;
  double change = 0.0;
  for (int i = 1; i <= kMaxIterations; ++i) {
    factor.solve(pair.vector);
    normalise(pair.vector);
    matrix.multiply(pair.vector, product);
    const double value = dot(pair.vector, product);
    change = std::abs(value - pair.value);
    pair.value = value;
    if (i > 1 && change <= tolerance * std::abs(value) + 1e-15 * scale) break;
    if (i % kIterationsPerShift == 0) {
      // The Rayleigh quotient is an upper bound: a shift slightly beyond it sharpens the ratio to the next eigenvalue.
      const double closer = -value + 0.3 * std::abs(value) + change;
      if (closer < shift || shift == 0.0) {
        if (factor.factor(matrix, closer)) {
          shift = closer;
        } else {
          factor.factor(matrix, shift);
        }
      }
    }
  }
  return pair;
}

}  // namespace sensory_growth::mechanics
