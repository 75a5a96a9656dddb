#include "sensory_growth/mechanics/rod_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/motion_formulas.h"

namespace sensory_growth::mechanics {
namespace {

using formulas::Frame;
using formulas::Triple;
using rod::Vector3;

template <typename Vectors>
Triple<double> load(const Vectors& v, std::size_t i) {
  return {v.x[i], v.y[i], v.z[i]};
}

template <typename Vectors>
void store(Vectors& v, std::size_t i, const Triple<double>& a) {
  v.x[i] = a.x;
  v.y[i] = a.y;
  v.z[i] = a.z;
}

template <typename Frames>
Frame<double> loadFrame(const Frames& f, std::size_t i) {
  return {f.w[i], load(f.v, i)};
}

template <typename Frames>
void storeFrame(Frames& f, std::size_t i, const Frame<double>& q) {
  f.w[i] = q.w;
  store(f.v, i, q.v);
}

/// Springs, walls and a held apex: TO BE CONNECTED to mechanics/surroundings.
Vector3 surroundingForce(const Surroundings&, std::size_t /*vertex*/, const Vector3& /*position*/) {
  return Vector3::Zero();
}

}  // namespace

void RodMotion::Vectors::resize(std::size_t n) {
  x.resize(n);
  y.resize(n);
  z.resize(n);
}

void RodMotion::Vectors::setZero() {
  std::fill(x.begin(), x.end(), 0.0);
  std::fill(y.begin(), y.end(), 0.0);
  std::fill(z.begin(), z.end(), 0.0);
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
  surroundings_ = loads.surroundings;
  share_ = 1.0;
  for (auto* scalars : {&rest_length_, &inverse_length_, &inverse_voronoi_, &inverse_mass_, &inverse_inertia_}) {
    scalars->resize(n);
  }
  for (Vectors* vectors : {&stretch_stiffness_, &rest_stretch_, &bend_stiffness_, &rest_curvature_, &dead_force_,
                           &dead_couple_, &velocity_, &angular_velocity_, &couple_, &applied_force_}) {
    vectors->resize(n);
  }
  for (Vectors* vectors : {&position_, &frame_.v, &force_, &lower_couple_}) vectors->resize(n + 1);
  frame_.w.resize(n + 1);
  current_length_.assign(n + 1, 0.0);
  force_.setZero();
  lower_couple_.setZero();
  dead_couple_.setZero();

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
  dead_couple_.set(n - 1, loads.tip_couple);
  if (rod.base_support == rod::BaseSupport::frozen_first_element) inverse_inertia_[0] = 0.0;

  const double weight_couple = total_force * rest_length_sum_;
  bending_scale_ = stiffest / rest_length_sum_;
  couple_scale_ = std::max(weight_couple, bending_scale_);
  energy_scale_ = weight_couple + bending_scale_;
  addUpForces();
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
  velocity_.setZero();
  angular_velocity_.setZero();
}

void RodMotion::setTimeStep(double dt, double damping) {
  dt_ = dt;
  decay_ = std::exp(-damping * dt);
  impulse_ = dt * std::exp(-0.5 * damping * dt);  // half of the decay before the force, half of it after
}

void RodMotion::drift(double dt) {
  for (std::size_t e = 0; e < size(); ++e) {
    store(position_, e + 1, load(position_, e + 1) + dt * load(velocity_, e));
    storeFrame(frame_, e + 1, formulas::turned(loadFrame(frame_, e + 1), dt * load(angular_velocity_, e)));
  }
}

void RodMotion::evaluate() {
  if (dilatation_) {
    measureLengths();
    evaluateAs<true>();
  } else {
    evaluateAs<false>();
  }
  if (!surroundings_.empty()) addUpForces();
}

template <bool kDilatation>
void RodMotion::evaluateAs() {
  for (std::size_t e = 0; e < size(); ++e) {
    const Frame<double> frame = loadFrame(frame_, e + 1);
    const Triple<double> v =
        formulas::stretchVector(frame, load(position_, e + 1) - load(position_, e), inverse_length_[e]);
    Triple<double> p = formulas::materialForce(v, load(rest_stretch_, e), load(stretch_stiffness_, e));
    formulas::BendCouples<double> bend =
        formulas::bendCouples(formulas::between(loadFrame(frame_, e), frame), inverse_voronoi_[e],
                              load(rest_curvature_, e), load(bend_stiffness_, e));
    if (kDilatation) {
      p = (rest_length_[e] / current_length_[e + 1]) * p;
      const double stretch = 0.5 * (current_length_[e] + current_length_[e + 1]) * inverse_voronoi_[e];
      const double scale = 1.0 / (stretch * stretch * stretch);
      bend = {scale * bend.lower, scale * bend.upper};
    }
    store(force_, e, formulas::toWorld(frame, p));
    store(couple_, e, rest_length_[e] * formulas::cross(v, p) - bend.upper);
    store(lower_couple_, e, bend.lower);
  }
}

void RodMotion::measureLengths() {
  for (std::size_t e = 0; e < size(); ++e) {
    const Triple<double> chord = load(position_, e + 1) - load(position_, e);
    current_length_[e + 1] = std::sqrt(formulas::dot(chord, chord));
  }
}

void RodMotion::addUpForces() {
  for (std::size_t e = 0; e < size(); ++e) {
    applied_force_.set(e, share_ * dead_force_.at(e) + surroundingForce(surroundings_, e + 1, position_.at(e + 1)));
  }
}

void RodMotion::kickAndDrift(double dt) {
  for (std::size_t e = 0; e < size(); ++e) {
    const Triple<double> force = load(applied_force_, e) + (load(force_, e + 1) - load(force_, e));
    const Triple<double> velocity = decay_ * load(velocity_, e) + (impulse_ * inverse_mass_[e]) * force;
    store(velocity_, e, velocity);
    store(position_, e + 1, load(position_, e + 1) + dt * velocity);

    // Moments of inertia are in the ratio 1:1:2. Half of the impulse comes before the precession, half after it, so
    // that the step can be reversed.
    const Triple<double> couple = load(dead_couple_, e) + (load(couple_, e) + load(lower_couple_, e + 1));
    const double scale = 0.5 * impulse_ * inverse_inertia_[e];
    const Triple<double> half{scale * couple.x, scale * couple.y, 0.5 * scale * couple.z};
    const Triple<double> turning = formulas::precessed(decay_ * load(angular_velocity_, e) + half, dt_) + half;
    store(angular_velocity_, e, turning);
    storeFrame(frame_, e + 1, formulas::turned(loadFrame(frame_, e + 1), dt * turning));
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

double RodMotion::residual() const {
  double largest = 0.0;
  double sum = 0.0;  // unlike the largest, it does not lose a NaN
  Vector3 beyond = Vector3::Zero();
  for (std::size_t e = size(); e-- > 0;) {
    beyond += freeForce(e);
    const double couple = freeCouple(e).norm();
    const double force = rest_length_sum_ * beyond.norm();
    largest = std::max({largest, couple, force});
    sum += couple + force;
  }
  return (std::isfinite(sum) ? largest : sum) / couple_scale_;
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
  for (std::size_t e = 0; e < size(); ++e) {
    largest = std::max(largest, rod::log(frame_.at(e).conjugate() * frame_.at(e + 1)).norm());
  }
  return largest;
}

}  // namespace sensory_growth::mechanics
