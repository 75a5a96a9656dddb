// The shipped scenarios of growing, pressing and aging tissue do what their descriptions say.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::simulation {
namespace {

using rod::Vector3;

const rod::Rod& onlyRod(const Simulation& simulation) { return simulation.organs().front().rod(); }

/// Takes steps until the growth time is reached.
void growUntil(Simulation& simulation, double hours) {
  while (simulation.time() < hours * 3600.0 - 1.0) {
    const StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

// --- maize_root_on_stop
// -----------------------------------------------------------------------------------------------

constexpr double kLargestPush = 0.3455751919;  // 0.44 MPa on a disk of 0.5 mm radius [N]

/// Force of the gauge on the root [N].
double push(const Simulation& simulation) { return 1000.0 * (onlyRod(simulation).vertices.back().position.z() + 8e-3); }

/// Without bending the stress is the same everywhere, and so is the factor: dL/dt = V (1 - F / F_max) with V = 1.725
/// mm/h and F = k (L - 8 mm) / (1 + k L / E A). Integrated with scipy (DOP853, 1e-11) this gives the pushes below.
TEST(MaizeRootOnStop, PushesByLockhartsLawUntilItsGrowthStops) {
  Simulation simulation(loadScenario("../config/maize_root_on_stop.yaml"));
  const struct {
    double hours;
    double push;
  } expected[] = {{0.25, 0.2102424}, {0.5, 0.2920356}, {1.0, 0.3371157}, {2.0, 0.3453626}};
  for (const auto& at : expected) {
    growUntil(simulation, at.hours);
    EXPECT_NEAR(-push(simulation), at.push, 1e-3 * kLargestPush) << at.hours;
    EXPECT_LT(-push(simulation), kLargestPush);
  }
  growUntil(simulation, 4.0);
  EXPECT_NEAR(-push(simulation), kLargestPush, 1e-5 * kLargestPush);
  for (const double rate : simulation.organs().front().growthRates()) EXPECT_LT(rate, 1e-5 * 0.4 / 3600.0);
  for (const rod::Vertex& vertex : onlyRod(simulation).vertices) EXPECT_LT(vertex.position.head<2>().norm(), 1e-9);
}

TEST(MaizeRootOnStop, RunsAwayAndBucklesWithTheSignOfTheDraft) {
  Scenario scenario = loadScenario("../config/maize_root_on_stop.yaml");
  scenario.organs.front().stress_coupling->sign = -1.0;
  Simulation simulation(scenario);
  growUntil(simulation, 0.25);
  EXPECT_GT(simulation.organs().front().growthRates().back(), 2.0 * 0.11 / 3600.0);
  const rod::Rod& rod = onlyRod(simulation);
  EXPECT_GT(rod.vertices[rod.size() / 2].position.head<2>().norm(), 0.3e-3);
}

// --- lignifying_stem
// --------------------------------------------------------------------------------------------------

Scenario inLongSteps(const char* file) {
  Scenario scenario = loadScenario(file);
  scenario.stepping.step = 600.0;
  return scenario;
}

double tipHeight(const Simulation& simulation) { return onlyRod(simulation).vertices.back().position.z(); }

TEST(LignifyingStem, KeepsWhatItHasLifted) {
  Simulation wood(inLongSteps("../config/lignifying_stem.yaml"));
  Simulation herb(inLongSteps("../config/herbaceous_stem.yaml"));
  EXPECT_NEAR(tipHeight(wood), -0.0246, 1e-4);
  EXPECT_NEAR(tipHeight(wood), tipHeight(herb), 1e-9);
  growUntil(wood, 24.0);
  growUntil(herb, 24.0);
  EXPECT_NEAR(tipHeight(wood), 0.067, 0.002);
  EXPECT_LT(tipHeight(herb), 0.01);
  const Vector3 low_tip = onlyRod(wood).vertices[20].position;  // 4 cm from the base
  growUntil(wood, 48.0);
  EXPECT_NEAR(tipHeight(wood), 0.138, 0.003);
  EXPECT_GT((onlyRod(wood).apex().frame * Vector3::UnitZ()).z(), std::cos(5.0 * M_PI / 180.0));
  EXPECT_LT((onlyRod(wood).vertices[20].position - low_tip).norm(), 0.2e-3);
}

TEST(LignifyingStem, AgesByItsClock) {
  Simulation simulation(inLongSteps("../config/lignifying_stem.yaml"));
  growUntil(simulation, 24.0);
  const rod::Element& mature = onlyRod(simulation).elements.front();  // never in the zone
  EXPECT_NEAR(mature.age, 86400.0, 1e-6);
  EXPECT_NEAR(mature.section.young_modulus, 1e9 - 0.99e9 * std::exp(-2.0), 1.0);
  EXPECT_NEAR(mature.section.radius, 3e-3 - 1e-3 * std::exp(-0.5), 1e-12);
  const rod::Element& young = onlyRod(simulation).elements.back();
  EXPECT_NEAR(young.section.young_modulus, 10e6, 1.0);
  EXPECT_NEAR(young.section.radius, 2e-3, 1e-12);
}

TEST(HerbaceousStem, DroopsAsTheElasticaAndElongates) {
  Simulation simulation(inLongSteps("../config/herbaceous_stem.yaml"));
  // Inextensible, by collocation (solve_bvp of SciPy).
  EXPECT_LT((onlyRod(simulation).vertices.back().position - Vector3(117.087e-3, 0.0, -24.568e-3)).norm(), 0.1e-3);
  growUntil(simulation, 24.0);
  EXPECT_NEAR(onlyRod(simulation).restLength(), 0.192, 1e-6);  // 3 mm an hour
}

// --- ripening_branch
// -------------------------------------------------------------------------------------------------

TEST(RipeningBranch, SinksUnderTheWeightItLaysDown) {
  // Of a slight sag dy = dw L^4 / (8 B), new weight over the stiffness at its time; quad of SciPy.
  Simulation simulation(loadScenario("../config/ripening_branch.yaml"));
  EXPECT_NEAR(tipHeight(simulation), -1.962e-3, 0.005e-3);
  const struct { double days, height; } expected[] = {{30.0, -2.6264e-3}, {60.0, -2.7278e-3}, {90.0, -2.7564e-3}};
  for (const auto& [days, height] : expected) {
    growUntil(simulation, 24.0 * days);
    EXPECT_NEAR(tipHeight(simulation), height, 0.005e-3) << days;
    const rod::Element& element = onlyRod(simulation).elements[30];
    EXPECT_NEAR(element.section.young_modulus, 2e9 - 1e9 * std::exp(-days / 30.0), 1.0);
    EXPECT_NEAR(element.section.radius, 3e-3 - 1e-3 * std::exp(-days / 30.0), 1e-12);
  }
}

}  // namespace
}  // namespace sensory_growth::simulation
