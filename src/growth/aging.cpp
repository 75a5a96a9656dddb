#include "sensory_growth/growth/aging.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensory_growth::growth {
namespace {

using rod::Vector3;

double matured(const Maturation& maturation, double young, double age) {
  return young - (maturation.mature - young) * std::expm1(-age / maturation.time);
}

/// Compliances of the two half cells of a bend add (model.md 1.5) [1/(N m^2)]; the sections may be those of another
/// rod.
Vector3 bendCompliance(const rod::Rod& rod, const rod::Rod& sections, std::size_t bend) {
  return rod::voronoiMean(
      rod, bend, [&](std::size_t e) -> Vector3 { return sections.elements[e].section.bendStiffness().cwiseInverse(); });
}

Vector3 moment(const rod::Rod& rod, std::size_t bend) {
  const Vector3 strain = rod.bends[bend].curvature - rod.bends[bend].rest_curvature;
  return strain.cwiseQuotient(bendCompliance(rod, rod, bend));
}

/// Zero in an inextensible element, whose compliance cannot change.
Vector3 force(const rod::Element& element) {
  if (element.section.inextensible) return Vector3::Zero();
  return (element.strain - element.rest_strain).cwiseQuotient(element.section.stretchCompliance());
}

Vector3 lostCurvatureCompliance(const rod::Rod& rod, const rod::Rod& before, std::size_t bend) {
  return (bendCompliance(rod, before, bend) - bendCompliance(rod, rod, bend)).cwiseMax(0.0);
}

Vector3 lostStretchCompliance(const rod::Rod& rod, const rod::Rod& before, std::size_t e) {
  const Vector3 now = rod.elements[e].section.stretchCompliance();
  return (before.elements[e].section.stretchCompliance() - now).cwiseMax(0.0);
}

}  // namespace

rod::Section agedSection(const Aging& aging, const rod::Section& young, double age) {
  rod::Section section = young;
  if (aging.young_modulus) {
    section.young_modulus = matured(*aging.young_modulus, young.young_modulus, age);
    section.shear_modulus = young.shear_modulus * (section.young_modulus / young.young_modulus);
  }
  if (aging.radius) section.radius = matured(*aging.radius, young.radius, age);
  return section;
}

void growOlder(rod::Rod& rod, const rod::Rod& before, const Aging& aging, const rod::Section& young,
               const GrowthStrain& strain, double fastest_rate, double dt, double share) {
  const bool counts_growth = aging.clock == AgingClock::maturation && fastest_rate > 0.0;
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const double spent_growing = counts_growth ? strain.elements[e] / fastest_rate : 0.0;
    rod::Element& element = rod.elements[e];
    element.age = before.elements[e].age + share * std::max(0.0, dt - spent_growing);
    element.section = agedSection(aging, young, element.age);
  }
}

void Deposition::predict(rod::Rod& rod, const rod::Rod& before) {
  for (std::size_t e = 0; e < rod.size(); ++e) {
    bringUpTo(lostCurvatureCompliance(rod, before, e).cwiseProduct(moment(before, e)),
              lostStretchCompliance(rod, before, e).cwiseProduct(force(before.elements[e])), rod, e);
  }
}

void Deposition::correct(rod::Rod& rod, const rod::Rod& before) {
  for (std::size_t e = 0; e < rod.size(); ++e) {
    const Vector3 mean_moment = 0.5 * (moment(before, e) + moment(rod, e));
    const Vector3 mean_force = 0.5 * (force(before.elements[e]) + force(rod.elements[e]));
    bringUpTo(lostCurvatureCompliance(rod, before, e).cwiseProduct(mean_moment),
              lostStretchCompliance(rod, before, e).cwiseProduct(mean_force), rod, e);
  }
}

void Deposition::bringUpTo(const Vector3& curvature, const Vector3& strain, rod::Rod& rod, std::size_t e) {
  Deposit& deposit = deposits_[e];
  rod.elements[e].rest_strain += strain - deposit.strain;
  if (e >= rod.firstBend()) rod.bends[e].rest_curvature += curvature - deposit.curvature;
  deposit = {curvature, strain};
}

}  // namespace sensory_growth::growth
