#include "rod_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/packets.h"
#include "sensory_growth/mechanics/energy.h"

namespace sensory_growth::mechanics {

using rod::Vector3;

void RodMotion::Vectors::clear(std::size_t n) {
  for (auto* column : {&x, &y, &z}) column->assign(n, 0.0);
}

void RodMotion::Vectors::set(std::size_t i, const Vector3& a) {
  x[i] = a.x();
  y[i] = a.y();
  z[i] = a.z();
}

void RodMotion::Frames::set(std::size_t i, const rod::Quaternion& q) {
  w[i] = q.w();
  v.set(i, q.vec());
}

void RodMotion::assign(const rod::Rod& rod, const Loads& loads, bool dilatation) {
  const std::size_t n = rod.size();
  dilatation_ = dilatation;
  has_surroundings_ = !loads.surroundings.empty();
  if (has_surroundings_) {
    surroundings_.assign(rod, loads.surroundings, 0.0);
    base_ = rod.base.position;
    from_base_ = positionsFromBase(rod);
    surroundings_.evaluate(from_base_);
  }
  share_ = 1.0;
  first_bend_ = rod.firstBend();
  clear(n);
  makeView(n);

  double stiffest = 0.0;
  double total_force = vertexForce(rod, loads, 0).norm();
  rest_length_sum_ = rod.restLength();
  position_.set(0, rod.vertices.front().position);
  frame_.set(0, rod.base.frame);
  for (std::size_t e = 0; e < n; ++e) {
    const rod::Element& element = rod.elements[e];
    const rod::Section& section = element.section;
    rest_length_[e] = element.rest_length;
    inverse_length_[e] = 1.0 / element.rest_length;
    inverse_voronoi_[e] = 1.0 / rod.voronoiLength(e);
    inverse_mass_[e] = 1.0 / rod.vertexMass(e + 1);
    inverse_inertia_[e] = 1.0 / (section.density * element.rest_length * section.secondMoment());
    const Vector3 stiffness = bendStiffness(rod, e);
    stretch_stiffness_.set(e, section.stretchCompliance().cwiseInverse());
    rest_stretch_.set(e, Vector3::UnitZ() + element.rest_strain);
    bend_stiffness_.set(e, stiffness);
    rest_curvature_.set(e, rod.bends[e].rest_curvature);
    const Vector3 force = vertexForce(rod, loads, e + 1);
    dead_force_.set(e, force);
    total_force += force.norm();
    stiffest = std::max(stiffest, stiffness.head<2>().maxCoeff());

    position_.set(e + 1, rod.vertices[e + 1].position);
    velocity_.set(e, rod.vertices[e + 1].velocity);
    angular_velocity_.set(e, element.angular_velocity);
    // q and -q are the same frame; the formula for a bend wants neighbours on the same side.
    const rod::Quaternion below = frame_.at(e);
    rod::Quaternion frame = element.frame;
    if (below.dot(frame) < 0.0) frame.coeffs() *= -1.0;
    frame_.set(e + 1, frame);
  }
  dead_couple_.set(n - 1, coupleOnLastElement(rod, loads));
  if (rod.base_support == rod::BaseSupport::frozen_first_element) {
    inverse_inertia_[0] = 0.0;
    frame_.set(1, frame_.at(0));
  }

  const double weight_couple = total_force * rest_length_sum_;
  bending_scale_ = stiffest / rest_length_sum_;
  couple_scale_ = std::max({weight_couple, bending_scale_, loads.tip_couple.norm()});
  energy_scale_ = weight_couple + bending_scale_;
  addUpForces();
}

/// Zeros everywhere, also in the padding: they carry no force and never move.
void RodMotion::clear(std::size_t elements) {
  const std::size_t n = (kernels::packetCount(elements) + 2) * kernels::kPacket;
  for (auto* scalars : {&rest_length_, &inverse_length_, &inverse_voronoi_, &inverse_mass_, &inverse_inertia_,
                        &current_length_, &frame_.w}) {
    scalars->assign(n, 0.0);
  }
  for (Vectors* vectors :
       {&stretch_stiffness_, &rest_stretch_, &bend_stiffness_, &rest_curvature_, &dead_force_, &dead_couple_,
        &position_, &frame_.v, &velocity_, &angular_velocity_, &force_, &couple_, &lower_couple_, &applied_force_}) {
    vectors->clear(n);
  }
}

void RodMotion::makeView(std::size_t elements) {
  kernels_ = &kernels::motionKernels();
  view_.size = elements;
  view_.rest_length = rest_length_.data();
  view_.inverse_length = inverse_length_.data();
  view_.inverse_voronoi = inverse_voronoi_.data();
  view_.inverse_mass = inverse_mass_.data();
  view_.inverse_inertia = inverse_inertia_.data();
  view_.stretch_stiffness = stretch_stiffness_.columns();
  view_.rest_stretch = rest_stretch_.columns();
  view_.bend_stiffness = bend_stiffness_.columns();
  view_.rest_curvature = rest_curvature_.columns();
  view_.applied_force = applied_force_.columns();
  view_.applied_couple = dead_couple_.columns();
  view_.position = position_.columns();
  view_.frame = {{frame_.w.data(), frame_.v.x.data(), frame_.v.y.data(), frame_.v.z.data()}};
  view_.velocity = velocity_.columns();
  view_.angular_velocity = angular_velocity_.columns();
  view_.force = force_.columns();
  view_.couple = couple_.columns();
  view_.lower_couple = lower_couple_.columns();
  view_.current_length = current_length_.data();
}

void RodMotion::write(rod::Rod& rod) const {
  for (std::size_t e = 0; e < size(); ++e) {
    rod::Element& element = rod.elements[e];
    element.frame = frame_.at(e + 1);
    element.strain =
        inverse_length_[e] * (element.frame.conjugate() * (position_.at(e + 1) - position_.at(e))) - Vector3::UnitZ();
    element.angular_velocity = angular_velocity_.at(e);
    rod.bends[e].curvature = inverse_voronoi_[e] * rod::log(frame_.at(e).conjugate() * frame_.at(e + 1));
    rod.vertices[e + 1].position = position_.at(e + 1);
    rod.vertices[e + 1].velocity = velocity_.at(e);
  }
}

void RodMotion::stop() {
  velocity_.clear(velocity_.x.size());
  angular_velocity_.clear(angular_velocity_.x.size());
}

void RodMotion::setTimeStep(double dt, double damping) {
  // Half of the decay comes before the force, half of it after.
  kick_ = {dt, std::exp(-damping * dt), dt * std::exp(-0.5 * damping * dt)};
}

void RodMotion::drift(double dt) { kernels_->drift(view_, dt); }

void RodMotion::evaluate() {
  dilatation_ ? kernels_->evaluateClassical(view_) : kernels_->evaluate(view_);
  if (!has_surroundings_) return;
  for (std::size_t v = 0; v <= size(); ++v) {
    from_base_.col(static_cast<Eigen::Index>(v)) = position_.at(v) - base_;
  }
  surroundings_.evaluate(from_base_);
  addUpForces();
}

void RodMotion::kickAndDrift(double dt) { kernels_->kickAndDrift(view_, kick_, dt); }

void RodMotion::addUpForces() {
  for (std::size_t e = 0; e < size(); ++e) {
    Vector3 force = share_ * dead_force_.at(e);
    if (has_surroundings_) force += surroundings_.forces().col(static_cast<Eigen::Index>(e + 1));
    applied_force_.set(e, force);
  }
}

Vector3 RodMotion::freeForce(std::size_t e) const { return applied_force_.at(e) + force_.at(e + 1) - force_.at(e); }

Vector3 RodMotion::freeCouple(std::size_t e) const {
  if (inverse_inertia_[e] == 0.0) return Vector3::Zero();
  return dead_couple_.at(e) + couple_.at(e) + lower_couple_.at(e + 1);
}

double RodMotion::carriedShare() const {
  double along = 0.0, square = 0.0;
  Vector3 beyond = Vector3::Zero();
  for (std::size_t e = size(); e-- > 0;) {
    beyond += dead_force_.at(e);
    along += force_.at(e).dot(beyond);
    square += beyond.squaredNorm();
  }
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 1.0;
}

void RodMotion::setShare(double share) {
  share_ = share;
  addUpForces();
}

Residual RodMotion::residual() const {
  Residual largest;
  Vector3 beyond = Vector3::Zero();
  for (std::size_t e = size(); e-- > 0;) {
    beyond += freeForce(e);
    const double couple = freeCouple(e).norm();
    const double force = rest_length_sum_ * beyond.norm();
    if (!std::isfinite(couple + force)) return {couple + force, e};
    const double here = std::max(couple, force);
    if (here > largest.value) largest = {here, e};
  }
  return {largest.value / couple_scale_, largest.element};
}

double RodMotion::restingResidual() const {
  double stiffest = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    const double stiffness = stretch_stiffness_.at(e).maxCoeff();
    stiffest = std::max(stiffest, stiffness * rest_length_sum_ * inverse_length_[e]);
  }
  const double round_off = std::numeric_limits<double>::epsilon() * stiffest * rest_length_sum_ / couple_scale_;
  return static_cast<double>(size()) * round_off;
}

double RodMotion::kineticEnergy() const {
  double sum = 0.0;
  for (std::size_t e = 0; e < size(); ++e) sum += 0.5 * velocity_.at(e).squaredNorm() / inverse_mass_[e];
  return sum + rotationalEnergy();
}

double RodMotion::rotationalEnergy() const {
  double sum = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    if (inverse_inertia_[e] == 0.0) continue;
    const double wx = angular_velocity_.x[e], wy = angular_velocity_.y[e], wz = angular_velocity_.z[e];
    sum += 0.5 * (wx * wx + wy * wy + 2.0 * wz * wz) / inverse_inertia_[e];
  }
  return sum;
}

double RodMotion::largestBend() const {
  double largest = 0.0;
  for (std::size_t e = first_bend_; e < size(); ++e) {
    largest = std::max(largest, rod::log(frame_.at(e).conjugate() * frame_.at(e + 1)).norm());
  }
  return largest;
}

}  // namespace sensory_growth::mechanics
