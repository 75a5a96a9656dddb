// The growth laws of model.md 6 with elasticity and weight: V19 and V20 of model.md 18, C2, C3 and C10 of the published
// and derived cases, their order in time, and what they do near self-buckling.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "support/growing.h"
#include "support/scenarios.h"

namespace sensory_growth::simulation {
namespace {

using growth::Proprioception;
using rod::Vector3;
using support::degrees;
using support::grown;
using support::kinematicScenario;
using support::onlyRod;
using support::order;
using support::takeSteps;
using support::tip;
using support::tipAngle;

constexpr double kRadius = 0.05;  // of kinematicScenario()

/// A horizontal shoot of unit length and bending stiffness that keeps its length. Its weight per length is S; per unit
/// of growth it rights itself by G and straightens by 1, so that its convergence length is 1 / G.
Scenario heavyShoot(double G, double S, std::size_t elements = 100) {
  Scenario scenario = kinematicScenario(0.1, elements);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::inextensibleSection(1.0, S);
  organ.section.radius = kRadius;
  organ.section.young_modulus = 4.0 / (M_PI * std::pow(kRadius, 4));
  organ.section.shear_modulus = organ.section.young_modulus / 3.0;
  organ.section.density = S / (M_PI * kRadius * kRadius);
  organ.elongation = false;
  organ.senses.gravity = G * kRadius;
  return scenario;
}

rod::Rod steady(const Proprioception& law, double G, double S) {
  Scenario scenario = heavyShoot(G, S);
  scenario.organs.front().bending.proprioception = law;
  return grown(scenario, 300);
}

const Proprioception kIntrinsic{kRadius, 0.0, 0.0, Eigen::Vector2d::Zero()};
const Proprioception kActual{0.0, kRadius, 0.0, Eigen::Vector2d::Zero()};
const Proprioception kRelaxation{0.0, 0.0, kRadius, Eigen::Vector2d::Zero()};

// --- C2 and V19: steady shapes under weight
// ---------------------------------------------------------------------------

struct Sag {
  double G, S;
  double tip_angle;  ///< [deg]
  double x, z;
};

void PrintTo(const Sag& sag, std::ostream* out) { *out << "G " << sag.G << ", S " << sag.S; }

void expectShape(const rod::Rod& rod, const Sag& expected) {
  EXPECT_NEAR(degrees(tipAngle(rod)), expected.tip_angle, 0.2);
  EXPECT_LT((tip(rod) - Vector3(expected.x, 0.0, expected.z)).norm(), 2e-3) << tip(rod).transpose();
}

class SteadyActual : public testing::TestWithParam<Sag> {};

TEST_P(SteadyActual, HasTheUniversalShapeUnderAnyWeight) {
  expectShape(steady(kActual, GetParam().G, GetParam().S), GetParam());
}

INSTANTIATE_TEST_SUITE_P(AnyWeight, SteadyActual,
                         testing::Values(Sag{1, 1, 40.395, 0.86577, 0.43378}, Sag{1, 4, 40.395, 0.86577, 0.43378},
                                         Sag{2, 1, 15.415, 0.65088, 0.66250}, Sag{2, 4, 15.415, 0.65088, 0.66250},
                                         Sag{4, 1, 2.099, 0.38354, 0.82680}, Sag{4, 4, 2.099, 0.38354, 0.82680}));

class SteadyIntrinsic : public testing::TestWithParam<Sag> {};

TEST_P(SteadyIntrinsic, SagsWithItsWeight) { expectShape(steady(kIntrinsic, GetParam().G, GetParam().S), GetParam()); }

INSTANTIATE_TEST_SUITE_P(ChelakkotMahadevan2017, SteadyIntrinsic,
                         testing::Values(Sag{1, 1, 46.591, 0.91119, 0.34540}, Sag{1, 4, 71.188, 0.99065, 0.00001},
                                         Sag{2, 1, 17.550, 0.69035, 0.62361}, Sag{2, 4, 27.474, 0.82996, 0.44001},
                                         Sag{4, 1, 2.296, 0.39773, 0.81794}, Sag{4, 4, 3.090, 0.44997, 0.78240}));

TEST(SteadyActualShape, IsThatOfTheWeightlessOrgan) {
  const Vector3 expected(0.650880168, 0.0, 0.662501374);  // V19
  EXPECT_LT((tip(steady(kActual, 2.0, 3.0)) - expected).norm(), 1e-4);
}

// --- V20 and C10: strain relaxation
// -----------------------------------------------------------------------------------

TEST(StrainRelaxation, CreepsUnderAnEndCouple) {
  const auto creep = [](double step) {
    Scenario scenario = heavyShoot(0.0, 0.0, 10);
    scenario.weight = false;
    scenario.stepping.step = step;
    scenario.organs.front().loads.tip_couple = {0.0, 0.3, 0.0};
    scenario.organs.front().bending.proprioception = kRelaxation;
    return grown(scenario, std::lround(1.0 / step)).bends[4];
  };
  EXPECT_NEAR(creep(0.05).rest_curvature.y(), 0.3, 1e-3 * 0.3);
  EXPECT_NEAR(creep(0.05).curvature.y() - creep(0.05).rest_curvature.y(), 0.3, 1e-10);
  const auto error = [&](double step) { return creep(step).rest_curvature.y() - 0.3; };
  EXPECT_NEAR(order(error(0.2), error(0.1)), 2.0, 0.1);
}

TEST(StrainRelaxation, TwistsUnderAnEndCoupleAndGrowthDilutesIt) {
  // dk0 = -k0 + (gamma_r / R) m per unit strain, where m = M / (2 G I) = 0.3 / (2 / 3) of an elongating organ.
  const auto creep = [](double step) {
    Scenario scenario = heavyShoot(0.0, 0.0, 10);
    scenario.weight = false;
    scenario.stepping.step = step;
    scenario.organs.front().elongation = true;
    scenario.organs.front().loads.tip_couple = {0.0, 0.0, 0.3};
    scenario.organs.front().bending.proprioception = kRelaxation;
    return grown(scenario, std::lround(1.0 / step)).bends[4].rest_curvature.z();
  };
  const double expected = 0.45 * (1.0 - std::exp(-1.0));
  EXPECT_NEAR(creep(0.025), expected, 1e-3 * expected);
  EXPECT_NEAR(order(creep(0.1) - expected, creep(0.05) - expected), 2.0, 0.1);
  EXPECT_NEAR(order(creep(0.05) - expected, creep(0.025) - expected), 2.0, 0.1);
}

TEST(StrainRelaxation, KeepsItsTwistWhereFibresAreHelical) {
  // Without dilution the twist creeps as bending does: k0 = (gamma_r / R) m strain.
  Scenario scenario = heavyShoot(0.0, 0.0, 10);
  scenario.weight = false;
  scenario.stepping.step = 0.025;
  scenario.organs.front().elongation = true;
  scenario.organs.front().twist_transport = growth::TwistTransport::rate;
  scenario.organs.front().loads.tip_couple = {0.0, 0.0, 0.3};
  scenario.organs.front().bending.proprioception = kRelaxation;
  EXPECT_NEAR(grown(scenario, 40).bends[4].rest_curvature.z(), 0.45, 1e-3 * 0.45);
}

/// C10: an organ of which the upper `zone` grows, held on an arc of curvature 0.8 at both ends.
Scenario heldOnAnArc(double zone) {
  Scenario scenario = heavyShoot(0.0, 0.0, 40);
  scenario.weight = false;
  scenario.stepping.step = 0.05;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.profile = growth::ApicalFlatProfile{1.0, zone};
  organ.bending.proprioception = kRelaxation;
  rod::Rod arc = rod::straightRod(organ.base, organ.length, organ.elements, organ.section);
  for (rod::Bend& bend : arc.bends) bend.curvature.y() = 0.8;
  arc.rebuild();
  organ.loads.surroundings.held_apex = mechanics::HeldApex{arc.apex().position, arc.apex().frame};
  return scenario;
}

TEST(StrainRelaxation, TakesOverTheCurvatureInWhichItIsHeld) {
  Simulation simulation(heldOnAnArc(1.0));
  const double energy = simulation.organs().front().energy().bending;
  EXPECT_NEAR(energy, 0.5 * 0.8 * 0.8 * (1.0 - 0.5 / 40), 1e-9);  // no bend answers for the last half element
  takeSteps(simulation, 30);
  for (const rod::Bend& bend : onlyRod(simulation).bends) {
    EXPECT_NEAR(bend.curvature.y(), 0.8, 1e-6);
    EXPECT_NEAR(bend.rest_curvature.y(), 0.8 * (1.0 - std::exp(-1.5)), 1e-8);
  }
  // The moment that holds it decays likewise.
  EXPECT_NEAR(simulation.organs().front().energy().bending, energy * std::exp(-3.0), 1e-6);
}

TEST(StrainRelaxation, IsLeftToTissueThatGrows) {
  const rod::Rod rod = grown(heldOnAnArc(0.5), 30);
  for (std::size_t j = 0; j < 20; ++j) EXPECT_EQ(rod.bends[j].rest_curvature, Vector3::Zero()) << j;
  for (std::size_t j = 21; j < 40; ++j) EXPECT_GT(rod.bends[j].rest_curvature.y(), 0.3) << j;
}

// --- Set point
// --------------------------------------------------------------------------------------------------------

TEST(SetPoint, IsWhereIntrinsicProprioceptionLeads) {
  Scenario scenario = kinematicScenario(0.7, 10);
  OrganScenario& organ = scenario.organs.front();
  organ.elongation = false;
  organ.rest_curvature = {1.0, 0.0, 0.0};
  organ.bending.proprioception = {0.1, 0.0, 0.0, {0.5, -2.0}};
  for (const rod::Bend& bend : grown(scenario, 3).bends) {  // exact for any step: gamma / R = 2 over a strain of 2.1
    EXPECT_NEAR(bend.rest_curvature.x(), 0.5 + 0.5 * std::exp(-4.2), 1e-14);
    EXPECT_NEAR(bend.rest_curvature.y(), -2.0 * (1.0 - std::exp(-4.2)), 1e-14);
  }
}

TEST(SetPoint, IsReachedByTheActualCurvatureUnderWeight) {
  Scenario scenario = heavyShoot(0.0, 3.0, 40);
  scenario.organs.front().bending.proprioception = {0.0, kRadius, 0.0, {0.0, -0.7}};
  for (const rod::Bend& bend : grown(scenario, 300).bends) EXPECT_NEAR(bend.curvature.y(), -0.7, 1e-6);
}

// --- Order in time
// ----------------------------------------------------------------------------------------------------

struct Law {
  std::string name;
  growth::BendingLaw bending;
  growth::Oscillator oscillator;
  growth::TwistTransport twist = growth::TwistTransport::angle;
};

void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

class AnyLaw : public testing::TestWithParam<Law> {};

/// A heavy, twisted organ that grows by exp(0.8) while it rights itself towards a lamp, in three dimensions.
Vector3 grownTip(const Law& law, int steps) {
  Scenario scenario = kinematicScenario(0.8 / steps, 30);
  scenario.relaxation = RelaxationMethod::statics;
  scenario.relaxation_settings.tolerance = 1e-12;
  scenario.weight = true;
  scenario.gravity = -Vector3::UnitZ();
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {1.0, 2.0, 1.0}, 1.0}}};
  OrganScenario& organ = scenario.organs.front();
  organ.section = support::section(kRadius, 1.0, 1.5);
  organ.rest_curvature = {0.3, 0.2, 1.5};
  organ.senses.gravity = 0.15;
  organ.senses.point_source = 0.05;
  organ.senses.softening_length = 0.01;
  organ.senses.oscillator = law.oscillator;
  organ.bending = law.bending;
  organ.twist_transport = law.twist;
  return tip(grown(scenario, steps));
}

TEST_P(AnyLaw, IsSecondOrderInTimeWithElasticityWeightAndGrowth) {
  const Vector3 tips[] = {grownTip(GetParam(), 80), grownTip(GetParam(), 160), grownTip(GetParam(), 320),
                          grownTip(GetParam(), 640)};
  EXPECT_NEAR(order((tips[0] - tips[1]).norm(), (tips[1] - tips[2]).norm()), 2.0, 0.1);
  EXPECT_NEAR(order((tips[1] - tips[2]).norm(), (tips[2] - tips[3]).norm()), 2.0, 0.05);
}

Law law(const std::string& name, const Proprioception& proprioception) {
  Law law;
  law.name = name;
  law.bending.proprioception = proprioception;
  return law;
}

Law withRotation(Law law) {
  law.name += "Rotating";
  law.bending.rotation = growth::RestRotation{2.0, 1e-3};
  return law;
}

Law withOscillator(Law law) {
  law.name += "Oscillating";
  law.oscillator = {0.1, 1.5, 0.4, 2.0};
  return law;
}

Law withHelicalFibres(Law law) {
  law.name += "Helical";
  law.twist = growth::TwistTransport::rate;
  return law;
}

const Proprioception kAll{0.02, 0.015, 0.03, {0.2, -0.4}};

INSTANTIATE_TEST_SUITE_P(Laws, AnyLaw,
                         testing::Values(law("None", {}), law("Intrinsic", {0.03, 0.0, 0.0, {0.0, 0.0}}),
                                         law("Actual", {0.0, 0.03, 0.0, {0.0, 0.0}}),
                                         law("Relaxation", {0.0, 0.0, 0.03, {0.0, 0.0}}), law("All", kAll),
                                         withHelicalFibres(law("All", kAll)), withOscillator(law("All", kAll)),
                                         withRotation(law("All", kAll))),
                         [](const auto& info) { return info.param.name; });

// --- C3: strain relaxation under weight
// --------------------------------------------------------------------------------------

/// Tip angles at equal times of an upright organ whose growth law is strain relaxation alone, disturbed by 1e-6.
std::vector<double> swayOfTheTip(double S, double time) {
  Scenario scenario = heavyShoot(2.0, S, 100);
  scenario.relaxation_settings.tolerance = 1e-13;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.rest_curvature = {0.0, 1e-6, 0.0};
  organ.bending.proprioception = kRelaxation;
  Simulation simulation(scenario);
  std::vector<double> angles;
  for (long i = 0; i < std::lround(time / scenario.stepping.step); ++i) {
    takeSteps(simulation, 1);
    angles.push_back(tipAngle(onlyRod(simulation)));
  }
  return angles;
}

TEST(StrainRelaxationAlone, SwaysEverMoreUnderAWeightAbove4Point8) {
  // The leading eigenvalue of the small-angle problem at G = 2, S = 6, by dense collocation with 400 points:
  // 0.3044 + 0.7128 i (in units of the relaxation); it crosses the imaginary axis at S = 4.816, 0.597 i.
  const std::vector<double> angles = swayOfTheTip(6.0, 25.0);
  // A pair of modes obeys x(t + h) = p x(t) - q x(t - h) with q = exp(2 sigma h), p = 2 exp(sigma h) cos(omega h).
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t i = 150; i + 1 < angles.size(); ++i) {
    const Eigen::Vector2d row(angles[i], -angles[i - 1]);
    normal += row * row.transpose();
    right += row * angles[i + 1];
  }
  const Eigen::Vector2d pq = normal.inverse() * right;
  const double sigma = 0.5 * std::log(pq[1]) / 0.1;
  const double omega = std::acos(0.5 * pq[0] / std::sqrt(pq[1])) / 0.1;
  EXPECT_NEAR(sigma, 0.3044, 0.1 * 0.3044);
  EXPECT_NEAR(omega, 0.7128, 0.1 * 0.7128);
}

TEST(StrainRelaxationAlone, StillSettlesUnderALesserWeight) {
  // The matrix exponential of the same collocation, with 800 points.
  const struct {
    double time, angle;
  } expected[] = {{5.0, -0.19523}, {10.0, 0.35360}, {20.0, 0.30489}, {40.0, -0.12292}, {60.0, 0.04491}};
  const std::vector<double> angles = swayOfTheTip(4.0, 60.0);
  for (const auto& [time, angle] : expected) {
    EXPECT_NEAR(angles[static_cast<std::size_t>(std::lround(time / 0.1)) - 1] / 1e-6, angle, 0.01) << "at " << time;
  }
}

// --- Near self-buckling
// -----------------------------------------------------------------------------------------------

TEST(ActualProprioception, TakesShorterPartsTheNearerTheOrganIsToFallingOver) {
  // An upright column at 0.9 of its Greenhill length: what its rest state turns, it turns about ten times as much.
  Scenario scenario = heavyShoot(1.0, 0.9 * 7.837347, 40);
  scenario.stepping.step = 2.0;
  scenario.stepping.limits.bend_angle = 0.02;
  OrganScenario& organ = scenario.organs.front();
  organ.base.frame.setIdentity();
  organ.rest_curvature = {0.0, 0.05, 0.0};
  organ.bending.proprioception = kActual;
  const auto partsOfTheSecondStep = [&] {
    Simulation simulation(scenario);
    takeSteps(simulation, 2);
    return simulation.organs().front().report().substeps;
  };
  const int heavy = partsOfTheSecondStep();
  organ.section.density = 0.0;
  scenario.weight = false;
  const int weightless = partsOfTheSecondStep();
  EXPECT_GT(heavy, 3 * weightless);
}

}  // namespace
}  // namespace sensory_growth::simulation
