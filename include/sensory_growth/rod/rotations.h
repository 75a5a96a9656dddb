#pragma once

/// Rotations of SO(3) and their rotation vectors (model.md 15).
///
/// A rotation vector theta [rad] turns by |theta| about theta/|theta|. Every map is smooth through zero: closed forms
/// are replaced by their series where they lose digits.

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sensory_growth::rod {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;

/// The matrix of the cross product: hat(a) * b == a x b.
Matrix3 hat(const Vector3& a);

/// Unit quaternion of the rotation vector theta [rad].
inline Quaternion exp(const Vector3& theta) {
  const double x = 0.25 * theta.squaredNorm();  // square of half the angle
  double cosine, sinc;
  if (x < 0.025) {
    // The bends of a resolved rod: the series are exact to the last digit here, and faster than the closed forms.
    cosine = 1.0 - x * (1.0 / 2.0) *
                       (1.0 - x * (1.0 / 12.0) *
                                  (1.0 - x * (1.0 / 30.0) * (1.0 - x * (1.0 / 56.0) * (1.0 - x * (1.0 / 90.0)))));
    sinc = 1.0 - x * (1.0 / 6.0) *
                     (1.0 - x * (1.0 / 20.0) *
                                (1.0 - x * (1.0 / 42.0) * (1.0 - x * (1.0 / 72.0) * (1.0 - x * (1.0 / 110.0)))));
  } else {
    const double half = std::sqrt(x);
    cosine = std::cos(half);
    sinc = std::sin(half) / half;
  }
  return {cosine, 0.5 * sinc * theta.x(), 0.5 * sinc * theta.y(), 0.5 * sinc * theta.z()};
}

/// Rotation vector [rad] of a unit quaternion, |log q| <= pi; exact to 1e-15 from 1e-9 to 3.1 rad.
Vector3 log(const Quaternion& q);

/// Half-way between two unit quaternions along the shortest turn.
Quaternion halfWay(const Quaternion& a, const Quaternion& b);

/// J_l(theta): exp(theta + d) = exp(J_l(theta) d) exp(theta) to first order in d.
Matrix3 leftJacobian(const Vector3& theta);

/// Inverse of leftJacobian. Its transpose is leftJacobianInverse(-theta).
Matrix3 leftJacobianInverse(const Vector3& theta);

/// Derivative of leftJacobianInverse(theta) * m with respect to theta at fixed m; column k belongs to theta_k.
Matrix3 leftJacobianInverseDerivative(const Vector3& theta, const Vector3& m);

}  // namespace sensory_growth::rod
