#include "sensory_growth/growth/differential_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

/// G of a bend: how much it straightens by proprioception in a step [-].
double straightening(const rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, std::size_t bend) {
  return law.proprioception_length * strain.bends[bend] * inverseRadius(rod, bend);
}

/// Closed forms lose digits to cancellation below this well before the series lose accuracy above it.
constexpr double kSeries = 1e-2;

/// The actual curvature moves with the rest curvature, so that the elastic strain, and with it the moment, stays.
void addToRestBending(rod::Bend& bend, const Eigen::Vector2d& increment) {
  bend.rest_curvature.head<2>() += increment;
  bend.curvature.head<2>() += increment;
}

}  // namespace

double drive(const rod::Rod& rod, const CueFields& perceived, std::vector<Eigen::Vector2d>& f) {
  f.assign(rod.size(), Eigen::Vector2d::Zero());
  double largest_square = 0.0;
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    Eigen::Vector2d delta = Eigen::Vector2d::Zero();
    for (const SectionField& cue : perceived) delta += cue[j];
    f[j] = Eigen::Vector2d(-delta.y(), delta.x()) * inverseRadius(rod, j);
    largest_square = std::max(largest_square, delta.squaredNorm());
  }
  return std::sqrt(largest_square);
}

void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f) {
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const double G = straightening(rod, law, strain, j);
    const Eigen::Vector2d b0 = rod.bends[j].rest_curvature.head<2>();
    addToRestBending(rod.bends[j], phi1(G) * (strain.bends[j] * f[j] - G * b0));
  }
}

void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f0,
             const std::vector<Eigen::Vector2d>& f1) {
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const double G = straightening(rod, law, strain, j);
    addToRestBending(rod.bends[j], strain.bends[j] * phi2(G) * (f1[j] - f0[j]));
  }
}

double phi1(double G) { return std::abs(G) < kSeries ? 1.0 - G * phi2(G) : -std::expm1(-G) / G; }

double phi2(double G) {
  if (std::abs(G) < kSeries) return 1.0 / 2 - G * (1.0 / 6 - G * (1.0 / 24 - G * (1.0 / 120 - G * (1.0 / 720))));
  return (std::expm1(-G) + G) / (G * G);
}

}  // namespace sensory_growth::growth
