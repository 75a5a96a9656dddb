#include "sensory_growth/growth/differential_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

/// What one step does to a bend that straightens by proprioception while it grows.
struct Straightening {
  double G;     ///< gamma / R times the growth strain [-]
  double phi2;  ///< of G; the step needs expm1(-G) = -G phi1 and phi1 = 1 - G phi2 besides

  Straightening(const rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, std::size_t bend)
      : G(law.proprioception_length * strain.bends[bend] / bendRadius(rod, bend)), phi2(growth::phi2(G)) {}

  double phi1() const { return 1.0 - G * phi2; }
};

/// The actual curvature moves with the rest curvature, so that the elastic strain, and with it the moment, stays.
void addToRestBending(rod::Bend& bend, const Eigen::Vector2d& increment) {
  bend.rest_curvature.head<2>() += increment;
  bend.curvature.head<2>() += increment;
}

}  // namespace

double bendRadius(const rod::Rod& rod, std::size_t bend) {
  return rod::voronoiMean(rod, bend, [&](std::size_t e) { return rod.elements[e].section.radius; });
}

double drive(const BendingLaw& law, const Environment& environment, const rod::Rod& rod,
             std::vector<Eigen::Vector2d>& f) {
  const CueField field(law.sensitivities, environment);
  f.assign(rod.size(), Eigen::Vector2d::Zero());
  double largest_square = 0.0;
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const rod::Vector3 section = rod.bendFrame(j).conjugate() * field.at(rod.vertices[j].position);
    f[j] = Eigen::Vector2d(-section.y(), section.x()) / bendRadius(rod, j);
    largest_square = std::max(largest_square, section.head<2>().squaredNorm());
  }
  return std::sqrt(largest_square);
}

void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f) {
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const Straightening step(rod, law, strain, j);
    const Eigen::Vector2d b0 = rod.bends[j].rest_curvature.head<2>();
    addToRestBending(rod.bends[j], step.phi1() * (strain.bends[j] * f[j] - step.G * b0));
  }
}

void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f0,
             const std::vector<Eigen::Vector2d>& f1) {
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const Straightening step(rod, law, strain, j);
    addToRestBending(rod.bends[j], strain.bends[j] * step.phi2 * (f1[j] - f0[j]));
  }
}

double phi1(double G) { return G == 0.0 ? 1.0 : -std::expm1(-G) / G; }

double phi2(double G) {
  // The closed form loses digits to cancellation well before its series loses accuracy.
  if (std::abs(G) < 1e-2) return 0.5 - G / 6.0 + G * G / 24.0 - G * G * G / 120.0 + G * G * G * G / 720.0;
  return (std::expm1(-G) + G) / (G * G);
}

}  // namespace sensory_growth::growth
