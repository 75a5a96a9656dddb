// Coupling of growth to stress: Lockhart's factor (model.md 8).

#include "sensory_growth/growth/stress_coupling.h"

#include <random>

#include <gtest/gtest.h>

#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

/// Elements under axial stresses of -2, -0.5, 0, 0.5 and 3.
rod::Rod stressedRod() {
  rod::Rod rod = rod::straightRod({}, 1.0, 5, support::section(0.1, 1.0, 1.0));
  const double stresses[] = {-2.0, -0.5, 0.0, 0.5, 3.0};
  for (std::size_t e = 0; e < 5; ++e) {
    rod.elements[e].rest_strain = {0.01, 0.02, 0.03};  // what has been laid down free of stress
    rod.elements[e].strain = {0.3, -0.2, 0.03 + stresses[e] / rod.elements[e].section.young_modulus};
  }
  return rod;
}

GrowthFactors factorsOf(const StressCoupling& coupling, const rod::Rod& rod) {
  GrowthFactors factors;
  stressFactors(coupling, rod, factors);
  return factors;
}

void expectFactors(const StressCoupling& coupling, const std::vector<double>& expected) {
  const GrowthFactors factors = factorsOf(coupling, stressedRod());
  ASSERT_EQ(factors.size(), expected.size());
  for (std::size_t e = 0; e < factors.size(); ++e) EXPECT_NEAR(factors[e], expected[e], 1e-12) << e;
}

TEST(StressCoupling, IsLockhartsLaw) { expectFactors({1.0}, {0.0, 0.5, 1.0, 1.5, 4.0}); }

TEST(StressCoupling, HasAnUpperBound) { expectFactors({2.0, 1.2}, {0.0, 0.75, 1.0, 1.2, 1.2}); }

TEST(StressCoupling, HasTheSignOfTheDraftAsASwitch) { expectFactors({1.0, 10.0, -1.0}, {3.0, 1.5, 1.0, 0.5, 0.0}); }

TEST(StressCoupling, LeavesGrowthAloneWithoutALimit) { expectFactors({}, {1.0, 1.0, 1.0, 1.0, 1.0}); }

TEST(StressCoupling, NeverMakesGrowthNegative) {
  std::mt19937 generator(11);
  Elongation elongation;
  std::vector<double> rates;
  for (int i = 0; i < 200; ++i) {
    rod::Rod rod = support::randomRod(generator, 12);
    const double margin = std::pow(10.0, std::uniform_real_distribution<double>(-3.0, 8.0)(generator));
    const GrowthFactors factors = factorsOf({margin, 5.0, i % 2 == 0 ? 1.0 : -1.0}, rod);
    const Profile profiles[] = {LogisticProfile{1.0, 0.3, 15.0}, ApicalGaussianProfile{1.0, 0.2},
                                ApicalFlatProfile{1.0, 0.4}, SampledProfile({0.0, 0.3, 0.6}, {0.2, 1.0, 0.0})};
    const Profile& profile = profiles[i % 4];
    elementRates(profile, factors, rod, rates);
    for (const double rate : rates) EXPECT_GE(rate, 0.0);
    const double dt = std::pow(10.0, std::uniform_real_distribution<double>(-4.0, 2.0)(generator));
    const GrowthStrain& strain = elongation.strain(profile, factors, rod, rates, dt);
    for (std::size_t e = 0; e < rod.size(); ++e) {
      EXPECT_GE(strain.elements[e], 0.0);
      EXPECT_GE(strain.lengths[e], rod.elements[e].rest_length * (1.0 - 1e-15));
    }
  }
}

TEST(StressCoupling, LengthsAddUpToTheIntegralOfTheVelocity) {
  // dL/dt = sum of factor times the velocity gained over each element; with equal factors c it is c V(L).
  const Profile profile = ApicalGaussianProfile{1.0, 0.5};
  rod::Rod rod = rod::straightRod({}, 0.7, 23, support::section(0.1, 1.0, 1.0));
  const GrowthFactors factors(23, 0.3);
  std::vector<rod::Vector3> drive(23, rod::Vector3::Zero());
  Elongation elongation;
  std::vector<double> rates;
  double length = 0.7;
  constexpr double kStep = 0.05;
  for (int i = 0; i < 40; ++i) {
    elementRates(profile, factors, rod, rates);
    elongate(rod, elongation.strain(profile, factors, rod, rates, kStep), TwistTransport::angle, drive);
    constexpr int kFine = 20;
    for (int k = 0; k < kFine; ++k) {  // the same equation for the length alone, by RK4 with finer steps
      const double h = kStep / kFine;
      const auto slope = [&](double L) { return 0.3 * velocity(profile, L, L); };
      const double a = slope(length), b = slope(length + 0.5 * h * a), c = slope(length + 0.5 * h * b);
      length += h / 6.0 * (a + 2.0 * b + 2.0 * c + slope(length + h * c));
    }
  }
  EXPECT_NEAR(rod.restLength(), length, 1e-8);
}

}  // namespace
}  // namespace sensory_growth::growth
