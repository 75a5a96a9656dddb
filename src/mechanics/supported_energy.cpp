#include "supported_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "sensory_growth/mechanics/energy.h"

namespace sensory_growth::mechanics {

using rod::hat;
using rod::leftJacobianInverse;
using rod::leftJacobianInverseDerivative;
using rod::Matrix3;
using rod::Vector3;

namespace {

Eigen::Index column(std::size_t e) { return static_cast<Eigen::Index>(e); }

}  // namespace

void SupportedEnergy::assign(const rod::Rod& rod, const Loads& loads) {
  const std::size_t n = rod.size();
  base_frame_ = rod.base.frame;
  support_ = rod.base_support;
  tip_couple_ = coupleOnLastElement(rod, loads);
  frame_is_held_ = loads.surroundings.held_apex && loads.surroundings.held_apex->frame;
  length_ = rod.restLength();

  rest_length_.clear();
  stiffness_.clear();
  compliance_.clear();
  rest_strain_.clear();
  for (const rod::Element& element : rod.elements) {
    rest_length_.push_back(element.rest_length);
    compliance_.push_back(element.section.stretchCompliance());
    stiffness_.push_back(element.section.inextensible ? Vector3::Zero() : Vector3(compliance_.back().cwiseInverse()));
    rest_strain_.push_back(element.rest_strain);
  }

  vertex_force_.resize(3, column(n) + 1);
  dead_force_ = 0.0;
  for (std::size_t v = 0; v <= n; ++v) {
    vertex_force_.col(column(v)) = vertexForce(rod, loads, v);
    dead_force_ += vertex_force_.col(column(v)).norm();
  }

  voronoi_.clear();
  bend_stiffness_.clear();
  rest_curvature_.clear();
  stiffest_ = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    voronoi_.push_back(rod.voronoiLength(j));
    bend_stiffness_.push_back(bendStiffness(rod, j));
    rest_curvature_.push_back(rod.bends[j].rest_curvature);
    stiffest_ = std::max(stiffest_, rod.elements[j].section.bendStiffness().head<2>().maxCoeff());
  }
  if (frame_is_held_) {
    held_frame_ = *loads.surroundings.held_apex->frame;
    voronoi_.push_back(0.5 * rest_length_.back());
    bend_stiffness_.push_back(rod.elements.back().section.bendStiffness());
    rest_curvature_.push_back(rod.bends.back().rest_curvature);
  }
  angle_.resize(voronoi_.size());
  material_force_.resize(n);

  const double penalty = 1e4 * std::max(stiffest_ / std::pow(length_, 3), dead_force_ / length_);
  surroundings_.assign(rod, loads.surroundings, penalty);
}

Vector3 SupportedEnergy::bendMoment(std::size_t j) const {
  return bend_stiffness_[j].cwiseProduct(curvature(j) - rest_curvature_[j]);
}

double SupportedEnergy::evaluate(const Configuration& configuration) {
  frames_ = configuration.frames;
  strains_ = configuration.strains;
  double energy = 0.0;
  magnitude_ = 0.0;
  const auto add = [&](double term) {
    energy += term;
    magnitude_ += std::abs(term);
  };

  for (std::size_t j = 0; j < angle_.size(); ++j) {
    const rod::Quaternion& below = j > 0 ? frames_[j - 1] : base_frame_;
    const rod::Quaternion& above = j < size() ? frames_[j] : held_frame_;
    angle_[j] = rod::log(below.conjugate() * above);
    add(0.5 * voronoi_[j] * bendMoment(j).dot(curvature(j) - rest_curvature_[j]));
  }

  positions_.resize(3, column(size()) + 1);
  positions_.col(0).setZero();
  for (std::size_t e = 0; e < size(); ++e) {
    const Vector3 strain = strains_.col(column(e));
    const Vector3 stretch = strain - rest_strain_[e];
    add(0.5 * rest_length_[e] * stretch.cwiseAbs2().dot(stiffness_[e]));
    positions_.col(column(e) + 1) =
        positions_.col(column(e)) + rest_length_[e] * (frames_[e] * (Vector3::UnitZ() + strain));
  }
  for (Eigen::Index v = 1; v < positions_.cols(); ++v) {
    add(-vertex_force_.col(v).dot(positions_.col(v)));
  }

  add(surroundings_.evaluate(positions_));
  magnitude_ += surroundings_.totalForce() * length_;
  return energy;
}

double SupportedEnergy::largestBend() const {
  double largest = 0.0;
  for (std::size_t j = support_ == rod::BaseSupport::clamped ? 0 : 1; j < angle_.size(); ++j) {
    if (std::isnan(angle_[j].norm())) return angle_[j].norm();
    largest = std::max(largest, angle_[j].norm());
  }
  return largest;
}

void SupportedEnergy::differentiate(Variation& gradient) {
  const std::size_t n = size();
  gradient.rotations.resize(3, column(n));
  gradient.strains.resize(3, column(n));

  Vector3 beyond = Vector3::Zero();
  for (std::size_t e = n; e-- > 0;) {
    beyond += vertex_force_.col(column(e) + 1) + surroundings_.forces().col(column(e) + 1);
    const Vector3 p = frames_[e].conjugate() * beyond;
    const Vector3 strain = strains_.col(column(e));
    material_force_[e] = p;
    gradient.rotations.col(column(e)) = -rest_length_[e] * (Vector3::UnitZ() + strain).cross(p);
    const Vector3 stretched = stiffness_[e].cwiseProduct(strain - rest_strain_[e]) - p;
    const bool rigid = compliance_[e].isZero(0.0);
    gradient.strains.col(column(e)) = rigid ? Vector3::Zero() : Vector3(rest_length_[e] * stretched);
  }
  for (std::size_t j = 0; j < angle_.size(); ++j) {
    const Matrix3 J = leftJacobianInverse(angle_[j]);
    const Vector3 moment = bendMoment(j);
    if (j < n) gradient.rotations.col(column(j)) += J * moment;
    if (j > 0) gradient.rotations.col(column(j) - 1) -= J.transpose() * moment;
  }
  gradient.rotations.col(column(n) - 1) -= tip_couple_;
  if (support_ == rod::BaseSupport::frozen_first_element) gradient.rotations.col(0).setZero();
}

void SupportedEnergy::differentiateTwice(double emphasis, ChainHessian& hessian) const {
  const std::size_t n = size();
  hessian.links.resize(n);
  hessian.first_fixed = support_ == rod::BaseSupport::frozen_first_element;

  for (std::size_t e = 0; e < n; ++e) {
    ChainLink& link = hessian.links[e];
    const double length = rest_length_[e];
    const Matrix3 R = frames_[e].toRotationMatrix();
    const Matrix3 P = hat(material_force_[e]);
    const Matrix3 V = hat(Vector3::UnitZ() + strains_.col(column(e)));
    const Matrix3 VP = V * P;
    link.rotation = length * (P * compliance_[e].asDiagonal() * P - 0.5 * (VP + VP.transpose()));
    link.lever = length * R * (compliance_[e].asDiagonal() * P - V);
    link.flexibility = R * (length * compliance_[e]).cwiseSqrt().asDiagonal();
  }

  for (std::size_t j = 0; j < angle_.size(); ++j) {
    const Vector3& theta = angle_[j];
    const Vector3 moment = bendMoment(j);
    const Matrix3 J = leftJacobianInverse(theta);
    const auto stiffness = (bend_stiffness_[j] / voronoi_[j]).asDiagonal();
    if (j < n) {
      const Matrix3 upper = (leftJacobianInverseDerivative(theta, moment) + J * stiffness) * J.transpose();
      hessian.links[j].rotation += 0.5 * (upper + upper.transpose());
    }
    if (j > 0) {
      const Matrix3 rate = leftJacobianInverseDerivative(-theta, moment) - J.transpose() * stiffness;
      const Matrix3 lower = -rate * J;
      hessian.links[j - 1].rotation += 0.5 * (lower + lower.transpose());
      if (j < n) hessian.links[j].coupling = rate * J.transpose();
    }
  }
  surroundings_.writeStiffness(emphasis, hessian.links);
}

Field SupportedEnergy::strainsOf(const ChainResponse& response) const {
  Field strains(3, column(size()));
  for (std::size_t e = 0; e < size(); ++e) {
    const Vector3 w = response.rotations.col(column(e));
    const Vector3 force = frames_[e].conjugate() * Vector3(response.forces.col(column(e)));
    strains.col(column(e)) = compliance_[e].cwiseProduct(force + material_force_[e].cross(w));
  }
  return strains;
}

void SupportedEnergy::newtonStep(const ChainHessian& hessian, const ChainCholesky& factor, const Variation& gradient,
                                 Variation& step) {
  const Eigen::Index n = column(size());
  couples_ = -gradient.rotations;
  gaps_.resize(3, n);
  Field excess(3, n);  // strain beyond the one that goes with the force
  for (std::size_t e = 0; e < size(); ++e) {
    const Vector3 s = compliance_[e].cwiseProduct(gradient.strains.col(column(e))) / rest_length_[e];
    excess.col(column(e)) = s;
    couples_.col(column(e)) += rest_length_[e] * material_force_[e].cross(s);
    gaps_.col(column(e)) = rest_length_[e] * (frames_[e] * s);
  }
  factor.solve(hessian, couples_, gaps_, response_);

  if (!tip_couple_.isZero(0.0)) {
    // The gradient of a body couple is constant in the body, its Hessian in the group therefore antisymmetric.
    const Matrix3 antisymmetric = 0.5 * hat(tip_couple_);
    const Field no_gaps = Field::Zero(3, n);
    ChainResponse unit[3];
    Matrix3 compliance;
    for (int k = 0; k < 3; ++k) {
      couples_.setZero(3, n);
      couples_(k, n - 1) = 1.0;
      factor.solve(hessian, couples_, no_gaps, unit[k]);
      compliance.col(k) = unit[k].rotations.col(n - 1);
    }
    const Matrix3 system = Matrix3::Identity() + antisymmetric * compliance;
    const Vector3 couple = system.inverse() * antisymmetric * response_.rotations.col(n - 1);
    for (int k = 0; k < 3; ++k) {
      response_.rotations -= couple[k] * unit[k].rotations;
      response_.forces -= couple[k] * unit[k].forces;
    }
  }
  step.rotations = response_.rotations;
  step.strains = strainsOf(response_) - excess;
}

double SupportedEnergy::forceScale() const {
  const double acting = dead_force_ + surroundings_.totalForce() + tip_couple_.norm() / length_;
  return std::max(acting, stiffest_ / (length_ * length_));
}

Residual SupportedEnergy::residual(const Variation& gradient) const {
  Residual largest;
  for (std::size_t e = 0; e < size(); ++e) {
    const Vector3 couple = gradient.rotations.col(column(e));
    const Vector3 pull = gradient.strains.col(column(e)) / rest_length_[e];
    const double here = std::max(couple.norm() / length_, pull.norm());
    if (std::isnan(couple.norm()) || std::isnan(pull.norm())) return {std::numeric_limits<double>::quiet_NaN(), e};
    if (here > largest.value) largest = {here, e};
  }
  return {largest.value / forceScale(), largest.element};
}

double SupportedEnergy::residualRoundOff() const {
  const double size_of_positions = positions_.cwiseAbs().maxCoeff() + length_;
  const double position = std::numeric_limits<double>::epsilon() * size_of_positions;
  return std::sqrt(static_cast<double>(size())) * position * surroundings_.largestStiffness() / forceScale();
}

Reactions SupportedEnergy::reactions() const {
  Reactions reactions = surroundings_.reactions();
  if (frame_is_held_) {
    const std::size_t n = size();
    reactions.apex_couple = frames_.back() * (leftJacobianInverse(-angle_[n]) * bendMoment(n));
  }
  return reactions;
}

}  // namespace sensory_growth::mechanics
