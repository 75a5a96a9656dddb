#include "sensory_growth/rod/rod.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/rods.h"

namespace sensory_growth::rod {
namespace {

using support::order;

Rod uniformlyCurved(std::size_t elements, double length, const Vector3& curvature) {
  Rod rod = straightRod({}, length, elements, support::section(0.01, 1.0, 1.0));
  for (Bend& bend : rod.bends) bend.curvature = bend.rest_curvature = curvature;
  rod.rebuild();
  return rod;
}

/// Error of the tip of case V10 of model.md 18: rest helix kappa = (0, 2, 3), L = 2.
double helixError(std::size_t elements) {
  const Vector3 expected(0.061615045, 0.820622981, 1.452918015);
  return (uniformlyCurved(elements, 2.0, {0.0, 2.0, 3.0}).vertices.back().position - expected).norm();
}

TEST(Rod, HelixReachesItsClosedForm) {
  EXPECT_LT(helixError(100), 5e-5);
  EXPECT_NEAR(order(helixError(50), helixError(100)), 2.0, 0.02);
}

TEST(Rod, HelixHasItsRadiusAndPitch) {
  const Vector3 k(0.0, 2.0, 3.0);
  const double w = k.norm();
  const std::size_t turn = 100;
  const Rod rod = uniformlyCurved(turn, 2.0 * M_PI / w, k);  // one turn about the axis, which is k in the base frame
  const Vector3 advance = rod.vertices.back().position - rod.vertices.front().position;
  EXPECT_NEAR(advance.norm(), 1.449966, 5e-5);
  const Vector3 across = rod.vertices[turn / 2].position - 0.5 * advance;
  EXPECT_NEAR(0.5 * across.norm(), 0.153846, 5e-5);
}

TEST(Rod, TangentTurnsTowardsMinusD2ForPositiveK1AndTowardsD1ForPositiveK2) {
  EXPECT_LT(uniformlyCurved(20, 1.0, {1.0, 0.0, 0.0}).vertices.back().position.y(), -0.4);
  EXPECT_GT(uniformlyCurved(20, 1.0, {0.0, 1.0, 0.0}).vertices.back().position.x(), 0.4);
}

TEST(Rod, ApexFrameOfAnArcIsExact) {
  const Pose apex = uniformlyCurved(7, 2.0, {0.0, 0.4, 0.0}).apex();
  EXPECT_LT((apex.frame * Vector3::UnitZ() - Vector3(std::sin(0.8), 0.0, std::cos(0.8))).norm(), 1e-14);
}

TEST(Rod, AtInterpolatesPositionsAndFrames) {
  const Rod rod = uniformlyCurved(10, 2.0, {0.0, 0.4, 0.0});
  for (const double s : {0.0, 0.05, 0.1, 0.37, 1.0, 1.99, 2.0}) {
    EXPECT_LT((rod.at(s).frame * Vector3::UnitZ() - Vector3(std::sin(0.4 * s), 0.0, std::cos(0.4 * s))).norm(), 1e-13)
        << "s = " << s;
  }
  EXPECT_EQ(rod.at(-1.0).position, rod.base.position);
  EXPECT_LT((rod.at(5.0).position - rod.vertices.back().position).norm(), 1e-15);
  EXPECT_LT((rod.at(0.2).position - rod.vertices[1].position).norm(), 1e-15);
}

TEST(Rod, VertexMassesAddUpToTheMassOfTheTissue) {
  std::mt19937 generator(3);
  const Rod rod = support::randomRod(generator, 9);
  double by_vertex = 0.0;
  double by_volume = 0.0;
  for (std::size_t v = 0; v <= rod.size(); ++v) by_vertex += rod.vertexMass(v);
  for (const Element& e : rod.elements) {
    by_volume += e.section.density * M_PI * e.section.radius * e.section.radius * e.rest_length;
  }
  EXPECT_NEAR(by_vertex, by_volume, 1e-14);
}

TEST(Rod, RebuildFollowsTheBase) {
  std::mt19937 generator(5);
  Rod rod = support::randomRod(generator, 12);
  const Pose before = rod.apex();
  const Quaternion turn = exp({0.3, -0.8, 1.1});
  rod.base = {turn * rod.base.position + Vector3(1.0, 2.0, 3.0), turn * rod.base.frame};
  rod.rebuild();
  EXPECT_LT((rod.apex().position - (turn * before.position + Vector3(1.0, 2.0, 3.0))).norm(), 1e-13);
  EXPECT_LT(log(rod.apex().frame.conjugate() * turn * before.frame).norm(), 1e-13);
}

TEST(Rod, RefusesWhatIsNotARod) {
  const Section good = support::section(0.01, 1.0, 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(straightRod({}, 0.0, 10, good), std::invalid_argument);
  EXPECT_THROW(straightRod({}, nan, 10, good), std::invalid_argument);
  EXPECT_THROW(straightRod({}, 1.0, 0, good), std::invalid_argument);
  Section thin = good;
  thin.radius = -1.0;
  EXPECT_THROW(straightRod({}, 1.0, 10, thin), std::invalid_argument);
}

TEST(Section, CircularSectionOfOneMillimetre) {
  Section s;
  s.radius = 1e-3;
  s.young_modulus = 1e7;
  s.shear_modulus = 1e7 / 3.0;
  s.density = 1000.0;
  EXPECT_NEAR(s.area(), 3.14159265e-6, 1e-14);
  EXPECT_NEAR(s.secondMoment(), 7.85398163e-13, 1e-21);
  EXPECT_NEAR(s.bendStiffness().x(), 7.85398163e-6, 1e-14);
  EXPECT_NEAR(s.bendStiffness().z(), 5.23598776e-6, 1e-14);
  EXPECT_NEAR(1.0 / s.stretchCompliance().z(), 31.4159265, 1e-7);
  EXPECT_NEAR(1.0 / s.stretchCompliance().x(), 10.0979757, 1e-6);
  s.inextensible = true;
  EXPECT_EQ(s.stretchCompliance(), Vector3::Zero());
}

}  // namespace
}  // namespace sensory_growth::rod
