// Aging: sections that follow age, and the rest state that takes over what compliance loses (model.md 9, V24).

#include "sensory_growth/growth/aging.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

using rod::Vector3;

Aging stiffening(double mature_modulus) {
  Aging aging;
  aging.young_modulus = Maturation{mature_modulus, 2.0};
  return aging;
}

Aging thickening(double mature_radius) {
  Aging aging;
  aging.radius = Maturation{mature_radius, 2.0};
  return aging;
}

TEST(AgedSection, ApproachesTheMatureValues) {
  const rod::Section young = support::section(0.1, 1.0, 1.0);
  Aging aging = stiffening(3.0 * young.young_modulus);
  aging.radius = Maturation{0.2, 4.0};
  EXPECT_EQ(agedSection(aging, young, 0.0).young_modulus, young.young_modulus);
  EXPECT_EQ(agedSection(aging, young, 0.0).radius, 0.1);

  const rod::Section old = agedSection(aging, young, 3.0);
  EXPECT_NEAR(old.young_modulus / young.young_modulus, 3.0 - 2.0 * std::exp(-1.5), 1e-14);
  EXPECT_NEAR(old.shear_modulus / young.shear_modulus, 3.0 - 2.0 * std::exp(-1.5), 1e-14);
  EXPECT_NEAR(old.radius, 0.2 - 0.1 * std::exp(-0.75), 1e-15);
  EXPECT_EQ(old.density, young.density);
  EXPECT_NEAR(agedSection(aging, young, 1e3).radius, 0.2, 1e-15);
}

TEST(GrowOlder, CountsTheTimeThatIsNotSpentGrowing) {
  const rod::Rod before = rod::straightRod({}, 1.0, 3, support::section(0.1, 1.0, 1.0));
  GrowthStrain strain;
  strain.elements = {0.0, 0.5, 3.0};  // of at most 2, in 4 s at a rate of 0.5 1/s
  const auto ages = [&](AgingClock clock, double fastest_rate) {
    Aging aging = thickening(0.2);
    aging.clock = clock;
    rod::Rod rod = before;
    growOlder(rod, before, aging, before.elements[0].section, strain, fastest_rate, 4.0);
    EXPECT_EQ(rod.elements[0].section.radius, agedSection(aging, before.elements[0].section, 4.0).radius);
    return Vector3(rod.elements[0].age, rod.elements[1].age, rod.elements[2].age);
  };
  EXPECT_EQ(ages(AgingClock::maturation, 0.5), Vector3(4.0, 3.0, 0.0));
  EXPECT_EQ(ages(AgingClock::time, 0.5), Vector3(4.0, 4.0, 4.0));
  EXPECT_EQ(ages(AgingClock::maturation, 0.0), Vector3(4.0, 4.0, 4.0));  // tissue that never grows is mature
}

TEST(GrowOlder, MassFollowsTheRadius) {
  const rod::Rod before = rod::straightRod({}, 1.0, 3, support::section(0.1, 1.0, 7.0));
  GrowthStrain strain;
  strain.elements.assign(3, 0.0);
  rod::Rod rod = before;
  growOlder(rod, before, thickening(0.2), before.elements[0].section, strain, 1.0, 1e3);
  EXPECT_NEAR(rod.elements[1].mass(), 4.0 * 7.0 / 3.0, 1e-12);
}

/// A random rod that has taken stiffer and thicker sections, each element its own.
rod::Rod withOldSections(const rod::Rod& before, double stiffer) {
  rod::Rod rod = before;
  for (std::size_t e = 0; e < rod.size(); ++e) {
    rod::Section& section = rod.elements[e].section;
    const double factor = std::pow(stiffer, 1.0 + 6.0 * static_cast<double>(e) / static_cast<double>(rod.size()));
    section.young_modulus *= factor;
    section.shear_modulus *= factor;
    section.radius *= 1.0 + 0.1 * (factor - 1.0);
  }
  return rod;
}

Deposition predictedDeposition(rod::Rod& rod, const rod::Rod& before) {
  Deposition deposition;
  deposition.begin(rod.size());
  deposition.predict(rod, before);
  return deposition;
}

TEST(Deposition, MixesTheRestStateWithTheShapeAtHand) {
  std::mt19937 generator(21);
  const rod::Rod before = support::randomRod(generator, 10);
  rod::Rod rod = withOldSections(before, 1.5);
  predictedDeposition(rod, before);
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const Vector3 old_b = mechanics::bendStiffness(before, j);
    const Vector3 new_b = mechanics::bendStiffness(rod, j);
    const Vector3 mixed =
        (old_b.cwiseProduct(before.bends[j].rest_curvature) + (new_b - old_b).cwiseProduct(before.bends[j].curvature))
            .cwiseQuotient(new_b);
    EXPECT_LT((rod.bends[j].rest_curvature - mixed).norm(), 1e-13);

    const Vector3 old_s = before.elements[j].section.stretchCompliance().cwiseInverse();
    const Vector3 new_s = rod.elements[j].section.stretchCompliance().cwiseInverse();
    const Vector3 mixed_strain =
        (old_s.cwiseProduct(before.elements[j].rest_strain) + (new_s - old_s).cwiseProduct(before.elements[j].strain))
            .cwiseQuotient(new_s);
    EXPECT_LT((rod.elements[j].rest_strain - mixed_strain).norm(), 1e-15);
    EXPECT_EQ(rod.elements[j].strain, before.elements[j].strain);
    EXPECT_EQ(rod.elements[j].frame.coeffs(), before.elements[j].frame.coeffs());
  }
}

TEST(Deposition, LeavesTheRestStateWhereTissueSoftens) {
  std::mt19937 generator(22);
  const rod::Rod before = support::randomRod(generator, 10);
  rod::Rod rod = withOldSections(before, 0.8);
  Deposition deposition = predictedDeposition(rod, before);
  deposition.correct(rod, before);
  for (std::size_t j = 0; j < rod.size(); ++j) {
    EXPECT_EQ(rod.bends[j].rest_curvature, before.bends[j].rest_curvature);
    EXPECT_EQ(rod.elements[j].rest_strain, before.elements[j].rest_strain);
  }
}

TEST(Deposition, OfACorrectedStepTakesTheMeanMoment) {
  // Moment m0 at the start and m1 at the end; the compliance falls from 1 to 1/4.
  rod::Rod before = rod::straightRod({}, 1.0, 1, support::section(0.1, 1.0, 1.0));
  before.bends[0].curvature = {0.6, 0.0, 0.0};
  rod::Rod rod = before;
  rod.elements[0].section.young_modulus *= 4.0;
  Deposition deposition = predictedDeposition(rod, before);
  EXPECT_NEAR(rod.bends[0].rest_curvature.x(), 0.75 * 0.6, 1e-14);
  rod.bends[0].curvature.x() = 0.45 + 0.25 * 1.0;  // where a moment of 1 holds it
  deposition.correct(rod, before);
  EXPECT_NEAR(rod.bends[0].rest_curvature.x(), 0.75 * 0.5 * (0.6 + 1.0), 1e-14);
}

/// V24: a cantilever bent by a force at its tip, in equilibrium.
class LoadedCantilever : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { load(60, 0.0); }

  void load(std::size_t elements, double tip_couple) {
    rod::Section section = support::section(0.1, 1.0, 1.0);
    section.inextensible = GetParam();
    rod_ = rod::straightRod({{0.0, 0.0, 0.0}, support::alongX()}, 1.0, elements, section);
    for (rod::Bend& bend : rod_.bends) bend.rest_curvature = bend.curvature = {0.3, -0.2, 0.5};
    rod_.rebuild();
    loads_.tip_force = {0.4, 0.5, -3.0};
    loads_.tip_couple = {0.0, 0.0, tip_couple};
    EXPECT_TRUE(equilibrium_.relax(rod_, loads_).ok());
  }

  /// Largest way of a vertex when the rod has aged and relaxed again.
  double motion(double stiffer, bool deposits) {
    rod::Rod rod = withOldSections(rod_, stiffer);
    if (deposits) predictedDeposition(rod, rod_);
    EXPECT_TRUE(equilibrium_.relax(rod, loads_).ok());
    double largest = 0.0;
    for (std::size_t v = 0; v < rod.vertices.size(); ++v) {
      largest = std::max(largest, (rod.vertices[v].position - rod_.vertices[v].position).norm());
    }
    return largest;
  }

  mechanics::StaticEquilibrium equilibrium_;
  mechanics::Loads loads_;
  rod::Rod rod_;
};

TEST_P(LoadedCantilever, DoesNotMoveWhenItStiffensFreeOfStress) {
  EXPECT_LT(motion(1.6, true), 1e-12);
  EXPECT_GT(motion(1.6, false), 0.1);  // it would spring back against its load
}

TEST_P(LoadedCantilever, CarriesABodyCoupleAlikeToSecondOrder) {
  // The couple acts half a cell beyond the last element, which sees it turned by the curvature of that half cell.
  load(60, 0.2);
  const double coarse = motion(1.6, true);
  load(120, 0.2);
  const double fine = motion(1.6, true);
  EXPECT_LT(coarse, 5e-6);
  EXPECT_NEAR(support::order(coarse, fine), 2.0, 0.1);
}

TEST_P(LoadedCantilever, GivesWayWhenItSoftens) { EXPECT_GT(motion(0.9, true), 0.01); }

INSTANTIATE_TEST_SUITE_P(Inextensible, LoadedCantilever, testing::Bool());

}  // namespace
}  // namespace sensory_growth::growth
