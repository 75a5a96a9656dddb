// Stress at the surface against the beam formulas of Navier.

#include "sensory_growth/mechanics/fibre_stress.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::mechanics {
namespace {

constexpr double kRadius = 0.01;
const double kSectionModulus = M_PI * std::pow(kRadius, 3) / 4.0;
const double kArea = M_PI * kRadius * kRadius;

rod::Rod loaded(const rod::Vector3& tip_force) {
  rod::Rod rod =
      rod::straightRod({rod::Vector3::Zero(), support::alongX()}, 1.0, 40, support::section(kRadius, 1.0, 0.0));
  Loads loads;
  loads.tip_force = tip_force;
  EXPECT_TRUE(StaticEquilibrium().relax(rod, loads).ok());
  return rod;
}

TEST(FibreStress, OfACantileverIsItsMomentOverTheSectionModulus) {
  const double force = 1e-4;  // little, so that the lever arms are those of the straight rod
  const rod::Rod rod = loaded({0.0, 0.0, -force});
  for (const std::size_t bend : {1u, 10u, 30u}) {
    const double arm = 1.0 - rod.vertices[bend].position.x();
    EXPECT_NEAR(fibreStress(rod, bend), force * arm / kSectionModulus, 1e-3 * force / kSectionModulus) << bend;
  }
}

TEST(FibreStress, OfAPulledRodIsForceOverArea) {
  const rod::Rod rod = loaded({0.5, 0.0, 0.0});
  EXPECT_NEAR(fibreStress(rod, 0), 0.5 / kArea, 1e-9 * 0.5 / kArea);
  EXPECT_NEAR(fibreStress(rod, 20), 0.5 / kArea, 1e-9 * 0.5 / kArea);
}

TEST(FibreStress, IsThatOfTheThinnerNeighbour) {
  rod::Rod rod = loaded({0.0, 0.0, -1e-4});
  rod.elements[10].section.radius *= 0.5;
  const double moment = [&] {
    const auto stiffness = [&](std::size_t e) { return rod.elements[e].section.bendStiffness().x(); };
    const double harmonic = 2.0 / (1.0 / stiffness(9) + 1.0 / stiffness(10));
    return harmonic * rod.bends[10].curvature.head<2>().norm();
  }();
  const double of_stretch =
      rod.elements[10].section.young_modulus * std::abs(rod.elements[10].strain.z() - rod.elements[10].rest_strain.z());
  EXPECT_NEAR(fibreStress(rod, 10), 8.0 * moment / kSectionModulus + of_stretch, 1e-9 * moment / kSectionModulus);
}

TEST(FibreStress, ARestShapeIsFreeOfStressHoweverItIsBent) {
  rod::Rod rod =
      rod::straightRod({rod::Vector3::Zero(), support::alongX()}, 1.0, 4, support::section(kRadius, 1.0, 0.0));
  for (rod::Bend& bend : rod.bends) bend.curvature = bend.rest_curvature = {3.0, -2.0, 1.0};
  rod.rebuild();
  for (std::size_t bend = 0; bend < rod.size(); ++bend) EXPECT_EQ(fibreStress(rod, bend), 0.0);
}

}  // namespace
}  // namespace sensory_growth::mechanics
