// Sensors, receivers and spread on rods of uneven elements.

#include "sensory_growth/growth/sensing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sensory_growth/rod/division.h"
#include "support/rods.h"

namespace sensory_growth::growth {
namespace {

using support::order;

/// A straight rod of length 1 whose elements have the given lengths in proportion; labels are those of equal elements.
rod::Rod rodOf(const std::vector<double>& lengths) {
  rod::Rod rod = rod::straightRod({}, 1.0, lengths.size(), support::section(0.05, 1.0, 0.0));
  double sum = 0.0;
  for (const double length : lengths) sum += length;
  for (std::size_t e = 0; e < lengths.size(); ++e) rod.elements[e].rest_length = lengths[e] / sum;
  rod.rebuild();
  return rod;
}

/// The same with elements between 1 and 2 in proportion, reproducible.
rod::Rod unevenRod(std::size_t n) {
  std::vector<double> lengths;
  for (std::size_t e = 0; e < n; ++e) lengths.push_back(1.5 + 0.5 * std::sin(7.0 * static_cast<double>(e) / n));
  return rodOf(lengths);
}

/// f(s) at every vertex, and its double in the second component.
template <typename Function>
SectionField fieldOf(const rod::Rod& rod, const Function& f) {
  SectionField field;
  double s = 0.0;
  for (std::size_t v = 0; v < rod.vertices.size(); ++v) {
    field.push_back({f(s), 2.0 * f(s)});
    if (v < rod.size()) s += rod.elements[v].rest_length;
  }
  return field;
}

TEST(Sensor, ReadsBetweenVerticesAndStopsAtTheEnds) {
  const rod::Rod rod = rodOf({1.0, 3.0, 4.0});  // vertices at 0, 1/8, 1/2, 1
  const SectionField field = {{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}, {7.0, 1.0}};
  const auto value = [&](Coordinate coordinate, double at) { return reading({coordinate, at}, rod, field).x(); };
  EXPECT_EQ(reading({}, rod, field), Eigen::Vector2d(7.0, 1.0));
  EXPECT_EQ(value(Coordinate::distance_from_apex, 0.0), 7.0);
  EXPECT_NEAR(value(Coordinate::distance_from_apex, 0.25), 5.0, 1e-14);
  EXPECT_EQ(value(Coordinate::distance_from_apex, 9.0), 0.0);
  EXPECT_NEAR(value(Coordinate::distance_from_base, 0.125), 1.0, 1e-14);
  EXPECT_NEAR(value(Coordinate::distance_from_base, 0.3125), 2.0, 1e-14);
  EXPECT_EQ(value(Coordinate::distance_from_base, 9.0), 7.0);
  EXPECT_EQ(value(Coordinate::label, 0.0), 0.0);
  EXPECT_NEAR(value(Coordinate::label, 0.5), 2.0, 1e-14);
  EXPECT_EQ(value(Coordinate::label, 1.0), 7.0);
}

TEST(Sensor, StaysWithItsPlaceWhileElementsDivide) {
  rod::Rod rod = rodOf({1.0, 3.0, 4.0});
  const auto field = [](const rod::Rod& r) { return fieldOf(r, [](double s) { return 3.0 - 2.0 * s; }); };
  rod::Rod divided = rod;
  rod::divideLongElements(divided, 0.1, rod::DivisionMode::keep_strain);
  for (const Coordinate coordinate :
       {Coordinate::distance_from_apex, Coordinate::distance_from_base, Coordinate::label}) {
    for (const double at : {0.0, 0.1, 0.55, 1.0}) {
      const Sensor sensor{coordinate, at};
      EXPECT_LT((reading(sensor, rod, field(rod)) - reading(sensor, divided, field(divided))).norm(), 1e-14);
    }
  }
}

TEST(Receivers, AreWeighedByTheirCoordinate) {
  const rod::Rod rod = rodOf({1.0, 3.0, 4.0});
  std::vector<double> weights;
  weigh({}, rod, weights);
  EXPECT_EQ(weights, (std::vector<double>{1.0, 1.0, 1.0}));
  weigh({Coordinate::distance_from_apex, {0.5, 0.75}, {2.0, -1.0}}, rod, weights);
  EXPECT_EQ(weights, (std::vector<double>{-1.0, -1.0, 2.0}));
  weigh({Coordinate::distance_from_base, {0.0, 0.5}, {0.0, 1.0}}, rod, weights);
  EXPECT_EQ(weights, (std::vector<double>{0.0, 0.25, 1.0}));
  weigh({Coordinate::label, {0.0, 1.0}, {0.0, 3.0}}, rod, weights);
  EXPECT_NEAR(weights[1], 1.0, 1e-15);
  weigh({Coordinate::label, {0.3}, {4.0}}, rod, weights);
  EXPECT_EQ(weights, (std::vector<double>{4.0, 4.0, 4.0}));
}

// --- Spread
// ---------------------------------------------------------------------------------------------------------

SectionField spread(const Spread& kernel, const rod::Rod& rod, const SectionField& field) {
  SectionField result;
  spreadOut(kernel, rod, field, result);
  return result;
}

TEST(FadingSpread, IsExactForWhatIsLinear) {
  using Direction = FadingSpread::Direction;
  const double a = 0.3;
  for (const std::size_t n : {1u, 3u, 40u}) {
    const rod::Rod rod = unevenRod(n);
    const SectionField field = fieldOf(rod, [](double s) { return 1.0 + 2.0 * s; });
    double s = 0.0;
    for (std::size_t v = 0; v <= n; ++v) {
      // Integrals of exp(-u / a) / a (1 + 2 (s + u)) from 0 to the apex, and of its mirror image.
      const double up = 1.0 - s;
      const double from_apex = (1.0 + 2.0 * s + 2.0 * a) - std::exp(-up / a) * (3.0 + 2.0 * a);
      const double from_base = (1.0 + 2.0 * s - 2.0 * a) - std::exp(-s / a) * (1.0 - 2.0 * a);
      EXPECT_NEAR(spread(FadingSpread{Direction::basipetal, a}, rod, field)[v].x(), from_apex, 1e-13);
      EXPECT_NEAR(spread(FadingSpread{Direction::acropetal, a}, rod, field)[v].x(), from_base, 1e-13);
      EXPECT_NEAR(spread(FadingSpread{Direction::both, a}, rod, field)[v].y(), from_apex + from_base, 1e-13);
      if (v < n) s += rod.elements[v].rest_length;
    }
  }
}

TEST(FadingSpread, OfNoReachIsLocal) {
  const rod::Rod rod = unevenRod(10);
  const SectionField field = fieldOf(rod, [](double s) { return std::cos(s); });
  const SectionField near = spread(FadingSpread{FadingSpread::Direction::basipetal, 1e-9}, rod, field);
  for (std::size_t v = 0; v < 10; ++v) EXPECT_LT((near[v] - field[v]).norm(), 1e-7);
}

TEST(SampledSpread, IsTheMeanForAKernelOfOne) {
  const SampledSpread uniform{{0.0, 1.0}, Eigen::MatrixXd::Ones(2, 2)};
  for (const std::size_t n : {1u, 5u}) {
    const rod::Rod rod = unevenRod(n);
    for (const Eigen::Vector2d& value : spread(uniform, rod, fieldOf(rod, [](double s) { return 3.0 * s - 1.0; }))) {
      EXPECT_NEAR(value.x(), 0.5, 1e-14);
    }
  }
}

TEST(SampledSpread, IsSecondOrderInTheLengthsOfElements) {
  // mu = (1 + 2 S)(3 - S') by its corners, S = s here: at the apex 3 times the integral of (3 - s) sin(3 s).
  Eigen::MatrixXd corners(2, 2);
  corners << 3.0, 2.0, 9.0, 6.0;
  const SampledSpread kernel{{0.0, 1.0}, corners};
  const double moment = (3.0 - 2.0 * std::cos(3.0)) / 3.0 - std::sin(3.0) / 9.0;
  const auto error = [&](std::size_t n) {
    const rod::Rod rod = rodOf(std::vector<double>(n, 1.0));
    return spread(kernel, rod, fieldOf(rod, [](double s) { return std::sin(3.0 * s); })).back().x() - 3.0 * moment;
  };
  EXPECT_LT(std::abs(error(80)), 1e-3);
  EXPECT_NEAR(order(error(20), error(40)), 2.0, 0.01);
  EXPECT_NEAR(order(error(40), error(80)), 2.0, 0.01);
}

TEST(SampledSpread, InterpolatesInBothLabels) {
  Eigen::MatrixXd densities(3, 3);
  densities << 1.0, 2.0, 5.0, 0.0, -1.0, 3.0, 4.0, 1.0, 2.0;
  const SampledSpread kernel{{0.0, 0.25, 1.0}, densities};
  const rod::Rod rod = rodOf(std::vector<double>(8, 1.0));
  SectionField point(9, Eigen::Vector2d::Zero());
  point[5] = {1.0, 0.0};  // label 0.625 is half-way between 0.25 and 1
  const SectionField result = spread(kernel, rod, point);
  EXPECT_NEAR(result[1].x(), 0.125 * 0.5 * (0.5 * (2.0 - 1.0) + 0.5 * (5.0 + 3.0)), 1e-15);
  EXPECT_NEAR(result[8].x(), 0.125 * 0.5 * (1.0 + 2.0), 1e-15);
}

}  // namespace
}  // namespace sensory_growth::growth
