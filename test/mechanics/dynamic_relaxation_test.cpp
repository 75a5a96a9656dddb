// Rods that relax by damped motion come to the equilibria of the statics, or say why not.

#include "sensory_growth/mechanics/dynamics.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/instruction_set.h"
#include "support/motion.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using support::allKinds;
using support::horizontal;
using support::largestDistance;
using support::order;
using support::randomRod;

struct Case {
  const char* name;
  std::function<rod::Rod()> rod;
  Loads loads;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Equilibrium : public testing::TestWithParam<Case> {};

TEST_P(Equilibrium, IsThatOfTheStatics) {
  const Case& c = GetParam();
  rod::Rod moved = c.rod();
  rod::Rod still = moved;
  const RelaxationReport report = DynamicRelaxation().relax(moved, c.loads);
  ASSERT_TRUE(report.ok()) << describe(report);
  ASSERT_TRUE(StaticEquilibrium().relax(still, c.loads).ok());
  EXPECT_LT(largestDistance(moved, still), 1e-8 * still.restLength());
  EXPECT_GT(largestDistance(c.rod(), still), 0.1 * still.restLength());
  // What is written back is consistent: the same rod follows from the strains.
  rod::Rod rebuilt = moved;
  rebuilt.rebuild();
  EXPECT_LT(largestDistance(moved, rebuilt), 1e-13 * still.restLength());
  EXPECT_EQ(kineticEnergy(moved), 0.0);
}

Loads tipForce(const Vector3& force) {
  Loads loads;
  loads.tip_force = force;
  return loads;
}

rod::Rod heavyCantilever() { return horizontal(50, support::section(0.05, 1.0, 10.0)); }

/// Leans by 0.05 rad under half again its buckling load.
rod::Rod leaningColumn() {
  return rod::straightRod({Vector3::Zero(), rod::exp({0.03, 0.04, 0.0})}, 1.0, 20,
                          support::section(0.06, 1.0, 1.5 * 7.837347439));
}

/// V8: an arc of 45 degrees and radius 100 in the horizontal plane, E A = 1e7, alpha G A = 5e6, all of B 1e7 / 12.
rod::Rod arc() {
  rod::Matrix3 directors;
  directors.col(0) = Vector3::UnitX();
  directors.col(1) = -Vector3::UnitZ();
  directors.col(2) = Vector3::UnitY();
  rod::Section section;
  section.radius = 2.0 / std::sqrt(12.0);
  section.young_modulus = 1e7 / section.area();
  section.shear_modulus = 0.5 * section.young_modulus;
  section.shear_correction = 1.0;
  section.density = 1.0;
  rod::Rod rod = rod::straightRod({Vector3::Zero(), rod::Quaternion(directors)}, 25.0 * M_PI, 16, section);
  for (rod::Bend& b : rod.bends) b.curvature = b.rest_curvature = {0.0, 0.01, 0.0};
  rod.rebuild();
  return rod;
}

rod::Rod helix() {
  rod::Rod rod = horizontal(24, support::section(0.05, 1.0, 2.0));
  for (rod::Bend& b : rod.bends) b.curvature = b.rest_curvature = {0.0, 4.0, 6.0};
  rod.rebuild();
  return rod;
}

INSTANTIATE_TEST_SUITE_P(Dynamics, Equilibrium,
                         testing::Values(Case{"heavy cantilever", heavyCantilever, support::unitGravity()},
                                         Case{"column past buckling", leaningColumn, support::unitGravity()},
                                         Case{"45 degree bend", arc, tipForce({0.0, 0.0, 600.0})},
                                         Case{"helix", helix, tipForce({1.0, -2.0, 1.5})},
                                         Case{"random rod", [] { return randomRod(3); }, allKinds()},
                                         Case{"another random rod", [] { return randomRod(4); }, allKinds()}));

TEST(DynamicRelaxation, AgreesWithThePublishedArc) {
  // Simo & Vu-Quoc 1986; V8 of model.md 18. Second order: at 16 elements the error is 16 times that of 64.
  rod::Rod rod = arc();
  ASSERT_TRUE(DynamicRelaxation().relax(rod, tipForce({0.0, 0.0, 600.0})).ok());
  EXPECT_LT((rod.vertices.back().position - Vector3(15.684801, 47.150439, 53.474859)).norm(), 16 * 1e-4 * 25.0 * M_PI);
}

TEST(DynamicRelaxation, FreezesTheFirstElementAtFirstOrder) {
  // The error that model.md 1.4 finds for the classical clamp: 1.95e-2 L at n = 50, first order.
  const auto error = [](std::size_t n) {
    rod::Section section = support::section(0.05, 1.0, 10.0);
    section.shear_correction = 1.0;
    rod::Rod rod = horizontal(n, section);
    rod.base_support = rod::BaseSupport::frozen_first_element;
    EXPECT_TRUE(DynamicRelaxation().relax(rod, support::unitGravity()).ok());
    return (rod.vertices.back().position - Vector3(0.655275835, 0.0, -0.705876094)).norm();
  };
  EXPECT_NEAR(error(25), 2.0 * 1.95e-2, 2e-3);
  EXPECT_NEAR(order(error(12), error(24)), 1.0, 0.1);
}

TEST(DynamicRelaxation, CarriesACoupleAtTheTip) {
  // V9: a body couple M2 gives a circle of curvature M2 / B, M3 a twist of M3 / 2 G I.
  rod::Rod bent = horizontal(10, support::section(0.05, 1.0, 1.0));
  rod::Rod twisted = bent;
  Loads loads;
  loads.tip_couple = {0.0, 2.0, 0.0};
  ASSERT_TRUE(DynamicRelaxation().relax(bent, loads).ok());
  for (const rod::Bend& b : bent.bends) EXPECT_LT((b.curvature - Vector3(0.0, 2.0, 0.0)).norm(), 1e-7);
  loads.tip_couple = {0.0, 0.0, 0.5};
  ASSERT_TRUE(DynamicRelaxation().relax(twisted, loads).ok());
  for (const rod::Bend& b : twisted.bends) EXPECT_LT((b.curvature - Vector3(0.0, 0.0, 0.75)).norm(), 1e-7);
}

double tipChangeByDilatation(double slenderness) {
  rod::Rod rod = horizontal(20, support::section(1.0 / slenderness, 1.0, 10.0));
  rod::Rod energetic = rod;
  EXPECT_TRUE(StaticEquilibrium().relax(energetic, support::unitGravity()).ok());
  DynamicsSettings classical;
  classical.dilatation = true;
  classical.ramp_periods = 0.0;
  const RelaxationReport report = DynamicRelaxation(classical).relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok()) << describe(report);
  return (rod.vertices.back().position - energetic.vertices.back().position).norm();
}

TEST(DynamicRelaxation, DilatationMovesTheTipByAboutTheAxialStrain) {
  EXPECT_NEAR(tipChangeByDilatation(20.0), 2.4e-3, 0.1e-3);  // model.md 1.5
  EXPECT_NEAR(tipChangeByDilatation(100.0), 9e-5, 1e-5);
}

TEST(DynamicRelaxation, AgreesBetweenInstructionSets) {
  // Any number of elements modulo the width of vectors; the classical law too.
  const rod::InstructionSet widest = rod::instructionSet();
  for (const bool dilatation : {false, true}) {
    for (std::size_t n = 1; n <= 17; ++n) {
      DynamicsSettings settings;
      settings.dilatation = dilatation;
      rod::Rod reference;
      for (const rod::InstructionSet set : rod::availableInstructionSets()) {
        rod::useInstructionSet(set);
        std::mt19937 generator(static_cast<unsigned>(n));
        rod::Rod rod = support::randomRod(generator, n);
        for (rod::Bend& b : rod.bends) b.curvature = b.rest_curvature *= 0.3;  // not beyond what one element resolves
        rod.rebuild();
        const RelaxationReport report = DynamicRelaxation(settings).advance(rod, allKinds(), 20.0 * waveTime(rod));
        ASSERT_TRUE(report.ok()) << n << " elements, " << name(set) << ": " << describe(report);
        if (reference.size() == 0) reference = rod;
        EXPECT_LT(largestDistance(rod, reference), 1e-12) << n << " elements, " << name(set);
      }
    }
  }
  rod::useInstructionSet(widest);
}

TEST(DynamicRelaxation, StaysWhereItIsInEquilibrium) {
  rod::Rod rod = horizontal(20, support::section(0.05, 1.0, 10.0));
  ASSERT_TRUE(StaticEquilibrium().relax(rod, support::unitGravity()).ok());
  const rod::Rod before = rod;
  const RelaxationReport report = DynamicRelaxation().relax(rod, support::unitGravity());
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.iterations, 0);
  EXPECT_LT(largestDistance(rod, before), 1e-15);
}

TEST(DynamicRelaxation, RampsForcesThatTheRodDoesNotCarryYet) {
  const rod::Rod unloaded = horizontal(8, support::section(0.1, 1.0, 1.0));
  rod::Rod loaded = unloaded;
  ASSERT_TRUE(StaticEquilibrium().relax(loaded, support::unitGravity()).ok());
  Loads a_little_more = support::unitGravity();
  a_little_more.gravity *= 1.001;
  const auto periods = [&](rod::Rod rod, double ramp_periods) {
    DynamicsSettings settings;
    settings.ramp_periods = ramp_periods;
    const RelaxationReport report = DynamicRelaxation(settings).relax(rod, a_little_more);
    EXPECT_TRUE(report.ok());
    return report.time * firstFrequency(rod) / (2.0 * M_PI);
  };
  EXPECT_GT(periods(unloaded, 3.0), periods(unloaded, 0.0) + 1.0);
  EXPECT_EQ(periods(loaded, 3.0), periods(loaded, 0.0));
}

/// Stem 10 cm long, 1 mm thick, 10 MPa: bent by growth with 10 / m, and its rest curvature grows by 0.1 %.
rod::Rod stemAfterAGrowthStep() {
  rod::Section section;
  section.radius = 5e-4;
  section.young_modulus = 1e7;
  section.shear_modulus = 1e7 / 3.0;
  section.density = 1000.0;
  rod::Rod rod = rod::straightRod({Vector3::Zero(), support::alongX()}, 0.1, 50, section);
  for (rod::Bend& b : rod.bends) {
    b.curvature = {0.0, 10.0, 0.0};
    b.rest_curvature = {0.0, 10.01, 0.0};
  }
  rod.rebuild();
  return rod;
}

TEST(DynamicRelaxation, TheDraftsRuleStopsBeforeTheRodHasMoved) {
  rod::Rod rod = stemAfterAGrowthStep();
  const Vector3 start = rod.vertices.back().position;
  rod::Rod equilibrium = rod;
  ASSERT_TRUE(StaticEquilibrium().relax(equilibrium, {}).ok());
  DynamicsSettings draft;
  draft.stopping = StoppingRule::rotational_energy;
  draft.rest_energy = 1e-12;
  draft.rest_steps = 500;
  const RelaxationReport report = DynamicRelaxation(draft).relax(rod, {});
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.iterations, 499);
  const double moved = (rod.vertices.back().position - start).norm();
  const double move = (equilibrium.vertices.back().position - start).norm();
  EXPECT_NEAR(moved / move, 0.007, 0.001);  // model.md 13
}

TEST(DynamicRelaxation, LeavesTheRodAloneWhenItFailsAndSaysWhy) {
  const rod::Rod before = horizontal(8, support::section(0.1, 1.0, 1.0));
  const auto fails = [&](const std::function<void(rod::Rod&, DynamicsSettings&)>& spoil) {
    rod::Rod rod = before;
    DynamicsSettings settings;
    spoil(rod, settings);
    const rod::Rod given = rod;
    const RelaxationReport moved = DynamicRelaxation(settings).advance(rod, support::unitGravity(), 1.0);
    const RelaxationReport relaxed = DynamicRelaxation(settings).relax(rod, support::unitGravity());
    EXPECT_EQ(rod.vertices.back().position, given.vertices.back().position);
    EXPECT_NE(describe(relaxed).find("time steps"), std::string::npos) << describe(relaxed);
    EXPECT_EQ(moved.reason, relaxed.reason);
    return relaxed.reason;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fails([](rod::Rod& r, DynamicsSettings&) { r.elements[3].section.inextensible = true; }),
            RelaxationReason::no_time_step);
  EXPECT_EQ(fails([](rod::Rod& r, DynamicsSettings&) { r.elements[3].section.density = 0.0; }),
            RelaxationReason::no_time_step);
  EXPECT_EQ(fails([&](rod::Rod& r, DynamicsSettings&) { r.elements[3].section.young_modulus = nan; }),
            RelaxationReason::not_finite);
  EXPECT_EQ(fails([&](rod::Rod& r, DynamicsSettings&) { r.bends[3].rest_curvature.x() = nan; }),
            RelaxationReason::not_finite);
  EXPECT_EQ(fails([&](rod::Rod& r, DynamicsSettings&) { r.elements[3].rest_length = -0.1; }),
            RelaxationReason::not_finite);
  EXPECT_EQ(fails([](rod::Rod&, DynamicsSettings& s) { s.max_periods = 0.1; }), RelaxationReason::too_many_iterations);
  EXPECT_EQ(fails([](rod::Rod&, DynamicsSettings& s) { s.time_step = 2.0; }), RelaxationReason::not_finite);
}

TEST(DynamicRelaxation, RefusesBendsThatAreNotResolved) {
  rod::Rod rod = horizontal(3, support::section(0.1, 1.0, 1.0));
  for (rod::Bend& b : rod.bends) b.rest_curvature = {0.0, 5.5, 0.0};  // 1.8 rad between neighbours
  const RelaxationReport report = DynamicRelaxation().relax(rod, {});
  EXPECT_EQ(report.reason, RelaxationReason::unresolved_bend);
  EXPECT_EQ(rod.vertices.back().position.x(), 1.0);
}

TEST(DynamicRelaxation, DoesNotTakeAnUprightColumnPastBucklingForRelaxed) {
  rod::Rod rod = rod::straightRod({}, 1.0, 8, support::section(0.1, 1.0, 9.0));
  const RelaxationReport report = DynamicRelaxation().relax(rod, support::unitGravity());
  EXPECT_EQ(report.reason, RelaxationReason::unstable);
  EXPECT_LT(report.lowest_eigenvalue.value(), 0.0);
}

TEST(DynamicRelaxation, DoesNotAskForLessThanRoundOff) {
  DynamicsSettings impossible;
  impossible.tolerance = 1e-300;
  impossible.max_periods = 20.0;
  for (const double slenderness : {10.0, 100.0}) {
    rod::Rod rod = horizontal(12, support::section(1.0 / slenderness, 1.0, 1.0));
    const RelaxationReport report = DynamicRelaxation(impossible).relax(rod, support::unitGravity());
    EXPECT_TRUE(report.ok()) << describe(report);
  }
}

/// A slender cantilever under its weight with a wall half-way down and a spring that pulls its middle sideways.
Loads softSurroundings() {
  Loads loads = support::unitGravity();
  loads.surroundings.walls.push_back({-0.3 * Vector3::UnitZ(), Vector3::UnitZ(), 100.0});
  loads.surroundings.springs.push_back({0.5, {0.5, 0.4, 0.0}, 3.0});
  return loads;
}

rod::Rod thickCantilever() {
  return rod::straightRod({Vector3::Zero(), support::alongX()}, 1.0, 20, support::section(0.05, 1.0, 8.0));
}

TEST(DynamicRelaxation, AgreesWithTheStaticsInSurroundings) {
  const Loads loads = softSurroundings();
  rod::Rod still = thickCantilever();
  ASSERT_TRUE(StaticEquilibrium().relax(still, loads).ok());
  rod::Rod moving = thickCantilever();
  const RelaxationReport report = DynamicRelaxation().relax(moving, loads);
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_LT((moving.vertices.back().position - still.vertices.back().position).norm(), 1e-8);
  EXPECT_LT((moving.vertices[10].position - still.vertices[10].position).norm(), 1e-8);
  EXPECT_LT(still.vertices.back().position.z(), -0.3);
  EXPECT_GT(still.vertices[10].position.y(), 0.01);
}

TEST(DynamicRelaxation, TakesShorterStepsBetweenStifferWalls) {
  Loads loads = softSurroundings();
  rod::Rod soft_rod = thickCantilever();
  const int soft = DynamicRelaxation().advance(soft_rod, loads, 0.1).iterations;
  loads.surroundings.walls[0].stiffness = 1e6;
  rod::Rod rod = thickCantilever();
  const RelaxationReport report = DynamicRelaxation().advance(rod, loads, 0.1);
  ASSERT_TRUE(report.ok()) << describe(report);
  EXPECT_GT(report.iterations, 2 * soft);
}

TEST(DynamicRelaxation, RefusesRigidSurroundings) {
  Loads loads = softSurroundings();
  loads.surroundings.walls[0].stiffness = std::numeric_limits<double>::infinity();
  rod::Rod rod = thickCantilever();
  EXPECT_EQ(DynamicRelaxation().relax(rod, loads).reason, RelaxationReason::no_time_step);
  loads.surroundings = {};
  loads.surroundings.held_apex = HeldApex{Vector3::UnitX(), std::nullopt};
  EXPECT_EQ(DynamicRelaxation().relax(rod, loads).reason, RelaxationReason::no_time_step);
}

}  // namespace
}  // namespace sensory_growth::mechanics
