// Growth-rate profiles: values of model.md 2 and the integral against quadrature.

#include "sensory_growth/growth/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::growth {
namespace {

/// Composite 5-point Gauss quadrature of the rate over [a, b], where it is smooth.
double smoothQuadrature(const Profile& profile, double a, double b, double L) {
  constexpr double kNode[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640};
  constexpr double kWeight[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                0.2369268850561891};
  constexpr int kPanels = 2000;
  const double half = 0.5 * (b - a) / kPanels;
  double sum = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = a + (2 * panel + 1) * half;
    for (int i = 0; i < 5; ++i) sum += half * kWeight[i] * rate(profile, middle + half * kNode[i], L);
  }
  return sum;
}

struct Case {
  std::string name;
  Profile profile;
  double largest_rate;
  std::vector<double> kinks;  ///< distances from the apex at which the rate is not smooth, decreasing
};

/// The same over [0, s], split at the kinks.
double quadrature(const Case& of, double s, double L) {
  double sum = 0.0;
  double from = 0.0;
  for (const double kink : of.kinks) {
    const double to = std::clamp(L - kink, from, s);
    sum += smoothQuadrature(of.profile, from, to, L);
    from = to;
  }
  return sum + smoothQuadrature(of.profile, from, s, L);
}

class AnyProfile : public testing::TestWithParam<Case> {};

TEST_P(AnyProfile, VelocityIsTheIntegralOfTheRate) {
  const Profile& profile = GetParam().profile;
  for (const double L : {0.25, 1.0, 2.5, 10.0}) {
    for (const double fraction : {0.1, 0.5, 1.0}) {
      const double s = fraction * L;
      EXPECT_NEAR(velocity(profile, s, L), quadrature(GetParam(), s, L), 1e-13 * (1.0 + s))
          << "s = " << s << ", L = " << L;
    }
  }
  EXPECT_EQ(velocity(profile, 0.0, 3.0), 0.0);
}

TEST_P(AnyProfile, VelocitiesOfManyPointsAreThoseOfEachWithAnyInstructions) {
  const Profile& profile = GetParam().profile;
  for (const rod::InstructionSet set : rod::availableInstructionSets()) {
    rod::useInstructionSet(set);
    for (const std::size_t points : {1u, 7u, 8u, 101u}) {
      for (const double L : {0.25, 10.0, 1e4}) {
        std::vector<double> s;
        for (std::size_t i = 1; i <= points; ++i) s.push_back(L * static_cast<double>(i) / static_cast<double>(points));
        std::vector<double> v = s;
        velocities(profile, L, v);
        for (std::size_t i = 0; i < points; ++i) {
          EXPECT_NEAR(v[i], velocity(profile, s[i], L), 4e-15 * (1.0 + velocity(profile, s[i], L)))
              << rod::name(set) << ", s = " << s[i] << ", L = " << L;
        }
      }
    }
  }
  rod::useInstructionSet(rod::availableInstructionSets().back());
}

TEST_P(AnyProfile, RateIsNeverNegativeNorAboveItsMaximum) {
  const Profile& profile = GetParam().profile;
  for (double s = 0.0; s <= 10.0; s += 0.01) {
    EXPECT_GE(rate(profile, s, 10.0), 0.0);
    EXPECT_LE(rate(profile, s, 10.0), GetParam().largest_rate);
  }
}

TEST_P(AnyProfile, KnowsItsLargestRate) { EXPECT_EQ(largestRate(GetParam().profile), GetParam().largest_rate); }

INSTANTIATE_TEST_SUITE_P(
    Profiles, AnyProfile,
    testing::Values(Case{"Logistic", LogisticProfile{1.0, 2.0, 15.0}, 1.0, {}},
                    Case{"SoftLogistic", LogisticProfile{0.7, 1.0, 5.0}, 0.7, {}},
                    Case{"Uniform", UniformProfile{1.3}, 1.3, {}},
                    Case{"ApicalFlat", ApicalFlatProfile{1.0, 2.0}, 1.0, {2.0}},
                    Case{"ApicalGaussian", ApicalGaussianProfile{0.8, 1.5}, 0.8, {}},
                    Case{"Sampled", SampledProfile({0.0, 0.5, 2.0, 3.0}, {0.4, 0.9, 0.2, 0.0}), 0.9, {3.0, 2.0, 0.5}},
                    Case{"SampledWithoutEnd", SampledProfile({0.0, 1.0}, {0.4, 0.1}), 0.4, {1.0}},
                    Case{"SampledOnce", SampledProfile({0.0}, {0.3}), 0.3, {}}),
    [](const auto& info) { return info.param.name; });

TEST(LogisticProfile, GrowsAtTheApexAndNotAtTheBase) {
  const Profile profile = LogisticProfile{1.0, 2.0, 15.0};
  EXPECT_NEAR(rate(profile, 10.0, 10.0), 1.0, 1e-6);
  EXPECT_LT(rate(profile, 0.0, 10.0), 1e-20);
  EXPECT_DOUBLE_EQ(rate(profile, 8.0, 10.0), 0.5);
}

TEST(LogisticProfile, AverageOverACellMatchesTheReference) {
  const Profile profile = LogisticProfile{1.0, 2.0, 15.0};
  const double average = (velocity(profile, 8.4, 10.0) - velocity(profile, 7.9, 10.0)) / 0.5;
  EXPECT_NEAR(average, 0.709791, 5e-7);  // model.md 2
}

TEST(LogisticProfile, LongOrganElongatesAtTheReferenceSpeed) {
  // V12b: (rate zone / m) log(1 + exp(m)).
  EXPECT_NEAR(velocity(LogisticProfile{1.0, 1.0, 15.0}, 50.0, 50.0), 1.000000020, 1e-9);
  EXPECT_NEAR(velocity(LogisticProfile{1.0, 1.0, 5.0}, 50.0, 50.0), 1.001343070, 1e-9);
}

TEST(LogisticProfile, DoesNotOverflow) {
  const Profile profile = LogisticProfile{1.0, 1.0, 15.0};
  EXPECT_NEAR(velocity(profile, 1e4, 1e4), 1.0, 1e-6);
  EXPECT_EQ(rate(profile, 0.0, 1e4), 0.0);
}

TEST(ApicalGaussianProfile, IsTheBellOfTheModel) {
  const double zone = 0.7;
  const double w = zone * std::sqrt(2.0 / M_PI);  // model.md 2
  const Profile profile = ApicalGaussianProfile{1.2, zone};
  EXPECT_EQ(rate(profile, 10.0, 10.0), 1.2);
  EXPECT_NEAR(rate(profile, 10.0 - w, 10.0), 1.2 * std::exp(-0.5), 1e-14);
  EXPECT_NEAR(rate(profile, 10.0 - 3.0 * w, 10.0), 1.2 * std::exp(-4.5), 1e-14);
  EXPECT_NEAR(velocity(profile, 50.0, 50.0), 1.2 * zone, 1e-14);
}

TEST(ApicalGaussianProfile, KeepsItsDigitsFarFromTheApex) {
  const Profile profile = ApicalGaussianProfile{1.0, 1.0};
  std::vector<double> v = {1.0, 1.1};
  velocities(profile, 10.0, v);
  // exp(-pi/4 d^2) integrated over d from 8.9 to 9.0 by Simpson's rule with 2000 panels.
  EXPECT_NEAR((v[1] - v[0]) / 5.157064174275e-29, 1.0, 1e-12);
}

TEST(SampledProfile, IsLinearBetweenItsSamplesAndHoldsTheLast) {
  const Profile profile = SampledProfile({0.0, 1.0, 3.0}, {0.2, 0.6, 0.1});
  EXPECT_DOUBLE_EQ(rate(profile, 10.0, 10.0), 0.2);
  EXPECT_DOUBLE_EQ(rate(profile, 9.5, 10.0), 0.4);
  EXPECT_DOUBLE_EQ(rate(profile, 8.0, 10.0), 0.35);
  EXPECT_DOUBLE_EQ(rate(profile, 2.0, 10.0), 0.1);
  EXPECT_DOUBLE_EQ(velocity(profile, 10.0, 10.0), 0.4 + 0.7 + 0.7);
  EXPECT_DOUBLE_EQ(velocity(profile, 0.5, 0.5), 0.5 * 0.5 * (0.2 + 0.4));  // shorter than its zone
}

TEST(SampledProfile, RefusesSamplesThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SampledProfile({}, {}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.0, 1.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.1, 1.0}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.0, 1.0, 1.0}, {1.0, 1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.0, 1.0}, {1.0, -0.1}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.0, 1.0}, {nan, 1.0}), std::invalid_argument);
  EXPECT_THROW(SampledProfile({0.0, nan}, {1.0, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sensory_growth::growth
