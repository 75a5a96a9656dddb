#include "sensory_growth/rod/rotations.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/rods.h"

namespace sensory_growth::rod {
namespace {

using support::randomVector;

Vector3 randomRotation(std::mt19937& generator, double angle) {
  return angle * randomVector(generator, 1.0).normalized();
}

class RotationsAtAngle : public testing::TestWithParam<double> {
 protected:
  std::mt19937 generator_{7};
};

TEST_P(RotationsAtAngle, LogInvertsExp) {
  for (int i = 0; i < 50; ++i) {
    const Vector3 theta = randomRotation(generator_, GetParam());
    EXPECT_LT((log(exp(theta)) - theta).norm(), 1e-14 * std::max(1.0, GetParam()));
    const Quaternion q = exp(theta);
    EXPECT_LT((log(Quaternion(-q.w(), -q.x(), -q.y(), -q.z())) - theta).norm(), 1e-14 * std::max(1.0, GetParam()));
  }
}

TEST_P(RotationsAtAngle, ExpAgreesWithRodrigues) {
  for (int i = 0; i < 50; ++i) {
    const Vector3 theta = randomRotation(generator_, GetParam());
    const Matrix3 expected = Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix();
    EXPECT_LT((exp(theta).toRotationMatrix() - expected).norm(), 2e-15);
  }
}

TEST_P(RotationsAtAngle, LeftJacobianInverseInverts) {
  for (int i = 0; i < 50; ++i) {
    const Vector3 theta = randomRotation(generator_, GetParam());
    EXPECT_LT((leftJacobian(theta) * leftJacobianInverse(theta) - Matrix3::Identity()).norm(), 5e-14);
    EXPECT_LT((leftJacobianInverse(-theta) - leftJacobianInverse(theta).transpose()).norm(), 1e-15);
  }
}

TEST_P(RotationsAtAngle, LeftJacobianIsTheDerivativeOfExp) {
  const double h = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const Vector3 theta = randomRotation(generator_, GetParam());
    const Vector3 d = randomRotation(generator_, h);
    const Vector3 turned = log(exp(theta + d) * exp(theta - d).conjugate());
    EXPECT_LT((turned - 2.0 * leftJacobian(theta) * d).norm(), 1e-9 * h + 1e-15);
  }
}

TEST_P(RotationsAtAngle, DerivativeOfLeftJacobianInverseAgreesWithDifferences) {
  const double h = 1e-5;
  for (int i = 0; i < 20; ++i) {
    const Vector3 theta = randomRotation(generator_, GetParam());
    const Vector3 m = randomVector(generator_, 1.0);
    const Matrix3 derivative = leftJacobianInverseDerivative(theta, m);
    for (int k = 0; k < 3; ++k) {
      const Vector3 d = h * Vector3::Unit(k);
      const Vector3 difference = (leftJacobianInverse(theta + d) * m - leftJacobianInverse(theta - d) * m) / (2.0 * h);
      EXPECT_LT((derivative.col(k) - difference).norm(), 1e-9) << "column " << k;
    }
  }
}

// Angles on both sides of every switch between series and closed form.
INSTANTIATE_TEST_SUITE_P(Angles, RotationsAtAngle,
                         testing::Values(1e-9, 1e-5, 0.0099, 0.0101, 0.0499, 0.0501, 0.3, 1.5, 3.1));

TEST(Rotations, ZeroIsTheIdentity) {
  EXPECT_EQ(exp(Vector3::Zero()).coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(log(Quaternion::Identity()), Vector3::Zero());
  EXPECT_EQ(leftJacobianInverse(Vector3::Zero()), Matrix3::Identity());
}

TEST(Rotations, HatIsTheCrossProduct) {
  EXPECT_EQ(hat({1.0, 2.0, 3.0}) * Vector3(-4.0, 5.0, 0.5), Vector3(-14.0, -12.5, 13.0));
}

}  // namespace
}  // namespace sensory_growth::rod
