#include "sensory_growth/growth/differential_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

/// Length over which the bending components of the rest curvature decay [m], whichever law makes them: the actual
/// curvature is the rest curvature and an elastic part, which is slow.
double decayLength(const Proprioception& law) {
  return law.intrinsic_length + law.actual_length + law.relaxation_length;
}

/// Closed forms lose digits to cancellation below this well before the series lose accuracy above it.
constexpr double kSeries = 1e-2;

/// The actual curvature moves with the rest curvature, so that the elastic strain, and with it the moment, stays.
void addToRest(rod::Bend& bend, const Eigen::Vector2d& increment) {
  bend.rest_curvature.head<2>() += increment;
  bend.curvature.head<2>() += increment;
}

void addToRestTwist(rod::Bend& bend, double increment) {
  bend.rest_curvature.z() += increment;
  bend.curvature.z() += increment;
}

}  // namespace

std::optional<std::string> findFault(const BendingLaw& law) {
  const Proprioception& p = law.proprioception;
  for (const double length : {p.intrinsic_length, p.actual_length, p.relaxation_length}) {
    if (!(length >= 0.0) || !std::isfinite(length)) return "lengths of proprioception must be >= 0 m";
  }
  if (!p.set_point.allFinite()) return "set_point of proprioception must be finite";
  if (law.rotation && !(std::abs(law.rotation->period) > 0.0)) return "period of circumnutation must not be 0 s";
  if (law.rotation && !(law.rotation->gate >= 0.0)) return "gate of circumnutation must be >= 0";
  return std::nullopt;
}

double drive(const rod::Rod& rod, const BendingLaw& law, const CueFields& perceived, std::vector<rod::Vector3>& drive) {
  const Proprioception& p = law.proprioception;
  const Eigen::Vector2d towards_set_point = (p.intrinsic_length + p.actual_length) * p.set_point;
  drive.assign(rod.size(), rod::Vector3::Zero());
  double largest = 0.0;
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    Eigen::Vector2d delta = Eigen::Vector2d::Zero();
    for (const SectionField& cue : perceived) delta += cue[j];
    const double size = delta.norm();
    largest = std::max(largest, size);
    if (law.saturation && size > 1.0) delta /= size;

    const rod::Bend& bend = rod.bends[j];
    const rod::Vector3 elastic = bend.curvature - bend.rest_curvature;
    rod::Vector3 f = p.relaxation_length * bend.curvature;
    f.head<2>() += Eigen::Vector2d(-delta.y(), delta.x()) + towards_set_point - p.actual_length * elastic.head<2>();
    drive[j] = f * inverseRadius(rod, j);
  }
  return largest;
}

Eigen::Vector2d bendingRate(const rod::Rod& rod, const BendingLaw& law, const std::vector<rod::Vector3>& drive,
                            std::size_t bend) {
  const double decay = decayLength(law.proprioception) * inverseRadius(rod, bend);
  return drive[bend].head<2>() - decay * rod.bends[bend].rest_curvature.head<2>();
}

void predict(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<rod::Vector3>& drive) {
  const double bending_decay = decayLength(law.proprioception);
  const double twist_decay = law.proprioception.relaxation_length;
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const double per_length = strain.bends[j] * inverseRadius(rod, j);
    const rod::Vector3 rest = rod.bends[j].rest_curvature;
    const rod::Vector3 driven = strain.bends[j] * drive[j];
    const double G = bending_decay * per_length;
    addToRest(rod.bends[j], phi1(G) * (driven.head<2>() - G * rest.head<2>()));
    if (twist_decay == 0.0) continue;
    const double twist_G = twist_decay * per_length;
    addToRestTwist(rod.bends[j], phi1(twist_G) * (driven.z() - twist_G * rest.z()));
  }
}

void correct(rod::Rod& rod, const BendingLaw& law, const GrowthStrain& strain, const std::vector<rod::Vector3>& drive,
             const std::vector<rod::Vector3>& new_drive) {
  const double bending_decay = decayLength(law.proprioception);
  const double twist_decay = law.proprioception.relaxation_length;
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    const double per_length = strain.bends[j] * inverseRadius(rod, j);
    const rod::Vector3 missed = strain.bends[j] * (new_drive[j] - drive[j]);
    addToRest(rod.bends[j], phi2(bending_decay * per_length) * missed.head<2>());
    if (twist_decay > 0.0) addToRestTwist(rod.bends[j], phi2(twist_decay * per_length) * missed.z());
  }
}

double phi1(double G) { return std::abs(G) < kSeries ? 1.0 - G * phi2(G) : -std::expm1(-G) / G; }

double phi2(double G) {
  if (std::abs(G) < kSeries) return 1.0 / 2 - G * (1.0 / 6 - G * (1.0 / 24 - G * (1.0 / 120 - G * (1.0 / 720))));
  return (std::expm1(-G) + G) / (G * G);
}

}  // namespace sensory_growth::growth
