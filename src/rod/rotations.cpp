#include "sensory_growth/rod/rotations.h"

#include <cmath>

namespace sensory_growth::rod {
namespace {

/// c of J_l^-1 = 1 - hat/2 + c hat^2: (1 - phi/2 cot(phi/2)) / phi^2.
double quadraticCoefficient(double phi2) {
  if (phi2 < 1e-4) return 1.0 / 12.0 + phi2 * (1.0 / 720.0 + phi2 / 30240.0);
  const double half = 0.5 * std::sqrt(phi2);
  return (1.0 - half / std::tan(half)) / phi2;
}

/// c'(phi) / phi of the above.
double quadraticCoefficientSlope(double phi2) {
  if (phi2 < 2.5e-3) return 1.0 / 360.0 + phi2 * (1.0 / 7560.0 + phi2 * (1.0 / 201600.0 + phi2 / 5987520.0));
  const double phi = std::sqrt(phi2);
  const double sine = std::sin(0.5 * phi);
  const double cotangent = std::cos(0.5 * phi) / sine;
  return (-2.0 / phi2 + 0.5 * cotangent / phi + 0.25 / (sine * sine)) / phi2;
}

}  // namespace

Matrix3 hat(const Vector3& a) {
  Matrix3 m;
  m << 0.0, -a.z(), a.y(),  //
      a.z(), 0.0, -a.x(),   //
      -a.y(), a.x(), 0.0;
  return m;
}

Vector3 log(const Quaternion& q) {
  const double sine = q.vec().norm();
  if (sine == 0.0) return Vector3::Zero();
  // q and -q are the same rotation; the one with w >= 0 turns by at most pi.
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  return (2.0 * sign * std::atan2(sine, std::abs(q.w())) / sine) * q.vec();
}

Quaternion halfWay(const Quaternion& a, const Quaternion& b) {
  // q and -q are the same rotation; the sum is half-way on the side where they are close.
  const double sign = a.dot(b) < 0.0 ? -1.0 : 1.0;
  return Quaternion(a.coeffs() + sign * b.coeffs()).normalized();
}

Matrix3 leftJacobian(const Vector3& theta) {
  const double phi2 = theta.squaredNorm();
  const double phi = std::sqrt(phi2);
  const bool small = phi2 < 1e-4;
  const double linear = small ? 0.5 - phi2 / 24.0 + phi2 * phi2 / 720.0 : (1.0 - std::cos(phi)) / phi2;
  const double quadratic =
      small ? 1.0 / 6.0 - phi2 / 120.0 + phi2 * phi2 / 5040.0 : (phi - std::sin(phi)) / (phi2 * phi);
  const Matrix3 h = hat(theta);
  return Matrix3::Identity() + linear * h + quadratic * h * h;
}

Matrix3 leftJacobianInverse(const Vector3& theta) {
  const double phi2 = theta.squaredNorm();
  const double c = quadraticCoefficient(phi2);
  // hat^2 = theta theta^T - phi^2 1.
  Matrix3 j = c * theta * theta.transpose() - 0.5 * hat(theta);
  j.diagonal().array() += 1.0 - c * phi2;
  return j;
}

Matrix3 leftJacobianInverseDerivative(const Vector3& theta, const Vector3& m) {
  const double phi2 = theta.squaredNorm();
  const double c = quadraticCoefficient(phi2);
  const double slope = quadraticCoefficientSlope(phi2);
  const double along = theta.dot(m);
  const Vector3 double_cross = theta * along - m * phi2;  // theta x (theta x m)
  Matrix3 d = 0.5 * hat(m) + c * theta * m.transpose() + (slope * double_cross - 2.0 * c * m) * theta.transpose();
  d.diagonal().array() += c * along;
  return d;
}

}  // namespace sensory_growth::rod
