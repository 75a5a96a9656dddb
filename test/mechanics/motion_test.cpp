// Motion of a rod: against closed forms of vibrating rods, and the laws of motion themselves.

#include "sensory_growth/mechanics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/rod/division.h"
#include "support/motion.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using support::allKinds;
using support::horizontal;
using support::largestDistance;
using support::order;
using support::undamped;

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

}  // namespace
}  // namespace sensory_growth::mechanics
