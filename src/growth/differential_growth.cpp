#include "sensory_growth/growth/differential_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

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
  f.resize(rod.size());
  double largest = 0.0;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const rod::Vector3 delta = differentialGrowth(law.sensitivities, environment, rod.vertices[j].position);
    const rod::Vector3 section = rod.bendFrame(j).conjugate() * delta;
    f[j] = Eigen::Vector2d(-section.y(), section.x()) / bendRadius(rod, j);
    largest = std::max(largest, section.head<2>().norm());
  }
  return largest;
}

void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f) {
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double G = law.proprioception_length * strain.bends[j] / bendRadius(rod, j);
    const Eigen::Vector2d b0 = rod.bends[j].rest_curvature.head<2>();
    addToRestBending(rod.bends[j], std::expm1(-G) * b0 + strain.bends[j] * phi1(G) * f[j]);
  }
}

void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<Eigen::Vector2d>& f0,
             const std::vector<Eigen::Vector2d>& f1) {
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double G = law.proprioception_length * strain.bends[j] / bendRadius(rod, j);
    addToRestBending(rod.bends[j], strain.bends[j] * phi2(G) * (f1[j] - f0[j]));
  }
}

double phi1(double G) { return G == 0.0 ? 1.0 : -std::expm1(-G) / G; }

double phi2(double G) {
  // The closed form loses digits to cancellation well before its series loses accuracy.
  if (std::abs(G) < 1e-2) return 0.5 - G / 6.0 + G * G / 24.0 - G * G * G / 120.0 + G * G * G * G / 720.0;
  return (std::expm1(-G) + G) / (G * G);
}

}  // namespace sensory_growth::growth
