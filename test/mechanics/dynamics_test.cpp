// Motion of a rod: against the statics, against closed forms of vibrating rods, and the laws of motion themselves.

#include "sensory_growth/mechanics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include "kernels/motion_formulas.h"
#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/division.h"
#include "sensory_growth/rod/instruction_set.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using support::order;

rod::Rod horizontal(std::size_t elements, const rod::Section& section) {
  return rod::straightRod({Vector3::Zero(), support::alongX()}, 1.0, elements, section);
}

DynamicsSettings undamped() {
  DynamicsSettings settings;
  settings.damping = 0.0;
  return settings;
}

double largestDistance(const rod::Rod& a, const rod::Rod& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v <= a.size(); ++v) {
    largest = std::max(largest, (a.vertices[v].position - b.vertices[v].position).norm());
  }
  return largest;
}

// ---------------------------------------------------------------------------------------------------------------------
// Formulas

double first(const kernels::Lanes& lanes) {
  alignas(64) double lane[kernels::Lanes::size];
  kernels::store(lanes, lane);
  return lane[0];
}
Vector3 toVector(const kernels::Vector& a) { return {first(a[0]), first(a[1]), first(a[2])}; }
kernels::Vector toLanes(const Vector3& a) { return {kernels::Lanes(a[0]), kernels::Lanes(a[1]), kernels::Lanes(a[2])}; }
kernels::Quaternion toLanes(const rod::Quaternion& q) { return {kernels::Lanes(q.w()), toLanes(Vector3(q.vec()))}; }

TEST(MotionFormulas, CouplesOfABendAreThoseOfTheStatics) {
  std::mt19937 generator(1);
  for (const double angle : {0.0, 1e-12, 1e-8, 1e-4, 1e-2, 0.3, 1.0, 1.57, 2.2}) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 theta = angle * support::randomVector(generator, 1.0).normalized();
      const Vector3 rest = support::randomVector(generator, 1.0);
      const Vector3 stiffness(2.0, 3.0, 5.0);
      const rod::Quaternion below = rod::exp(support::randomVector(generator, 1.5));
      const kernels::Quaternion turn = kernels::between(toLanes(below), toLanes(below * rod::exp(theta)));
      const auto couples = kernels::bendCouples(turn, kernels::Lanes(4.0), toLanes(rest), toLanes(stiffness));
      const Vector3 m = stiffness.cwiseProduct(4.0 * theta - rest);
      EXPECT_LT((toVector(couples.upper) - rod::leftJacobianInverse(theta) * m).norm(), 1e-14 * (10.0 + m.norm()));
      EXPECT_LT((toVector(couples.lower) - rod::leftJacobianInverse(-theta) * m).norm(), 1e-14 * (10.0 + m.norm()));
    }
  }
}

TEST(MotionFormulas, TurnFramesByTheExponential) {
  std::mt19937 generator(2);
  for (const double angle : {0.0, 1e-9, 1e-3, 0.05, 0.2}) {
    const Vector3 theta = angle * support::randomVector(generator, 1.0).normalized();
    const rod::Quaternion before = rod::exp(support::randomVector(generator, 1.5));
    const kernels::Quaternion turned = kernels::turnedLittle(toLanes(before), toLanes(theta));
    rod::Quaternion after;
    after.w() = first(turned.w);
    after.vec() = toVector(turned.v);
    EXPECT_LT((after.coeffs() - (before * rod::exp(theta)).coeffs()).norm(), 1e-15);
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// The same equilibria as the statics

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

rod::Rod randomRod(unsigned seed) {
  std::mt19937 generator(seed);
  return support::randomRod(generator, 12);
}

Loads allKinds() {
  Loads loads;
  loads.gravity = {0.5, -0.3, -1.0};
  loads.line_force = {0.0, 0.4, 0.2};
  loads.tip_force = {0.3, 0.5, -0.4};
  return loads;
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

// ---------------------------------------------------------------------------------------------------------------------
// Stopping

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

// ---------------------------------------------------------------------------------------------------------------------
// Vibrations

/// Longitudinal vibration of a straight rod, released with the velocities of mode m of its chain: displacements of the
/// tip after every step.
std::vector<double> tipOfLongitudinalWave(std::size_t elements, int mode, double dt, double damping, int steps) {
  rod::Rod rod = horizontal(elements, support::section(0.2, 1.0, 1.0));
  const double speed = std::sqrt(rod.elements[0].section.young_modulus / rod.elements[0].section.density);
  const double wave_number = (mode - 0.5) * M_PI / static_cast<double>(elements);
  for (std::size_t v = 0; v <= elements; ++v) {
    rod.vertices[v].velocity.x() = 1e-3 * speed * std::sin(wave_number * static_cast<double>(v));
  }
  DynamicsSettings settings;
  settings.damping = damping;
  settings.time_step = 1.0;
  DynamicRelaxation dynamics(settings);
  std::vector<double> tip = {0.0};
  for (int i = 0; i < steps; ++i) {
    EXPECT_EQ(dynamics.advance(rod, {}, dt).iterations, 1);
    tip.push_back(rod.vertices.back().position.x() - 1.0);
  }
  return tip;
}

TEST(LongitudinalWave, HasTheFrequencyOfTheChainInVerletsTime) {
  // The chain of n springs: w = 2 c / h sin((m - 1/2) pi / 2 n). Verlet: sin(w' dt / 2) = w dt / 2, so that samples
  // obey x(i + 1) + x(i - 1) = 2 cos(w' dt) x(i).
  const std::size_t n = 8;
  const double speed =
      std::sqrt(support::section(0.2, 1.0, 1.0).young_modulus / support::section(0.2, 1.0, 1.0).density);
  const double h = 1.0 / n;
  const double dt = 0.3 * h / speed;
  for (const int mode : {1, 2, 5}) {
    const double w = 2.0 * speed / h * std::sin((mode - 0.5) * M_PI / (2.0 * n));
    const double turn = 2.0 * std::asin(0.5 * w * dt);
    const std::vector<double> x = tipOfLongitudinalWave(n, mode, dt, 0.0, 40);
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
      EXPECT_NEAR(x[i + 1] + x[i - 1], 2.0 * std::cos(turn) * x[i], 1e-14);
    }
  }
}

TEST(LongitudinalWave, IsSecondOrderInTimeAndSpace) {
  // pi c / 2 L is the first frequency of the rod.
  const rod::Section section = support::section(0.2, 1.0, 1.0);
  const double exact = 0.5 * M_PI * std::sqrt(section.young_modulus / section.density);
  const auto error = [&](std::size_t n, double courant) {
    const double dt = courant / (static_cast<double>(n) * std::sqrt(section.young_modulus / section.density));
    const std::vector<double> x = tipOfLongitudinalWave(n, 1, dt, 0.0, 5);
    return std::acos(0.5 * (x[5] + x[3]) / x[4]) / dt - exact;
  };
  EXPECT_NEAR(order(error(4, 0.2), error(8, 0.2)), 2.0, 0.05);
  // In time: the difference to ever shorter steps.
  const double a = error(4, 0.4) - error(4, 0.2), b = error(4, 0.2) - error(4, 0.1);
  EXPECT_NEAR(order(a, b), 2.0, 0.05);
}

TEST(LongitudinalWave, DecaysByHalfTheDampingRate) {
  // Any damped oscillator: (x(i+1) x(i-1) - x(i)^2) / (x(i) x(i-2) - x(i-1)^2) = exp(-c dt), the square of the decay of
  // its amplitude.
  const rod::Section section = support::section(0.2, 1.0, 1.0);
  const double speed = std::sqrt(section.young_modulus / section.density);
  const double dt = 0.3 / (8.0 * speed);
  const double damping = 0.5 * speed;
  const std::vector<double> x = tipOfLongitudinalWave(8, 1, dt, damping, 30);
  for (std::size_t i = 2; i + 1 < x.size(); ++i) {
    const double ratio = (x[i + 1] * x[i - 1] - x[i] * x[i]) / (x[i] * x[i - 2] - x[i - 1] * x[i - 1]);
    EXPECT_NEAR(ratio, std::exp(-damping * dt), 1e-8);
  }
}

/// Shape of the first mode of a clamped Euler-Bernoulli beam of length 1.
double firstMode(double s) {
  const double k = 1.875104069, a = 0.734095514;
  return std::cosh(k * s) - std::cos(k * s) - a * (std::sinh(k * s) - std::sin(k * s));
}

/// First bending frequency times L^2 sqrt(rho A / E I), from the time in which an undamped cantilever released in its
/// first mode swings through.
double cantileverFrequency(std::size_t elements, double slenderness) {
  const rod::Section section = support::section(1.0 / slenderness, 1.0, 1.0);
  rod::Rod rod = horizontal(elements, section);
  const double h = 1.0 / static_cast<double>(elements);
  const double amplitude = 1e-5;
  // Frames along the chords, as without shear.
  rod::Quaternion below = rod.base.frame;
  for (std::size_t e = 0; e < elements; ++e) {
    const double s = static_cast<double>(e) * h;
    const double slope = amplitude * (firstMode(s + h) - firstMode(s)) / h;
    const rod::Quaternion frame = rod.base.frame * rod::exp({0.0, slope, 0.0});
    rod.bends[e].curvature = rod::log(below.conjugate() * frame) / rod.voronoiLength(e);
    below = frame;
  }
  rod.rebuild();
  const auto coordinate = [&] {
    double sum = 0.0;
    for (std::size_t v = 0; v <= elements; ++v) {
      sum += rod.vertexMass(v) * firstMode(static_cast<double>(v) * h) * rod.vertices[v].position.z();
    }
    return sum;
  };
  DynamicRelaxation dynamics(undamped());
  const double interval = 2.0 * M_PI / 3.516 / 200.0;
  double before = coordinate();
  for (int i = 1; i < 100; ++i) {
    EXPECT_TRUE(dynamics.advance(rod, {}, interval).ok());
    const double now = coordinate();
    if (now <= 0.0) return 0.5 * M_PI / (interval * (i - 1 + before / (before - now)));
    before = now;
  }
  return 0.0;
}

TEST(Cantilever, SwingsWithItsFirstBendingFrequency) {
  // Extrapolated to short elements; what shear and rotary inertia slow it down by at L / R = 100 is less than 5e-4.
  const double coarse = cantileverFrequency(12, 100.0), fine = cantileverFrequency(24, 100.0);
  EXPECT_NEAR((fine + (fine - coarse) / 3.0) / 3.5160153, 1.0, 5e-4);
}

TEST(Cantilever, SwingsWithSecondOrderInSpace) {
  const double coarse = cantileverFrequency(6, 20.0), middle = cantileverFrequency(12, 20.0),
               fine = cantileverFrequency(24, 20.0);
  EXPECT_NEAR(order(coarse - middle, middle - fine), 2.0, 0.2);
}

TEST(Cantilever, SwingsToAboutTwiceItsDeflectionUnderASuddenLoad) {
  rod::Rod rod = horizontal(8, support::section(0.1, 1.0, 0.1));
  DynamicRelaxation dynamics(undamped());
  const double half_period = M_PI / firstFrequency(rod);
  double largest = 0.0;
  for (int i = 0; i < 150; ++i) {
    EXPECT_TRUE(dynamics.advance(rod, support::unitGravity(), half_period / 100.0).ok());
    largest = std::max(largest, -rod.vertices.back().position.z());
  }
  // w L^4 / 8 B, and what shear adds to it: w L^2 / 2 alpha G A.
  const double shear = 0.05 * support::section(0.1, 1.0, 0.1).stretchCompliance().x();
  EXPECT_NEAR(largest / (0.1 / 8.0 + shear), 2.0, 0.1);
}

TEST(FirstFrequency, IsThatOfTheBeamAndTakesAnyDistribution) {
  EXPECT_NEAR(firstFrequency(horizontal(200, support::section(0.01, 1.0, 1.0))), 3.5160153, 0.005 * 3.516);
  // A stiff light half under a soft heavy one swings more slowly than the uniform rod; a massless tip changes nothing.
  // Rayleigh for a light beam with a mass at its end: w^2 = 3 B / (m L^3).
  rod::Rod loaded = horizontal(200, support::section(0.01, 1.0, 1e-9));
  loaded.elements.back().section.density =
      1.0 / (loaded.elements.back().section.area() * loaded.elements.back().rest_length);
  EXPECT_NEAR(firstFrequency(loaded), std::sqrt(3.0), 0.01 * std::sqrt(3.0));
}

TEST(HingedRod, SwingsAsACompoundPendulum) {
  // w^2 = m g L / 2 over the moment of inertia of the stiff chain: m (1/3 + 1/(6 n^2)) L^2 of the vertices and m R^2 /
  // 4 of the elements.
  const std::size_t n = 4;
  const double radius = 0.1, tilt = 1e-3;
  rod::Rod rod =
      rod::straightRod({Vector3::Zero(), rod::exp({M_PI, 0.0, 0.0})}, 1.0, n, support::section(radius, 1000.0, 1.0));
  rod.base_support = rod::BaseSupport::hinged;
  rod.bends[0].curvature.y() = tilt / rod.voronoiLength(0);
  rod.rebuild();
  const double start = rod.vertices.back().position.x();
  const double w = std::sqrt(0.5 / (1.0 / 3.0 + 1.0 / (6.0 * n * n) + radius * radius / 4.0));
  DynamicsSettings settings = undamped();
  settings.max_periods = 1e6;
  DynamicRelaxation dynamics(settings);
  for (int i = 1; i <= 8; ++i) {
    ASSERT_TRUE(dynamics.advance(rod, support::unitGravity(), 0.5).ok());
    EXPECT_NEAR(rod.vertices.back().position.x() / start, std::cos(0.5 * i * w), 2e-3);
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Laws of motion

/// A moving rod with everything random, and an undamped way to move it.
rod::Rod spinningRod() {
  std::mt19937 generator(8);
  rod::Rod rod = support::randomRod(generator, 8);
  for (rod::Element& e : rod.elements) e.angular_velocity = support::randomVector(generator, 20.0);
  for (std::size_t v = 1; v < rod.vertices.size(); ++v)
    rod.vertices[v].velocity = support::randomVector(generator, 1.0);
  return rod;
}

/// Largest change of `invariant` over the time 0.2, sampled at the end of each step.
double largestChange(const rod::Rod& start, const Loads& loads, double time_step,
                     const std::function<double(const rod::Rod&)>& invariant) {
  DynamicsSettings settings = undamped();
  settings.time_step = time_step;
  DynamicRelaxation dynamics(settings);
  rod::Rod rod = start;
  const double dt = time_step * waveTime(rod);
  double largest = 0.0;
  for (int i = 0; i * dt < 0.2; ++i) {
    EXPECT_TRUE(dynamics.advance(rod, loads, dt).ok());
    largest = std::max(largest, std::abs(invariant(rod) - invariant(start)));
  }
  return largest;
}

TEST(Motion, KeepsItsEnergyToSecondOrderInTheTimeStep) {
  const rod::Rod rod = spinningRod();
  const Loads loads = allKinds();
  const auto total = [&](const rod::Rod& r) { return energy(r, loads).total() + kineticEnergy(r); };
  const double coarse = largestChange(rod, loads, 0.08, total), fine = largestChange(rod, loads, 0.04, total);
  EXPECT_NEAR(order(coarse, fine), 2.0, 0.15);
  EXPECT_LT(fine, 1e-2 * kineticEnergy(rod));
}

TEST(Motion, KeepsAngularMomentumAboutAHingeToSecondOrder) {
  rod::Rod rod = spinningRod();
  rod.base.position.setZero();
  rod.base_support = rod::BaseSupport::hinged;
  rod.rebuild();
  const auto along = [&](int axis) {
    return [axis](const rod::Rod& r) {
      Vector3 sum = Vector3::Zero();
      for (std::size_t v = 0; v <= r.size(); ++v) {
        sum += r.vertexMass(v) * r.vertices[v].position.cross(r.vertices[v].velocity);
      }
      for (const rod::Element& e : r.elements) {
        const double inertia = e.section.density * e.rest_length * e.section.secondMoment();
        sum += e.frame * (inertia * e.angular_velocity.cwiseProduct(Vector3(1.0, 1.0, 2.0)));
      }
      return sum[axis];
    };
  };
  for (const int axis : {0, 1, 2}) {
    const double coarse = largestChange(rod, {}, 0.08, along(axis)), fine = largestChange(rod, {}, 0.04, along(axis));
    EXPECT_NEAR(order(coarse, fine), 2.0, 0.15);
  }
}

TEST(Motion, CanBeReversed) {
  const rod::Rod start = spinningRod();
  rod::Rod rod = start;
  DynamicRelaxation dynamics(undamped());
  const auto run = [&] { ASSERT_TRUE(dynamics.advance(rod, allKinds(), 300 * 0.3 * waveTime(rod)).ok()); };
  run();
  EXPECT_GT(largestDistance(rod, start), 0.05);
  for (rod::Element& e : rod.elements) e.angular_velocity *= -1.0;
  for (rod::Vertex& v : rod.vertices) v.velocity *= -1.0;
  run();
  EXPECT_LT(largestDistance(rod, start), 1e-9);
}

TEST(Motion, DoesNotDependOnHowTimeIsCut) {
  rod::Rod whole = spinningRod();
  rod::Rod cut = whole;
  DynamicRelaxation dynamics(undamped());
  const double dt = 0.3 * waveTime(whole);
  ASSERT_TRUE(dynamics.advance(whole, allKinds(), 60 * dt).ok());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(dynamics.advance(cut, allKinds(), 3 * dt).ok());
  EXPECT_LT(largestDistance(whole, cut), 1e-11);
}

/// Growth of the shortest vibration of a uniform straight rod, in which neighbours move against each other, over 400
/// steps of `dt`.
double growthOfShortestVibration(double dt) {
  rod::Rod rod = horizontal(12, support::section(0.1, 1.0, 1.0));
  for (std::size_t v = 1; v <= rod.size(); ++v) rod.vertices[v].velocity.y() = v % 2 == 0 ? 1e-8 : -1e-8;
  const double before = kineticEnergy(rod);
  DynamicsSettings settings = undamped();
  settings.time_step = 1.0;
  DynamicRelaxation dynamics(settings);
  double largest = 0.0;
  for (int i = 0; i < 400; ++i) {
    if (!dynamics.advance(rod, {}, dt).ok()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, kineticEnergy(rod));
  }
  return largest / before;
}

TEST(Motion, IsStableUpToTheLimitOfTheShortestVibration) {
  // With displacements u and turns a of alternating sign, K = [4 S / h, 2 S; 2 S, S h + 4 B / h] and
  // M = [m, 0; 0, J] per cell, S = alpha G A; Verlet is stable for dt < 2 / w.
  const rod::Section s = support::section(0.1, 1.0, 1.0);
  const double h = 1.0 / 12.0;
  const double S = s.shear_correction * s.shear_modulus * s.area();
  Eigen::Matrix2d K;
  K << 4.0 * S / h, 2.0 * S, 2.0 * S, S * h + 4.0 * s.bendStiffness().x() / h;
  const Eigen::Vector2d m(s.lineDensity() * h, s.density * h * s.secondMoment());
  const Eigen::Matrix2d scaled =
      m.cwiseSqrt().cwiseInverse().asDiagonal() * K * m.cwiseSqrt().cwiseInverse().asDiagonal();
  const double fastest = std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scaled).eigenvalues().maxCoeff());
  EXPECT_LT(growthOfShortestVibration(0.97 * 2.0 / fastest), 100.0);
  EXPECT_GT(growthOfShortestVibration(1.03 * 2.0 / fastest), 1e6);
  // The default is on the safe side of it.
  EXPECT_LT(DynamicsSettings().time_step * waveTime(horizontal(12, s)), 0.6 * 2.0 / fastest);
}

TEST(Division, KeepsTheMotion) {
  for (const rod::DivisionMode mode : {rod::DivisionMode::keep_strain, rod::DivisionMode::keep_positions}) {
    rod::Rod rod = spinningRod();
    rod.base_support = rod::BaseSupport::hinged;
    const rod::Rod before = rod;
    rod::divide(rod, std::vector<bool>{true, false, false, true, true, false, false, true}, mode);
    const auto momentum = [](const rod::Rod& r) {
      Vector3 sum = Vector3::Zero();
      for (std::size_t v = 0; v <= r.size(); ++v) sum += r.vertexMass(v) * r.vertices[v].velocity;
      return sum;
    };
    EXPECT_LT((momentum(rod) - momentum(before)).norm(), 1e-14);
    const Vector3 turning = before.elements[3].frame * before.elements[3].angular_velocity;
    EXPECT_LT((rod.elements[4].frame * rod.elements[4].angular_velocity - turning).norm(), 1e-13);
    EXPECT_LT((rod.elements[5].frame * rod.elements[5].angular_velocity - turning).norm(), 1e-13);
    EXPECT_EQ(rod.base_support, rod::BaseSupport::hinged);
  }
}

// ---------------------------------------------------------------------------------------------------------------------
// Refusals

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
