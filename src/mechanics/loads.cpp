#include "sensory_growth/mechanics/loads.h"

namespace sensory_growth::mechanics {

Loads scaled(const Loads& loads, double factor) {
  Loads result = loads;
  result.gravity *= factor;
  result.tip_force *= factor;
  result.line_force *= factor;
  result.tip_couple *= factor;
  return result;
}

rod::Vector3 vertexForce(const rod::Rod& rod, const Loads& loads, std::size_t vertex) {
  rod::Vector3 force = rod.vertexMass(vertex) * loads.gravity + rod.vertexLength(vertex) * loads.line_force;
  if (vertex == rod.size()) force += loads.tip_force;
  return force;
}

rod::Vector3 coupleOnLastElement(const rod::Rod& rod, const Loads& loads) {
  const rod::Element& last = rod.elements.back();
  const rod::Vector3 bending = loads.tip_couple.cwiseQuotient(last.section.bendStiffness());
  return rod::exp(0.5 * last.rest_length * (rod.bends.back().rest_curvature + bending)) * loads.tip_couple;
}

void elementForces(const rod::Rod& rod, const Loads& loads, std::vector<rod::Vector3>& forces) {
  forces.resize(rod.size());
  rod::Vector3 beyond = rod::Vector3::Zero();
  for (std::size_t e = rod.size(); e-- > 0;) {
    beyond += vertexForce(rod, loads, e + 1);
    forces[e] = beyond;
  }
}

}  // namespace sensory_growth::mechanics
