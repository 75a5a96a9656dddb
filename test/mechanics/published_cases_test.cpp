// Elastic cases V4, V8, V9 of model.md 18 and C9 of the peers, every support of the base and every kind of load.

#include <cmath>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

RelaxationReport relax(rod::Rod& rod, const Loads& loads, const RelaxationSettings& settings = {}) {
  const RelaxationReport report = StaticEquilibrium(settings).relax(rod, loads);
  EXPECT_TRUE(report.ok()) << describe(report);
  return report;
}

rod::Rod horizontal(std::size_t elements, const rod::Section& section, double length = 1.0) {
  return rod::straightRod({Vector3::Zero(), support::alongX()}, length, elements, section);
}

struct Column {
  double tip_angle;  ///< of the apex from the vertical [degrees]
  double load;       ///< over Euler's load of a column that is free at its upper end
  double height, lateral;
  double tolerance;
};

class EulerColumn : public testing::TestWithParam<Column> {};

TEST_P(EulerColumn, BucklesIntoTheElastica) {
  const Column expected = GetParam();
  rod::Rod rod = rod::straightRod({}, 1.0, 100, support::inextensibleSection(1.0, 0.0));
  Loads loads;
  loads.tip_force = -0.25 * M_PI * M_PI * expected.load * Vector3::UnitZ();
  const RelaxationReport report = relax(rod, loads);
  EXPECT_EQ(report.branch_switches, 1);
  const Vector3 tip = rod.vertices.back().position;
  EXPECT_NEAR(tip.z(), expected.height, expected.tolerance);
  EXPECT_NEAR(std::hypot(tip.x(), tip.y()), expected.lateral, expected.tolerance);
}

INSTANTIATE_TEST_SUITE_P(V4, EulerColumn,
                         testing::Values(Column{20, 1.015396866, 0.969730907, 0.219413042, 2e-3},
                                         Column{60, 1.151719620, 0.741019606, 0.593207646, 2e-4},
                                         Column{120, 1.884800869, 0.123159972, 0.803170991, 2e-4}));

/// The 45 degree bend of Bathe and Bolourchi: an arc of radius 100 in the horizontal plane, from +y to +x.
rod::Rod arc(std::size_t elements) {
  rod::Section section;
  // E A = 1e7, alpha G A = 5e6, all stiffnesses of bending and twist 1e7 / 12.
  section.radius = 1.0 / std::sqrt(3.0);
  section.young_modulus = 1e7 / section.area();
  section.shear_modulus = 0.5 * section.young_modulus;
  section.shear_correction = 1.0;
  rod::Matrix3 directors;
  directors << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  rod::Rod rod = rod::straightRod({Vector3::Zero(), rod::Quaternion(directors)}, 25.0 * M_PI, elements, section);
  for (rod::Bend& bend : rod.bends) bend.curvature = bend.rest_curvature = {0.0, 0.01, 0.0};
  rod.rebuild();
  return rod;
}

struct OutOfPlane {
  double load;
  Vector3 tip;
  int iterations;
};

class FortyFiveDegreeBend : public testing::TestWithParam<OutOfPlane> {};

TEST_P(FortyFiveDegreeBend, AgreesWithTheReferenceSolution) {
  const OutOfPlane expected = GetParam();
  rod::Rod rod = arc(64);
  Loads loads;
  loads.tip_force = expected.load * Vector3::UnitZ();
  const RelaxationReport report = relax(rod, loads);
  EXPECT_LE(report.iterations, expected.iterations);
  EXPECT_LT((rod.vertices.back().position - expected.tip).norm(), 1e-4 * rod.restLength());
}

INSTANTIATE_TEST_SUITE_P(V8, FortyFiveDegreeBend,
                         testing::Values(OutOfPlane{300.0, {22.244781, 58.779122, 40.191892}, 5},
                                         OutOfPlane{600.0, {15.684801, 47.150439, 53.474859}, 5}));

TEST(FortyFiveDegreeBend, IsSecondOrder) {
  const auto error = [](std::size_t n) {
    rod::Rod rod = arc(n);
    Loads loads;
    loads.tip_force = 600.0 * Vector3::UnitZ();
    relax(rod, loads);
    return (rod.vertices.back().position - Vector3(15.684801, 47.150439, 53.474859)).norm();
  };
  EXPECT_NEAR(support::order(error(16), error(32)), 2.0, 0.05);
}

TEST(BodyCouple, TwistsTheRod) {  // V9
  rod::Rod rod = horizontal(37, support::section(0.02, 1.0, 0.0), 1.3);
  Loads loads;
  loads.tip_couple = {0.0, 0.0, 0.4};
  relax(rod, loads);
  const double twist_stiffness = rod.elements[0].section.bendStiffness().z();
  const rod::Quaternion turn = rod.base.frame.conjugate() * rod.apex().frame;
  EXPECT_NEAR(rod::log(turn).z(), 0.4 * 1.3 / twist_stiffness, 1e-11);
}

TEST(BodyCouple, RollsTheRodIntoACircle) {  // V9
  rod::Rod rod = horizontal(60, support::section(0.02, 1.0, 0.0));
  Loads loads;
  loads.tip_couple = {0.0, 2.0 * M_PI, 0.0};
  RelaxationSettings strict;
  strict.tolerance = 1e-14;
  relax(rod, loads, strict);
  for (const rod::Bend& bend : rod.bends) {
    EXPECT_LT((bend.curvature / (2.0 * M_PI) - Vector3::UnitY()).norm(), 1e-11);
  }
  EXPECT_LT(rod.vertices.back().position.norm(), 1e-11);
}

/// A couple fixed in the apex, in any direction. With equal bending stiffnesses the moment, which is the same all along
/// the rod, is m = exp(L M3 a d3) M, a = 1 / 2GI - 1 / B, and the tangent turns about it at the rate |m| / B: a helix.
class AnyBodyCouple : public testing::TestWithParam<double> {
 protected:
  static double tipError(double couple, std::size_t elements) {
    const rod::Section section = support::section(0.02, 1.0, 0.0);
    const Vector3 stiffness = section.bendStiffness();
    Loads loads;
    loads.tip_couple = couple * stiffness.x() * Vector3(0.48, 0.64, 0.6);
    rod::Rod rod = rod::straightRod({}, 1.0, elements, section);
    relax(rod, loads);

    const double a = 1.0 / stiffness.z() - 1.0 / stiffness.x();
    const Vector3 moment = rod::exp(loads.tip_couple.z() * a * Vector3::UnitZ()) * loads.tip_couple;
    const Vector3 k = moment / stiffness.x();
    const double w = k.norm();
    const Vector3 tip = Vector3::UnitZ() + (1.0 - std::cos(w)) / (w * w) * k.cross(Vector3::UnitZ()) +
                        (w - std::sin(w)) / (w * w * w) * k.cross(k.cross(Vector3::UnitZ()));
    return (rod.vertices.back().position - tip).norm();
  }
};

TEST_P(AnyBodyCouple, BendsTheRodIntoAHelix) {  // V9
  const double coarse = tipError(GetParam(), 100);
  const double fine = tipError(GetParam(), 200);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(support::order(coarse, fine), 2.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(V9, AnyBodyCouple, testing::Values(0.5, 2.0, 5.0, 10.0));

TEST(TimoshenkoCantilever, AgreesWithTheBeamFormula) {  // C9
  rod::Section section;
  section.radius = 0.25;
  section.young_modulus = 1e6;
  section.shear_modulus = 1e4;
  section.density = 5000.0;
  const double L = 3.0;
  const double F = 15.0;
  rod::Rod rod = horizontal(100, section, L);
  Loads loads;
  loads.tip_force = -F * Vector3::UnitZ();
  relax(rod, loads);
  const double shear = section.shear_correction * section.shear_modulus * section.area();
  const double bending = section.young_modulus * section.secondMoment();
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    const double s = L * static_cast<double>(v) / static_cast<double>(rod.size());
    const double deflection = -F * s / shear - F * L * s * s / (2.0 * bending) + F * s * s * s / (6.0 * bending);
    EXPECT_NEAR(rod.vertices[v].position.z(), deflection, 1e-3 * L);
  }
  // The linear formula leaves out terms of the order of the squared slope.
  loads.tip_force *= 1e-3;
  relax(rod, loads);
  const double linear = -1e-3 * F * (L / shear + L * L * L / (3.0 * bending));
  EXPECT_NEAR(rod.vertices.back().position.z() / linear, 1.0, 1e-4);
}

TEST(ReleasedRod, TakesItsRestShape) {  // C9
  rod::Rod rod = horizontal(100, support::section(0.01, 1.0, 0.0));
  for (rod::Bend& bend : rod.bends) bend.rest_curvature = {0.0, 2.5, 0.0};
  relax(rod, {});
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    const double angle = 2.5 * static_cast<double>(v) / 100.0;
    const Vector3 circle = Vector3(std::sin(angle), 0.0, 1.0 - std::cos(angle)) / 2.5;
    EXPECT_LT((rod.vertices[v].position - circle).norm(), 1e-4);
  }
}

TEST(LineForce, IsWeightWithoutMass) {  // V1, beta = 10
  rod::Rod rod = horizontal(100, support::inextensibleSection(1.0, 0.0));
  Loads loads;
  loads.line_force = -10.0 * Vector3::UnitZ();
  relax(rod, loads);
  EXPECT_NEAR(rod.vertices.back().position.x(), 0.656353761, 2e-4);
  EXPECT_NEAR(rod.vertices.back().position.z(), -0.700199716, 2e-4);
}

TEST(FrozenFirstElement, CostsAnOrder) {  // model.md 1.4
  const auto error = [](std::size_t n) {
    rod::Rod rod = horizontal(n, support::inextensibleSection(1.0, 10.0));
    rod.base_support = rod::BaseSupport::frozen_first_element;
    relax(rod, support::unitGravity());
    EXPECT_EQ(rod.elements[0].frame.coeffs(), rod.base.frame.coeffs());
    return (rod.vertices.back().position - Vector3(0.656353761, 0.0, -0.700199716)).norm();
  };
  EXPECT_NEAR(error(50), 1.95e-2, 0.005e-2);
  EXPECT_NEAR(error(100), 9.69e-3, 0.005e-3);
  EXPECT_NEAR(error(200), 4.84e-3, 0.005e-3);
}

TEST(HingedBase, LetsTheRodHang) {
  for (const double start : {0.3, 1.5, 3.0}) {  // rad from hanging
    rod::Rod rod = rod::straightRod({Vector3::Zero(), rod::exp({0.0, M_PI - start, 0.0})}, 1.0, 40,
                                    support::inextensibleSection(1.0, 5.0));
    rod.base_support = rod::BaseSupport::hinged;
    relax(rod, support::unitGravity());
    EXPECT_LT((rod.vertices.back().position + Vector3::UnitZ()).norm(), 1e-8);
  }
}

TEST(HingedBase, FallsFromTheUprightPosition) {
  rod::Rod rod = rod::straightRod({}, 1.0, 40, support::inextensibleSection(1.0, 1.0));
  rod.base_support = rod::BaseSupport::hinged;
  const RelaxationReport report = relax(rod, support::unitGravity());
  EXPECT_GE(report.branch_switches, 1);
  EXPECT_LT((rod.vertices.back().position + Vector3::UnitZ()).norm(), 1e-8);
}

}  // namespace
}  // namespace sensory_growth::mechanics
