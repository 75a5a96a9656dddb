// Elongation of the rest state: V12a, V12b, V12c (flat), V12d of model.md 18 and the order of the integrator.

#include "sensory_growth/growth/elongation.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

using rod::Vector3;

rod::Rod organ(double length, std::size_t elements = 20) {
  return rod::straightRod({}, length, elements, support::section(0.01, 1.0, 1.0));
}

const GrowthStrain& strainOf(Elongation& elongation, const Profile& profile, const rod::Rod& rod, double dt) {
  std::vector<double> rates;
  elementRates(profile, {}, rod, rates);
  return elongation.strain(profile, {}, rod, rates, dt);
}

/// Of a rod that nothing drives to twist.
void elongateFreely(rod::Rod& rod, const GrowthStrain& strain, TwistTransport twist = TwistTransport::angle) {
  std::vector<Vector3> drive(rod.size(), Vector3::Zero());
  elongate(rod, strain, twist, drive);
}

double grownLength(const Profile& profile, double length, double time, double dt) {
  rod::Rod rod = organ(length);
  Elongation elongation;
  const auto steps = std::lround(time / dt);
  for (long i = 0; i < steps; ++i) elongateFreely(rod, strainOf(elongation, profile, rod, dt));
  return rod.restLength();
}

TEST(UniformGrowth, IsExponential) {
  EXPECT_NEAR(grownLength(UniformProfile{0.7}, 0.3, 2.0, 0.1), 0.3 * std::exp(1.4), 1e-12);  // V12a
}

TEST(LogisticGrowth, ReachesTheReferenceLengths) {
  const Profile profile = LogisticProfile{1.0, 1.0, 15.0};  // V12b
  EXPECT_NEAR(grownLength(profile, 1.0, 5.0, 0.1), 5.996252734, 1e-5);
  EXPECT_NEAR(grownLength(profile, 0.2, 5.0, 0.1), 4.382359091, 1e-5);
  EXPECT_NEAR(grownLength(profile, 5.0, 2.0, 0.1), 7.000000041, 1e-5);
}

TEST(LogisticGrowth, IntegratesAtFourthOrder) {
  // L(2) of dL/dt = V(L), L(0) = 2, integrated on its own to twelve digits.
  const auto error = [](double dt) {
    return grownLength(LogisticProfile{1.0, 1.0, 15.0}, 2.0, 2.0, dt) - 4.000000039429;
  };
  EXPECT_LT(std::abs(error(0.1)), 4e-6);  // model.md 3.3
  EXPECT_LT(std::abs(error(0.05)), 2e-7);
  EXPECT_LT(std::abs(error(0.025)), 2e-8);
  EXPECT_NEAR(support::order(error(0.05), error(0.025)), 4.0, 0.4);
}

TEST(SoftLogisticGrowth, ReachesTheReferenceLengths) {
  const Profile profile = LogisticProfile{1.0, 1.0, 5.0};  // V12c
  EXPECT_NEAR(grownLength(profile, 0.5, 2.0, 0.1), 2.223776491, 1e-5);
  EXPECT_NEAR(grownLength(profile, 2.0, 2.0, 0.1), 4.002417267, 1e-5);
}

TEST(FlatGrowth, ReachesTheReferenceLengths) {
  const Profile profile = ApicalFlatProfile{1.0, 1.0};  // V12c
  EXPECT_NEAR(grownLength(profile, 0.5, 2.0, 0.01), 2.306852819, 1e-3);
  EXPECT_NEAR(grownLength(profile, 2.0, 2.0, 0.01), 4.0, 1e-3);
}

TEST(GaussianGrowth, ReachesTheReferenceLengths) {
  const Profile profile = ApicalGaussianProfile{1.0, 1.0};  // V12c
  EXPECT_NEAR(grownLength(profile, 0.5, 2.0, 0.1), 2.118630353, 1e-6);
  EXPECT_NEAR(grownLength(profile, 2.0, 2.0, 0.1), 3.996846930, 1e-6);
}

TEST(SampledGrowth, OfAFlatZoneThatEndsInARampIsItsOwnIntegral) {
  // Rate 1 within 1 of the apex, falling to 0 at 2. Up to length 1 growth is exponential; then with x = 2 - L,
  // dx/dt = -(3 - x^2) / 2, x = sqrt(3) tanh(c - sqrt(3) t / 2); beyond length 2 the organ grows by 1.5 per unit time.
  const Profile profile = SampledProfile({0.0, 1.0, 2.0}, {1.0, 1.0, 0.0});
  const double r = std::sqrt(3.0);
  const double until_one = std::log(2.0);
  const double until_two = until_one + 2.0 / r * std::atanh(1.0 / r);
  EXPECT_NEAR(grownLength(profile, 0.5, until_one, until_one / 10), 1.0, 1e-9);
  EXPECT_NEAR(grownLength(profile, 0.5, until_two, until_two / 400), 2.0, 1e-5);
  EXPECT_NEAR(grownLength(profile, 2.0, 2.0, 0.1), 5.0, 1e-5);
}

TEST(Growth, FactorsMultiplyTheRateInEveryStage) {
  // Uniform growth by exp(factor rate dt) in each element, for any step.
  rod::Rod rod = organ(1.0, 4);
  const GrowthFactors factors = {0.0, 0.5, 1.0, 2.0};
  Elongation elongation;
  std::vector<double> rates;
  elementRates(UniformProfile{1.0}, factors, rod, rates);
  std::vector<rod::Vector3> drive(4, rod::Vector3::Zero());
  elongate(rod, elongation.strain(UniformProfile{1.0}, factors, rod, rates, 0.7), TwistTransport::angle, drive);
  for (std::size_t e = 0; e < 4; ++e) {
    EXPECT_NEAR(rod.elements[e].rest_length, 0.25 * std::exp(0.7 * factors[e]), 1e-14) << e;
  }
}

TEST(Growth, CarriesBendingCurvatureAndTwistAngle) {
  std::mt19937 generator(3);
  rod::Rod rod = support::randomRod(generator, 10);
  const rod::Rod before = rod;
  Elongation elongation;
  elongateFreely(rod, strainOf(elongation, UniformProfile{1.0}, rod, 0.8));
  for (std::size_t j = 0; j < rod.size(); ++j) {
    EXPECT_EQ(rod.bends[j].rest_curvature.x(), before.bends[j].rest_curvature.x());
    EXPECT_EQ(rod.bends[j].rest_curvature.y(), before.bends[j].rest_curvature.y());
    EXPECT_NEAR(rod.bends[j].rest_curvature.z() * rod.voronoiLength(j),
                before.bends[j].rest_curvature.z() * before.voronoiLength(j), 1e-14);
    EXPECT_NEAR((rod.bends[j].curvature - rod.bends[j].rest_curvature).z(),
                (before.bends[j].curvature - before.bends[j].rest_curvature).z(), 1e-14);
  }
}

TEST(Growth, DriftsPassively) {
  rod::Rod rod = organ(1.0, 50);  // V12d: the turning angle grows with the length at constant curvature
  for (rod::Bend& b : rod.bends) b.rest_curvature = b.curvature = {0.0, 0.5, 0.0};
  Elongation elongation;
  for (int i = 0; i < 10; ++i) elongateFreely(rod, strainOf(elongation, UniformProfile{1.0}, rod, 0.1));
  rod.rebuild();
  const rod::Vector3 tangent = rod.apex().frame * rod::Vector3::UnitZ();
  EXPECT_NEAR(std::atan2(tangent.x(), tangent.z()), 1.359140914, 1e-9);
  EXPECT_NEAR(std::atan2(tangent.x(), tangent.z()), 0.5 * std::exp(1.0), 1e-12);
}

TEST(Growth, KeepsTheTwistOfTissueWithHelicalFibres) {
  rod::Rod rod = organ(1.0);
  for (rod::Bend& bend : rod.bends) bend.curvature = bend.rest_curvature = {0.5, -0.2, 0.3};
  Elongation elongation;
  elongateFreely(rod, strainOf(elongation, UniformProfile{1.0}, rod, 0.8), TwistTransport::rate);
  for (const rod::Bend& bend : rod.bends) EXPECT_EQ(bend.rest_curvature, Vector3(0.5, -0.2, 0.3));
}

TEST(Growth, CarriesTheDriveOfTwistWithItsAngle) {
  rod::Rod rod = organ(1.0);
  Elongation elongation;
  std::vector<Vector3> drive(rod.size(), Vector3(1.0, 2.0, 3.0));
  elongate(rod, strainOf(elongation, UniformProfile{1.0}, rod, 0.8), TwistTransport::angle, drive);
  for (const Vector3& f : drive) EXPECT_LT((f - Vector3(1.0, 2.0, 3.0 * std::exp(-0.8))).norm(), 1e-14);
}

TEST(Growth, LengthsStayPositiveForAnyStep) {
  Elongation elongation;
  for (const double dt : {1e-6, 1.0, 10.0}) {
    rod::Rod rod = organ(0.3);
    elongateFreely(rod, strainOf(elongation, LogisticProfile{1.0, 1.0, 15.0}, rod, dt));
    for (const rod::Element& e : rod.elements) EXPECT_GT(e.rest_length, 0.0);
  }
}

TEST(Growth, StrainOfABendIsThatOfItsVoronoiCell) {
  std::mt19937 generator(5);
  const rod::Rod before = support::randomRod(generator, 10);
  const Profile profile = LogisticProfile{1.0, 0.4, 5.0};
  Elongation elongation;
  rod::Rod after = before;
  const GrowthStrain free = strainOf(elongation, profile, before, 0.3);
  elongateFreely(after, free);
  for (std::size_t j = 0; j < before.size(); ++j) {
    EXPECT_NEAR(free.bends[j], std::log(after.voronoiLength(j) / before.voronoiLength(j)), 1e-14);
  }
}

TEST(Growth, StrainAtFixedLengthIsTheLengthWeightedMeanOfTheRates) {
  std::mt19937 generator(6);
  const rod::Rod rod = support::randomRod(generator, 10);
  const Profile profile = ApicalFlatProfile{2.0, 0.37};
  Elongation elongation;
  std::vector<double> rates;
  elementRates(profile, {}, rod, rates);
  const GrowthStrain held = elongation.strainAtFixedLength(rod, rates, 0.3);
  const double L = rod.restLength();
  double s = 0.0;
  double length_below = 0.0;
  double growth_below = 0.0;  // growth strain times length of the element below
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const double length = rod.elements[e].rest_length;
    const double in_zone = std::clamp(s + length - (L - 0.37), 0.0, length);
    const double growth = 0.3 * 2.0 * in_zone;
    EXPECT_NEAR(held.elements[e], growth / length, 1e-13);
    EXPECT_NEAR(held.bends[e], (growth_below + growth) / (length_below + length), 1e-13);
    s += length;
    length_below = length;
    growth_below = growth;
  }
}

TEST(Growth, TheWholeOrganElongatesAtTheVelocityOfItsApex) {
  std::mt19937 generator(7);
  const rod::Rod rod = support::randomRod(generator, 10);
  const Profile profile = LogisticProfile{0.9, 0.3, 15.0};
  std::vector<double> rates;
  elementRates(profile, {}, rod, rates);
  double speed = 0.0;
  for (std::size_t e = 0; e < rod.size(); ++e) speed += rates[e] * rod.elements[e].rest_length;
  EXPECT_NEAR(speed, velocity(profile, rod.restLength(), rod.restLength()), 1e-13);
}

}  // namespace
}  // namespace sensory_growth::growth
