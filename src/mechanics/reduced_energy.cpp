#include "sensory_growth/mechanics/reduced_energy.h"

#include <algorithm>
#include <cmath>

#include "sensory_growth/mechanics/energy.h"

namespace sensory_growth::mechanics {

using rod::hat;
using rod::leftJacobianInverse;
using rod::leftJacobianInverseDerivative;
using rod::Matrix3;
using rod::Vector3;

void ReducedEnergy::assign(const rod::Rod& rod, const Loads& loads) {
  const std::size_t n = rod.size();
  base_ = rod.base.frame;
  rest_length_.resize(n);
  voronoi_.resize(n);
  bend_stiffness_.resize(n);
  rest_curvature_.resize(n);
  compliance_.resize(n);
  rest_strain_.resize(n);
  angle_.resize(n);
  moment_.resize(n);
  material_force_.resize(n);
  strain_.resize(n);
  elementForces(rod, loads, force_);

  double stiffest = 0.0;
  for (std::size_t e = 0; e < n; ++e) {
    const rod::Element& element = rod.elements[e];
    rest_length_[e] = element.rest_length;
    rest_strain_[e] = element.rest_strain;
    compliance_[e] = element.section.stretchCompliance();
    voronoi_[e] = rod.voronoiLength(e);
    bend_stiffness_[e] = bendStiffness(rod, e);
    rest_curvature_[e] = rod.bends[e].rest_curvature;
    stiffest = std::max(stiffest, bend_stiffness_[e].head<2>().maxCoeff());
  }

  double total_force = 0.0;
  for (std::size_t v = 0; v <= n; ++v) total_force += vertexForce(rod, loads, v).norm();
  const double L = rod.restLength();
  bending_scale_ = stiffest / L;
  couple_scale_ = std::max(total_force * L, bending_scale_);
}

double ReducedEnergy::evaluate(const Frames& frames) {
  double energy = 0.0;
  magnitude_ = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    const rod::Quaternion& below = e > 0 ? frames[e - 1] : base_;
    angle_[e] = rod::log(below.conjugate() * frames[e]);
    const Vector3 bending = angle_[e] / voronoi_[e] - rest_curvature_[e];
    moment_[e] = bend_stiffness_[e].cwiseProduct(bending);

    const Vector3 p = frames[e].conjugate() * force_[e];
    material_force_[e] = p;
    const Vector3 stretch = compliance_[e].cwiseProduct(p);
    strain_[e] = rest_strain_[e] + stretch;

    const double bent = 0.5 * voronoi_[e] * moment_[e].dot(bending);
    const double loaded = rest_length_[e] * p.dot(Vector3::UnitZ() + rest_strain_[e] + 0.5 * stretch);
    energy += bent - loaded;
    magnitude_ += bent + std::abs(loaded);
  }
  return energy;
}

double ReducedEnergy::largestBend() const { return largestRotation(angle_); }

void ReducedEnergy::differentiate(RotationField& gradient, BlockTridiagonal& hessian) const {
  const std::size_t n = size();
  gradient.resize(n);
  hessian.diagonal.resize(n);
  hessian.upper.resize(n - 1);

  for (std::size_t e = 0; e < n; ++e) {
    const double length = rest_length_[e];
    const Vector3 v = Vector3::UnitZ() + strain_[e];
    const Matrix3 P = hat(material_force_[e]);
    const Matrix3 VP = hat(v) * P;
    gradient[e] = -length * v.cross(material_force_[e]);
    hessian.diagonal[e] = length * (P * compliance_[e].asDiagonal() * P - 0.5 * (VP + VP.transpose()));
  }

  for (std::size_t j = 0; j < n; ++j) {
    const Vector3& theta = angle_[j];
    const Vector3& m = moment_[j];
    const Matrix3 J = leftJacobianInverse(theta);
    const Vector3 stiffness = bend_stiffness_[j] / voronoi_[j];

    const Matrix3 upper_rate = leftJacobianInverseDerivative(theta, m) + J * stiffness.asDiagonal();
    const Matrix3 upper = upper_rate * J.transpose();
    gradient[j] += J * m;
    hessian.diagonal[j] += 0.5 * (upper + upper.transpose());
    if (j == 0) continue;

    const Matrix3 lower_rate = leftJacobianInverseDerivative(-theta, m) - J.transpose() * stiffness.asDiagonal();
    const Matrix3 lower = -lower_rate * J;
    gradient[j - 1] -= J.transpose() * m;
    hessian.diagonal[j - 1] += 0.5 * (lower + lower.transpose());
    hessian.upper[j - 1] = lower_rate * J.transpose();
  }
}

}  // namespace sensory_growth::mechanics
