// The identities of model.md 10.3.

#include "sensory_growth/rod/division.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include "sensory_growth/mechanics/energy.h"
#include "support/rods.h"

namespace sensory_growth::rod {
namespace {

using support::order;

std::vector<bool> only(std::size_t n, std::size_t e) {
  std::vector<bool> selected(n, false);
  selected[e] = true;
  return selected;
}

Rod divided(Rod rod, std::size_t e, DivisionMode mode) {
  divide(rod, only(rod.size(), e), mode);
  return rod;
}

double frameDistance(const Quaternion& a, const Quaternion& b) { return log(a.conjugate() * b).norm(); }

class Division : public testing::TestWithParam<DivisionMode> {
 protected:
  static constexpr std::size_t kElements = 8;

  Rod randomRod() {
    Rod rod = support::randomMovingRod(generator_, kElements);
    if (GetParam() == DivisionMode::keep_strain) rod.rebuildPositions();
    return rod;
  }

  std::mt19937 generator_{13};
};

TEST_P(Division, LeavesAllOtherFramesAlone) {
  for (std::size_t e = 0; e < kElements; ++e) {
    const Rod before = randomRod();
    const Rod after = divided(before, e, GetParam());
    ASSERT_EQ(after.size(), kElements + 1);
    for (std::size_t k = 0; k < kElements; ++k) {
      if (k == e) continue;
      EXPECT_LT(frameDistance(after.elements[k < e ? k : k + 1].frame, before.elements[k].frame), 1e-12);
    }
    EXPECT_LT(frameDistance(after.apex().frame, before.apex().frame), 1e-12);
  }
}

TEST_P(Division, CurvaturesAndFramesStayConsistent) {
  for (std::size_t e = 0; e < kElements; ++e) {
    const Rod after = divided(randomRod(), e, GetParam());
    Rod rebuilt = after;
    rebuilt.rebuild();
    for (std::size_t k = 0; k < after.size(); ++k) {
      EXPECT_LT(frameDistance(rebuilt.elements[k].frame, after.elements[k].frame), 1e-12);
      EXPECT_LT((rebuilt.vertices[k + 1].position - after.vertices[k + 1].position).norm(), 1e-12);
    }
  }
}

TEST_P(Division, ConservesLengthAndMass) {
  const Rod before = randomRod();
  Rod after = before;
  divide(after, std::vector<bool>(kElements, true), GetParam());
  EXPECT_NEAR(after.restLength(), before.restLength(), 1e-12);
  double element_mass = 0.0;
  double vertex_mass = 0.0;
  double reference = 0.0;
  double before_mass = 0.0;
  double before_reference = 0.0;
  for (const Element& e : after.elements) element_mass += e.mass(), reference += e.reference_length;
  for (std::size_t v = 0; v <= after.size(); ++v) vertex_mass += after.vertexMass(v);
  for (const Element& e : before.elements) before_mass += e.mass(), before_reference += e.reference_length;
  EXPECT_NEAR(element_mass, before_mass, 1e-12);
  EXPECT_NEAR(vertex_mass, before_mass, 1e-12);
  EXPECT_NEAR(reference, before_reference, 1e-12);
}

/// Of the vertices, that is without the turning of the elements about their middles.
Vector3 momentum(const Rod& rod) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t v = 0; v <= rod.size(); ++v) sum += rod.vertexMass(v) * rod.vertices[v].velocity;
  return sum;
}

TEST_P(Division, ConservesMomentumAndTurning) {
  for (std::size_t e = 0; e < kElements; ++e) {
    const Rod before = randomRod();
    const Rod after = divided(before, e, GetParam());
    EXPECT_LT((momentum(after) - momentum(before)).norm(), 1e-12);
    const Vector3 turning = before.elements[e].frame * before.elements[e].angular_velocity;
    for (const Element& daughter : {after.elements[e], after.elements[e + 1]}) {
      EXPECT_LT((daughter.frame * daughter.angular_velocity - turning).norm(), 1e-12);
    }
  }
}

// Fields are listed by structured bindings, which name all of them or do not compile: a new one has to come in here.

auto fields(const Section& section) {
  const auto& [radius, young_modulus, shear_modulus, density, shear_correction, inextensible] = section;
  return std::tie(radius, young_modulus, shear_modulus, density, shear_correction, inextensible);
}

/// What an element is made of, and so hands down to its daughters.
auto tissue(const Element& element) {
  const auto& [rest_length, reference_length, section, age, strain, rest_strain, frame, angular_velocity] = element;
  return std::tuple_cat(fields(section), std::tie(age, rest_strain));
}

auto fields(const Element& element) {
  const auto& [rest_length, reference_length, section, age, strain, rest_strain, frame, angular_velocity] = element;
  return std::tuple_cat(tissue(element), std::tie(rest_length, reference_length, strain, angular_velocity));
}

auto fields(const Bend& bend) {
  const auto& [curvature, rest_curvature] = bend;
  return std::tie(curvature, rest_curvature);
}

/// All but the position, which `keep_strain` moves.
auto fields(const Vertex& vertex) {
  const auto& [position, label, velocity] = vertex;
  return std::tie(label, velocity);
}

TEST_P(Division, DaughtersInheritTheTissueOfTheirParent) {
  for (std::size_t e = 0; e < kElements; ++e) {
    const Rod before = randomRod();
    const Rod after = divided(before, e, GetParam());
    const Element& parent = before.elements[e];
    for (const Element& daughter : {after.elements[e], after.elements[e + 1]}) {
      EXPECT_TRUE(tissue(daughter) == tissue(parent));
      EXPECT_EQ(daughter.rest_length, 0.5 * parent.rest_length);
      EXPECT_EQ(daughter.reference_length, 0.5 * parent.reference_length);
      if (GetParam() == DivisionMode::keep_strain) {
        EXPECT_EQ(daughter.strain, parent.strain);
      }
    }
  }
}

TEST_P(Division, LeavesEveryFieldOfTheOthersAlone) {
  for (std::size_t e = 0; e < kElements; ++e) {
    const Rod before = randomRod();
    const Rod after = divided(before, e, GetParam());
    for (std::size_t k = 0; k < kElements; ++k) {
      EXPECT_TRUE(fields(after.bends[k <= e ? k : k + 1]) == fields(before.bends[k])) << k;
      if (k != e) {
        EXPECT_TRUE(fields(after.elements[k < e ? k : k + 1]) == fields(before.elements[k])) << k;
      }
    }
    for (std::size_t v = 0; v <= kElements; ++v) {
      EXPECT_TRUE(fields(after.vertices[v <= e ? v : v + 1]) == fields(before.vertices[v])) << v;
    }
  }
}

TEST_P(Division, KeepsConstantCurvatureInAnyOrderAndForAnyLengths) {
  const Vector3 curvature(0.7, -1.9, 2.3);
  Rod rod = randomRod();
  for (Bend& b : rod.bends) b.curvature = b.rest_curvature = curvature;
  rod.rebuild();
  for (int i = 0; i < 20; ++i) {
    rod = divided(rod, std::uniform_int_distribution<std::size_t>(0, rod.size() - 1)(generator_), GetParam());
  }
  for (const Bend& b : rod.bends) {
    EXPECT_LT((b.curvature - curvature).norm(), 1e-12);
    EXPECT_LT((b.rest_curvature - curvature).norm(), 1e-12);
  }
}

TEST_P(Division, DoesNotDependOnTheOrder) {
  const Rod rod = randomRod();
  const Rod upper_first = divided(divided(rod, 3, GetParam()), 2, GetParam());
  const Rod lower_first = divided(divided(rod, 2, GetParam()), 4, GetParam());
  Rod together = rod;
  std::vector<bool> both(kElements, false);
  both[2] = both[3] = true;
  divide(together, both, GetParam());
  for (const Rod& one_by_one : {upper_first, lower_first}) {
    ASSERT_EQ(one_by_one.size(), together.size());
    for (std::size_t j = 0; j < together.size(); ++j) {
      EXPECT_TRUE(fields(one_by_one.bends[j]) == fields(together.bends[j])) << j;
      EXPECT_TRUE(tissue(one_by_one.elements[j]) == tissue(together.elements[j])) << j;
      EXPECT_TRUE(fields(one_by_one.vertices[j]) == fields(together.vertices[j])) << j;
    }
  }
}

TEST_P(Division, HalvesLabels) {
  const Rod before = randomRod();
  const Rod after = divided(before, 5, GetParam());
  EXPECT_DOUBLE_EQ(after.vertices[6].label, 0.5 * (before.vertices[5].label + before.vertices[6].label));
  EXPECT_TRUE(std::is_sorted(after.vertices.begin(), after.vertices.end(),
                             [](const Vertex& a, const Vertex& b) { return a.label < b.label; }));
}

TEST_P(Division, IsSymmetricUnderReversal) {
  // The rod read from apex to base has frames R diag(1, -1, -1) and interior curvatures (-k1, k2, k3) in reverse order.
  const auto reversed = [](const Rod& rod) {
    Rod r = rod;
    std::reverse(r.elements.begin(), r.elements.end());
    for (Element& e : r.elements) {
      e.frame = e.frame * Quaternion(0.0, 1.0, 0.0, 0.0);
      e.strain.x() *= -1.0;  // components of R (e3 + sigma) reversed: d1 keeps its sign, d2 and d3 flip
      e.rest_strain.x() *= -1.0;
      e.angular_velocity = e.angular_velocity.cwiseProduct(Vector3(1.0, -1.0, -1.0));
    }
    std::reverse(r.vertices.begin(), r.vertices.end());
    for (Vertex& v : r.vertices) v.label = 1.0 - v.label;
    for (std::size_t j = 1; j < rod.size(); ++j) {
      const Bend& source = rod.bends[rod.size() - j];
      r.bends[j].curvature = source.curvature.cwiseProduct(Vector3(-1.0, 1.0, 1.0));
      r.bends[j].rest_curvature = source.rest_curvature.cwiseProduct(Vector3(-1.0, 1.0, 1.0));
    }
    return r;
  };
  const Rod rod = randomRod();
  const Rod straight = divided(rod, 3, GetParam());
  const Rod back = reversed(divided(reversed(rod), kElements - 1 - 3, GetParam()));
  for (std::size_t e = 1; e < straight.size(); ++e) {
    EXPECT_LT((back.bends[e].curvature - straight.bends[e].curvature).norm(), 1e-12) << "bend " << e;
    EXPECT_LT((back.bends[e].rest_curvature - straight.bends[e].rest_curvature).norm(), 1e-12) << "bend " << e;
    EXPECT_LT(frameDistance(back.elements[e].frame, straight.elements[e].frame), 1e-12) << "element " << e;
    EXPECT_LT((back.elements[e].strain - straight.elements[e].strain).norm(), 1e-12) << "element " << e;
    EXPECT_TRUE(tissue(back.elements[e]) == tissue(straight.elements[e])) << "element " << e;
    EXPECT_EQ(back.elements[e].rest_length, straight.elements[e].rest_length) << "element " << e;
    EXPECT_EQ(back.elements[e].reference_length, straight.elements[e].reference_length) << "element " << e;
    EXPECT_LT((back.elements[e].angular_velocity - straight.elements[e].angular_velocity).norm(), 1e-12) << e;
    EXPECT_LT((back.vertices[e].velocity - straight.vertices[e].velocity).norm(), 1e-12) << "vertex " << e;
    EXPECT_NEAR(back.vertices[e].label, straight.vertices[e].label, 1e-12) << "vertex " << e;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, Division, testing::Values(DivisionMode::keep_strain, DivisionMode::keep_positions),
                         [](const auto& info) {
                           return info.param == DivisionMode::keep_strain ? "KeepStrain" : "KeepPositions";
                         });

TEST(KeepPositions, LeavesAllOldVerticesAlone) {
  std::mt19937 generator(17);
  const Rod before = support::randomRod(generator, 8);
  for (std::size_t e = 0; e < 8; ++e) {
    const Rod after = divided(before, e, DivisionMode::keep_positions);
    for (std::size_t v = 0; v <= 8; ++v) {
      EXPECT_EQ(after.vertices[v <= e ? v : v + 1].position, before.vertices[v].position);
    }
    // The strains of the daughters are those of the positions.
    Rod rebuilt = after;
    rebuilt.rebuildPositions();
    EXPECT_LT((rebuilt.vertices.back().position - after.vertices.back().position).norm(), 1e-14);
  }
}

/// An arc that turns by `angle` per element, unstrained.
Rod arc(double angle) {
  Rod rod = straightRod({}, 8.0, 8, support::section(0.05, 1.0, 1.0));
  for (Bend& b : rod.bends) b.curvature = b.rest_curvature = {0.0, angle, 0.0};
  rod.rebuild();
  return rod;
}

TEST(KeepPositions, StrainDefectIsAThirtySecondOfTheSquaredTurn) {
  const Rod after = divided(arc(0.17), 4, DivisionMode::keep_positions);
  EXPECT_NEAR(after.elements[4].strain.norm(), 0.17 * 0.17 / 32.0, 0.01 * 0.17 * 0.17 / 32.0);
  EXPECT_NEAR(after.elements[5].strain.norm(), 0.17 * 0.17 / 32.0, 0.01 * 0.17 * 0.17 / 32.0);
}

TEST(KeepStrain, ShiftsTheDistalPartByTheDefect) {
  const Rod before = arc(0.17);
  const Rod after = divided(before, 4, DivisionMode::keep_strain);
  EXPECT_EQ(after.elements[4].strain, Vector3::Zero());
  const Vector3 shift = after.vertices.back().position - before.vertices.back().position;
  EXPECT_NEAR(shift.norm(), 0.17 * 0.17 / 32.0, 0.01 * 0.17 * 0.17 / 32.0);
  EXPECT_LT((after.vertices[6].position - before.vertices[5].position - shift).norm(), 1e-14);
}

TEST(Division, RefinementConvergesAtSecondOrderAndDoesNotRoughen) {
  // A smooth planar curvature k(s) = sin(2 pi s), refined four times: the error against the smooth field stays put.
  const auto curvature = [](double s) { return std::sin(2.0 * M_PI * s); };
  const auto interiorError = [&](std::size_t n0, int refinements) {
    Rod rod = straightRod({}, 1.0, n0, support::section(0.05, 1.0, 1.0));
    for (std::size_t j = 0; j < n0; ++j) rod.bends[j].curvature.y() = curvature(static_cast<double>(j) / n0);
    rod.rebuild();
    for (int i = 0; i < refinements; ++i) divide(rod, std::vector<bool>(rod.size(), true), DivisionMode::keep_strain);
    double worst = 0.0;
    double s = 0.0;
    for (std::size_t j = 0; j < rod.size(); ++j) {
      if (s > 1.5 / n0 && s < 1.0 - 1.5 / n0)
        worst = std::max(worst, std::abs(rod.bends[j].curvature.y() - curvature(s)));
      s += rod.elements[j].rest_length;
    }
    return worst;
  };
  for (const std::size_t n0 : {16u, 32u, 64u}) {
    EXPECT_NEAR(interiorError(n0, 4), interiorError(n0, 1), 0.15 * interiorError(n0, 1)) << n0;
  }
  EXPECT_NEAR(order(interiorError(16, 3), interiorError(32, 3)), 2.0, 0.15);
  EXPECT_NEAR(order(interiorError(32, 3), interiorError(64, 3)), 2.0, 0.15);
}

TEST(Division, PlanarEnergyNeverRisesAndFallsByItsClosedForm) {
  std::mt19937 generator(23);
  for (std::size_t e = 1; e < 7; ++e) {
    Rod rod = straightRod({}, 1.0, 8, support::section(0.05, 1.0, 0.0));
    for (Bend& b : rod.bends) {
      b.curvature = {0.0, support::randomVector(generator, 2.0).y(), 0.0};
      b.rest_curvature = {0.0, support::randomVector(generator, 2.0).y(), 0.0};
    }
    rod.rebuild();
    const double lower = (rod.bends[e].curvature - rod.bends[e].rest_curvature).y();
    const double upper = (rod.bends[e + 1].curvature - rod.bends[e + 1].rest_curvature).y();
    const double expected = -rod.elements[e].rest_length * (upper - lower) * (upper - lower) / 16.0;
    const Bend middle = divided(rod, e, DivisionMode::keep_strain).bends[e + 1];
    EXPECT_NEAR(middle.curvature.y(), 0.5 * (rod.bends[e].curvature + rod.bends[e + 1].curvature).y(), 1e-12);
    const double before = mechanics::energy(rod, {}).bending;
    const double after = mechanics::energy(divided(rod, e, DivisionMode::keep_strain), {}).bending;
    EXPECT_NEAR(after - before, expected, 1e-12);
  }
}

TEST(FrozenFirstElement, DaughtersShareTheTurnAboveIt) {
  Rod rod = straightRod({}, 1.0, 4, support::section(0.05, 1.0, 1.0));
  rod.base_support = BaseSupport::frozen_first_element;
  for (std::size_t j = 1; j < 4; ++j) rod.bends[j].curvature = rod.bends[j].rest_curvature = {0.3, 0.8, -0.2};
  rod.rebuild();
  const Rod before = rod;
  divide(rod, {true, false, false, false}, DivisionMode::keep_strain);
  EXPECT_EQ(rod.elements[0].frame.coeffs(), rod.base.frame.coeffs());
  // D / (D + l / 4) with D = l.
  EXPECT_LT((rod.bends[1].curvature - 0.8 * before.bends[1].curvature).norm(), 1e-15);
  EXPECT_LT((rod.bends[2].rest_curvature - 0.8 * before.bends[1].rest_curvature).norm(), 1e-15);
  EXPECT_LT(rod.elements[2].frame.angularDistance(before.elements[1].frame), 1e-14);
  rod.rebuild();
  EXPECT_LT(rod.elements[4].frame.angularDistance(before.elements[3].frame), 1e-14);
}

TEST(HingedBase, KeepsItsFreeTurnThroughDivision) {
  Rod rod = straightRod({}, 1.0, 3, support::section(0.05, 1.0, 1.0));
  rod.base_support = BaseSupport::hinged;
  rod.bends[0].curvature = {0.0, 5.0, 0.0};
  for (std::size_t j = 1; j < 3; ++j) rod.bends[j].curvature = {0.0, 0.7, 0.0};
  rod.rebuild();
  const Rod before = rod;
  divide(rod, {true, false, true}, DivisionMode::keep_strain);
  for (std::size_t j = 1; j < rod.size(); ++j) EXPECT_NEAR(rod.bends[j].curvature.y(), 0.7, 1e-14);
  const Rod divided = rod;
  rod.rebuild();
  for (std::size_t e = 0; e < rod.size(); ++e) {
    EXPECT_LT(rod.elements[e].frame.angularDistance(divided.elements[e].frame), 1e-14);
  }
  EXPECT_LT(rod.elements[2].frame.angularDistance(before.elements[1].frame), 1e-14);
}

TEST(DivideLongElements, DividesUntilNoneIsTooLong) {
  Rod rod = straightRod({}, 1.0, 3, support::section(0.05, 1.0, 1.0));
  EXPECT_EQ(divideLongElements(rod, 0.1, DivisionMode::keep_strain), 9u);  // 3 to 6 to 12 elements of 1/12
  EXPECT_EQ(rod.size(), 12u);
  EXPECT_EQ(divideLongElements(rod, 0.1, DivisionMode::keep_strain), 0u);
  EXPECT_THROW(divideLongElements(rod, 0.0, DivisionMode::keep_strain), std::invalid_argument);
}

}  // namespace
}  // namespace sensory_growth::rod
