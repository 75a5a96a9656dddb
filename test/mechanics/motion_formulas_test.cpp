// The formulas of a moving rod against those of the statics and the exponential.

#include "sensory_growth/mechanics/dynamics.h"

#include <random>

#include <gtest/gtest.h>

#include "kernels/motion_formulas.h"
#include "support/motion.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

double first(const kernels::Lanes& lanes) {
  alignas(64) double lane[kernels::Lanes::size];
  kernels::store(lanes, lane);
  return lane[0];
}
Vector3 toVector(const kernels::Vector& a) { return {first(a[0]), first(a[1]), first(a[2])}; }
kernels::Vector toLanes(const Vector3& a) { return {kernels::Lanes(a[0]), kernels::Lanes(a[1]), kernels::Lanes(a[2])}; }
kernels::Quaternion toLanes(const rod::Quaternion& q) { return {kernels::Lanes(q.w()), toLanes(Vector3(q.vec()))}; }

TEST(MotionFormulas, CouplesOfABendAreThoseOfTheStatics) {
  std::mt19937 generator(1);
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3, 1.0, 1.57, 2.2}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 theta = angle * support::randomVector(generator, 1.0).normalized();
      const Vector3 rest = support::randomVector(generator, 1.0);
      const Vector3 stiffness(2.0, 3.0, 5.0);
      const rod::Quaternion below = rod::exp(support::randomVector(generator, 1.5));
      const kernels::Quaternion turn = kernels::between(toLanes(below), toLanes(below * rod::exp(theta)));
      const auto couples = kernels::bendCouples(turn, kernels::Lanes(4.0), toLanes(rest), toLanes(stiffness));
      const Vector3 m = stiffness.cwiseProduct(4.0 * theta - rest);
      EXPECT_LT((toVector(couples.upper) - rod::leftJacobianInverse(theta) * m).norm(), 1e-14 * (10.0 + m.norm()));
      EXPECT_LT((toVector(couples.lower) - rod::leftJacobianInverse(-theta) * m).norm(), 1e-14 * (10.0 + m.norm()));
    }
  }
}

TEST(MotionFormulas, TurnFramesByTheExponential) {
  std::mt19937 generator(2);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.05, 0.2}) {
    const Vector3 theta = angle * support::randomVector(generator, 1.0).normalized();
    const rod::Quaternion before = rod::exp(support::randomVector(generator, 1.5));
    const kernels::Quaternion turned = kernels::turnedLittle(toLanes(before), toLanes(theta));
    rod::Quaternion after;
    after.w() = first(turned.w);
    after.vec() = toVector(turned.v);
    EXPECT_LT((after.coeffs() - (before * rod::exp(theta)).coeffs()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace sensory_growth::mechanics
