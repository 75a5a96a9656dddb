#include "sensory_growth/growth/cues.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sensory_growth/growth/differential_growth.h"
#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

using rod::Vector3;

const SectionCues nothing = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                             Eigen::Vector2d::Zero()};

std::size_t index(Cue cue) { return static_cast<std::size_t>(cue); }

/// Of an organ whose d1 points along y and d2 along z.
SectionCues sensedAt(const Senses& senses, const Environment& environment, const Vector3& position) {
  rod::Matrix3 directors;
  directors << Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX();
  return CueField(senses, environment, environment.time).at({position, rod::Quaternion(directors), 0.0});
}

Eigen::Vector2d sensedAt(const Senses& senses, const Environment& environment, const Vector3& position, Cue cue) {
  return sensedAt(senses, environment, position)[index(cue)];
}

TEST(Cues, AreZeroForAnOrganThatSensesNothing) {
  Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitX(), 2.0}};
  environment.point_sources = {{"lamp", Vector3(0.0, 0.0, 5.0), 1.0}};
  EXPECT_EQ(sensedAt({}, environment, Vector3(1, 2, 3)), nothing);
}

TEST(Cues, GravityLiftsShootsAndSinksRoots) {
  const Environment environment;
  Senses shoot;
  shoot.gravity = 0.2;
  EXPECT_LT((sensedAt(shoot, environment, Vector3(1, 2, 3), Cue::gravity) - Eigen::Vector2d(0.0, 0.2)).norm(), 1e-15);
  Senses root;
  root.gravity = -0.2;
  EXPECT_LT((sensedAt(root, environment, Vector3(1, 2, 3), Cue::gravity) - Eigen::Vector2d(0.0, -0.2)).norm(), 1e-15);
}

TEST(Cues, StayApartWhileThoseOfOneKindAddUpWithTheirStrengths) {
  Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitY(), 2.0}, {"moon", Vector3(0.0, 0.6, 0.8), -0.5}};
  environment.point_sources = {{"lamp", Vector3(0.0, 0.0, 5.0), 1.0}, {"heat", Vector3(0.0, 7.0, 1.0), -1.0}};
  Senses senses;
  senses.light_direction = 0.1;
  senses.point_source = 0.3;
  const SectionCues cues = sensedAt(senses, environment, Vector3(0.0, 3.0, 1.0));
  // 0.2 along y and -0.05 along (0, 0.6, 0.8); 0.3 along (0, -3, 4) / 5 and -0.3 along (0, 1, 0).
  EXPECT_LT((cues[index(Cue::light_direction)] - Eigen::Vector2d(0.17, -0.04)).norm(), 1e-15);
  EXPECT_LT((cues[index(Cue::point_source)] - Eigen::Vector2d(-0.18 - 0.3, 0.24)).norm(), 1e-15);
  EXPECT_EQ(cues[index(Cue::gravity)], Eigen::Vector2d::Zero());
  EXPECT_EQ(cues[index(Cue::oscillator)], Eigen::Vector2d::Zero());
}

TEST(Cues, SofteningFadesTheLampSmoothlyAtItsPlace) {
  Environment environment;
  environment.point_sources = {{"lamp", Vector3::Zero(), 1.0}};
  Senses senses;
  senses.point_source = 1.0;
  const auto sensed = [&](double y) { return sensedAt(senses, environment, Vector3(0, y, 0), Cue::point_source).x(); };
  senses.softening_length = 0.1;
  EXPECT_EQ(sensed(0.0), 0.0);
  EXPECT_NEAR(sensed(0.1), -std::sqrt(0.5), 1e-15);
  senses.softening_length = 0.0;
  EXPECT_EQ(sensed(0.0), 0.0);
  EXPECT_DOUBLE_EQ(sensed(1e-300), -1.0);
}

TEST(Cues, PointSourcesPullByTheDistanceLawAtTheSoftenedDistance) {
  Environment environment;
  environment.point_sources = {{"lamp", Vector3::Zero(), 2.0}};
  Senses senses;
  senses.point_source = 0.5;
  senses.softening_length = 3.0;
  senses.distance = InversePowerPull{10.0, 2.0};
  // At 4 m the softened distance is 5 m: 0.5 * 2 * (10 / 5)^2 * 4 / 5.
  EXPECT_NEAR(sensedAt(senses, environment, Vector3(0, 4, 0), Cue::point_source).x(), -3.2, 1e-15);
}

TEST(Cues, AnswerToAPowerOfTheStrengthWithItsSign) {
  Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitY(), 16.0}};
  environment.point_sources = {{"heat", Vector3::Zero(), -4.0}};
  Senses senses;
  senses.light_direction = 0.1;
  senses.point_source = 0.2;
  senses.intensity_exponent = 0.5;
  EXPECT_NEAR(sensedAt(senses, environment, Vector3(0, 7, 0), Cue::light_direction).x(), 0.4, 1e-15);
  EXPECT_NEAR(sensedAt(senses, environment, Vector3(0, 7, 0), Cue::point_source).x(), 0.4, 1e-15);
}

TEST(Cues, TheOscillatorTurnsFromD1ToD2AndTissueLagsBehindTheApex) {
  Senses senses;
  senses.oscillator = {0.2, 8.0, 0.5, 3.0};
  const auto sensed = [&](double time, double from_apex) -> Eigen::Vector2d {
    const Environment environment;
    const CueField field(senses, environment, time);
    return field.at({Vector3::Zero(), rod::exp({0.3, 0.2, 0.1}), from_apex})[index(Cue::oscillator)];
  };
  const auto expected = [](double angle) -> Eigen::Vector2d {
    return 0.2 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  EXPECT_LT((sensed(0.0, 0.0) - expected(0.5)).norm(), 1e-15);
  EXPECT_LT((sensed(2.0, 0.0) - expected(0.5 + M_PI_2)).norm(), 1e-15);
  EXPECT_LT((sensed(2.0, 0.1) - expected(0.2 + M_PI_2)).norm(), 1e-15);
}

TEST(Cues, EveryBendSensesWithItsOwnFrameAndPlace) {
  std::mt19937 generator(3);
  const rod::Rod rod = support::randomRod(generator, 7);
  Environment environment;
  environment.point_sources = {{"lamp", Vector3(0.4, -0.3, 0.5), 1.0}};
  Senses senses;
  senses.gravity = 0.1;
  senses.point_source = 0.2;
  senses.oscillator = {0.3, 5.0, 0.1, 2.0};
  CueFields cues;
  sense(senses, environment, 1.5, rod, cues);
  const CueField field(senses, environment, 1.5);
  double s = 0.0;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const SectionCues here = field.at({rod.vertices[j].position, rod.bendFrame(j), rod.restLength() - s});
    for (std::size_t cue = 0; cue < kCues; ++cue) EXPECT_LT((cues[cue][j] - here[cue]).norm(), 1e-13);
    s += rod.elements[j].rest_length;
  }
}

TEST(Cues, AHingeSensesNothing) {
  rod::Section section;
  section.young_modulus = section.shear_modulus = section.radius = 1.0;
  rod::Rod rod = rod::straightRod({}, 2.0, 2, section);
  rod.base_support = rod::BaseSupport::hinged;
  Environment environment;
  environment.light_directions = {{"sun", Vector3::UnitX(), 1.0}};
  Senses senses;
  senses.light_direction = 1.0;
  CueFields cues;
  sense(senses, environment, 0.0, rod, cues);
  EXPECT_EQ(cues[index(Cue::light_direction)][0], Eigen::Vector2d::Zero());
  EXPECT_EQ(cues[index(Cue::light_direction)][1], Eigen::Vector2d::UnitX());
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
  Senses senses;
  senses.light_direction = 0.5;
  CueFields cues;
  sense(senses, environment, 0.0, rod, cues);
  std::vector<Vector3> f;
  EXPECT_NEAR(drive(rod, {}, cues, f), 0.5 * std::hypot(0.6, 0.48), 1e-15);
  EXPECT_LT((f[0] - Vector3(-0.24, 0.3, 0.0) / 0.1).norm(), 1e-14);
  EXPECT_LT((f[1] - Vector3(-0.24, 0.3, 0.0) / 0.3).norm(), 1e-14);
}

TEST(Drive, HoldsTheCuesTogetherToOneIfTheLawSaturates) {
  rod::Section section;
  section.young_modulus = section.shear_modulus = 1.0;
  section.radius = 0.5;
  const rod::Rod rod = rod::straightRod({}, 1.0, 2, section);
  CueFields cues;
  for (SectionField& cue : cues) cue.assign(2, Eigen::Vector2d::Zero());
  cues[index(Cue::gravity)] = {{1.8, 0.0}, {0.3, 0.0}};
  cues[index(Cue::oscillator)] = {{0.0, 2.4}, {0.0, 0.4}};
  BendingLaw law;
  std::vector<Vector3> f;
  EXPECT_DOUBLE_EQ(drive(rod, law, cues, f), 3.0);
  EXPECT_LT((f[0] - Vector3(-4.8, 3.6, 0.0)).norm(), 1e-14);
  law.saturation = true;
  EXPECT_DOUBLE_EQ(drive(rod, law, cues, f), 3.0);  // what the cues ask for is reported all the same
  EXPECT_LT((f[0] - Vector3(-1.6, 1.2, 0.0)).norm(), 1e-14);
  EXPECT_LT((f[1] - Vector3(-0.8, 0.6, 0.0)).norm(), 1e-14);
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
