// Growth-rate profiles: values of model.md 2 and the integral against quadrature.

#include "sensory_growth/growth/profile.h"

#include <algorithm>
#include <cmath>
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

/// The same over [0, s], split where an apical zone of length `zone` begins.
double quadrature(const Profile& profile, double s, double L, double zone) {
  const double split = std::clamp(L - zone, 0.0, s);
  return smoothQuadrature(profile, 0.0, split, L) + smoothQuadrature(profile, split, s, L);
}

struct Case {
  std::string name;
  Profile profile;
  double largest_rate;
};

class AnyProfile : public testing::TestWithParam<Case> {};

TEST_P(AnyProfile, VelocityIsTheIntegralOfTheRate) {
  const Profile& profile = GetParam().profile;
  for (const double L : {0.25, 1.0, 2.5, 10.0}) {
    for (const double fraction : {0.1, 0.5, 1.0}) {
      const double s = fraction * L;
      EXPECT_NEAR(velocity(profile, s, L), quadrature(profile, s, L, 2.0), 1e-13 * (1.0 + s))
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

INSTANTIATE_TEST_SUITE_P(Profiles, AnyProfile,
                         testing::Values(Case{"Logistic", LogisticProfile{1.0, 2.0, 15.0}, 1.0},
                                         Case{"SoftLogistic", LogisticProfile{0.7, 1.0, 5.0}, 0.7},
                                         Case{"Uniform", UniformProfile{1.3}, 1.3},
                                         Case{"ApicalFlat", ApicalFlatProfile{1.0, 2.0}, 1.0}),
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

}  // namespace
}  // namespace sensory_growth::growth
