#include "sensory_growth/mechanics/energy.h"

#include "surroundings_potential.h"

namespace sensory_growth::mechanics {

using rod::Vector3;

Vector3 bendStiffness(const rod::Rod& rod, std::size_t bend) {
  if (bend < rod.firstBend()) return Vector3::Zero();
  const auto compliance = [&](std::size_t e) -> Vector3 {
    return rod.elements[e].section.bendStiffness().cwiseInverse();
  };
  return rod::voronoiMean(rod, bend, compliance).cwiseInverse();
}

Energy energy(const rod::Rod& rod, const Loads& loads) {
  Energy sum;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const Vector3 bending = rod.bends[j].curvature - rod.bends[j].rest_curvature;
    sum.bending += 0.5 * rod.voronoiLength(j) * bending.dot(bendStiffness(rod, j).cwiseProduct(bending));
  }
  for (const rod::Element& element : rod.elements) {
    if (element.section.inextensible) continue;
    const Vector3 stretch = element.strain - element.rest_strain;
    sum.stretching +=
        0.5 * element.rest_length * stretch.cwiseAbs2().dot(element.section.stretchCompliance().cwiseInverse());
  }
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    sum.load -= vertexForce(rod, loads, v).dot(rod.vertices[v].position);
  }
  if (!loads.surroundings.empty()) {
    SurroundingsPotential potential;
    potential.assign(rod, loads.surroundings, 0.0);
    sum.surroundings = potential.evaluate(positionsFromBase(rod));
  }
  return sum;
}

double kineticEnergy(const rod::Rod& rod) {
  double sum = 0.0;
  for (std::size_t v = 0; v <= rod.size(); ++v) {
    sum += 0.5 * rod.vertexMass(v) * rod.vertices[v].velocity.squaredNorm();
  }
  for (const rod::Element& e : rod.elements) {
    const double inertia = e.section.density * e.rest_length * e.section.secondMoment();
    const Vector3& w = e.angular_velocity;
    sum += 0.5 * inertia * (w.squaredNorm() + w.z() * w.z());  // the moments of inertia are in the ratio 1:1:2
  }
  return sum;
}

}  // namespace sensory_growth::mechanics
