#include "sensory_growth/growth/cues.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sensory_growth/growth/differential_growth.h"

namespace sensory_growth::growth {
namespace {

using rod::Vector3;

TEST(Cues, GravityLiftsShootsAndSinksRoots) {
  const Environment environment;
  Sensitivities shoot;
  shoot.gravity = 0.2;
  EXPECT_EQ(differentialGrowth(shoot, environment, Vector3(1, 2, 3)), Vector3(0, 0, 0.2));
  Sensitivities root;
  root.gravity = -0.2;
  EXPECT_EQ(differentialGrowth(root, environment, Vector3(1, 2, 3)), Vector3(0, 0, -0.2));
}

TEST(Cues, LightsAndLampsAddUpWithTheirStrengths) {
  Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitX(), 2.0}};
  environment.point_sources = {{"lamp", Vector3(0.0, 0.0, 5.0), 1.0}, {"heat", Vector3(0.0, 7.0, 1.0), -1.0}};
  Sensitivities sensitivities;
  sensitivities.light_direction = 0.1;
  sensitivities.point_source = 0.3;
  const Vector3 delta = differentialGrowth(sensitivities, environment, Vector3(0.0, 3.0, 1.0));
  // 0.2 along x; 0.3 along (0, -3, 4) / 5; -0.3 along (0, 1, 0).
  EXPECT_LT((delta - Vector3(0.2, -0.18 - 0.3, 0.24)).norm(), 1e-15);
}

TEST(Cues, SofteningFadesTheLampSmoothlyAtItsPlace) {
  Environment environment;
  environment.point_sources = {{"lamp", Vector3::Zero(), 1.0}};
  Sensitivities sensitivities;
  sensitivities.point_source = 1.0;
  sensitivities.softening_length = 0.1;
  EXPECT_EQ(differentialGrowth(sensitivities, environment, Vector3::Zero()), Vector3::Zero());
  EXPECT_NEAR(differentialGrowth(sensitivities, environment, Vector3(0.1, 0, 0)).x(), -std::sqrt(0.5), 1e-15);
  sensitivities.softening_length = 0.0;
  EXPECT_EQ(differentialGrowth(sensitivities, environment, Vector3::Zero()), Vector3::Zero());
  EXPECT_DOUBLE_EQ(differentialGrowth(sensitivities, environment, Vector3(1e-300, 0, 0)).x(), -1.0);
}

TEST(Drive, ActsInTheCrossSectionWithTheRadiusOfTheBend) {
  rod::Section section;
  section.young_modulus = section.shear_modulus = 1.0;
  section.radius = 0.1;
  rod::Rod rod = rod::straightRod({}, 2.0, 2, section);
  rod.elements[1].section.radius = 0.4;
  rod.elements[0].rest_length = 0.5;  // the bend between them belongs to the second element for two thirds
  Environment environment;
  environment.light_directions = {{"sun", Vector3(0.6, 0.48, 0.64), 1.0}};
  BendingLaw law;
  law.sensitivities.light_direction = 0.5;
  std::vector<Eigen::Vector2d> f;
  EXPECT_NEAR(drive(law, environment, rod, f), 0.5 * std::hypot(0.6, 0.48), 1e-15);
  EXPECT_LT((f[0] - Eigen::Vector2d(-0.24, 0.3) / 0.1).norm(), 1e-14);
  EXPECT_LT((f[1] - Eigen::Vector2d(-0.24, 0.3) / 0.3).norm(), 1e-14);
}

TEST(Phi, FollowsTheirDefinitionsThroughZero) {
  EXPECT_EQ(phi1(0.0), 1.0);
  EXPECT_EQ(phi2(0.0), 0.5);
  EXPECT_NEAR(phi1(1.0), 0.63212055882855768, 1e-15);
  EXPECT_NEAR(phi2(1.0), 0.36787944117144232, 1e-15);
  EXPECT_NEAR(phi1(30.0), 1.0 / 30.0, 1e-14);
  // Taylor polynomials on both sides of the switches.
  for (const double G : {0.9e-4, 1.1e-4, 0.9e-2, 1.1e-2}) {
    EXPECT_NEAR(phi1(G), 1 - G / 2 + G * G / 6 - G * G * G / 24 + std::pow(G, 4) / 120 - std::pow(G, 5) / 720, 1e-15);
    EXPECT_NEAR(phi2(G), 0.5 - G / 6 + G * G / 24 - G * G * G / 120 + std::pow(G, 4) / 720 - std::pow(G, 5) / 5040,
                1e-12);
  }
}

}  // namespace
}  // namespace sensory_growth::growth
