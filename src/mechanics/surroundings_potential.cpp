#include "surroundings_potential.h"

#include <algorithm>
#include <cmath>

namespace sensory_growth::mechanics {

using rod::Matrix3;
using rod::Vector3;

Field positionsFromBase(const rod::Rod& rod) {
  Field positions(3, static_cast<Eigen::Index>(rod.vertices.size()));
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    positions.col(v) = rod.vertices[static_cast<std::size_t>(v)].position - rod.base.position;
  }
  return positions;
}

void SurroundingsPotential::assign(const rod::Rod& rod, const Surroundings& surroundings, double penalty) {
  surroundings_ = surroundings;
  for (Spring& spring : surroundings_.springs) spring.anchor -= rod.base.position;
  for (Wall& wall : surroundings_.walls) wall.point -= rod.base.position;
  if (surroundings_.held_apex) surroundings_.held_apex->position -= rod.base.position;
  penalty_ = penalty;
  is_rigid_ = surroundings.held_apex.has_value();
  for (const Wall& wall : surroundings.walls) is_rigid_ = is_rigid_ || std::isinf(wall.stiffness);

  tied_.clear();
  for (const Spring& spring : surroundings.springs) tied_.push_back(tiedVertex(rod, spring));
  contacts_.resize(surroundings.walls.size());
  for (std::vector<Contact>& contacts : contacts_) contacts.assign(rod.size() + 1, Contact());
  apex_multiplier_.setZero();
}

double SurroundingsPotential::stiffnessOf(const Wall& wall) const {
  return std::isinf(wall.stiffness) ? penalty_ : wall.stiffness;
}

double SurroundingsPotential::push(const Wall& wall, const Contact& contact) const {
  return std::max(0.0, contact.multiplier + stiffnessOf(wall) * contact.depth);
}

double SurroundingsPotential::evaluate(const Field& positions) {
  positions_ = positions;
  forces_.setZero(3, positions.cols());
  total_force_ = 0.0;
  double energy = 0.0;
  const auto add = [&](Eigen::Index vertex, const Vector3& force) {
    forces_.col(vertex) += force;
    total_force_ += force.norm();
  };

  for (std::size_t s = 0; s < tied_.size(); ++s) {
    const auto vertex = static_cast<Eigen::Index>(tied_[s]);
    if (vertex == 0) continue;
    const Spring& spring = surroundings_.springs[s];
    const Vector3 length = spring.anchor - positions.col(vertex);
    energy += 0.5 * spring.stiffness * length.squaredNorm();
    add(vertex, spring.stiffness * length);
  }

  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    const double k = stiffnessOf(wall);
    for (Eigen::Index v = 1; v < positions.cols(); ++v) {
      Contact& contact = contacts_[w][static_cast<std::size_t>(v)];
      contact.depth = wall.normal.dot(wall.point - positions.col(v));
      const double force = push(wall, contact);
      if (force > 0.0) {
        energy += (contact.multiplier + 0.5 * k * contact.depth) * contact.depth;
        add(v, force * wall.normal);
      } else if (contact.multiplier > 0.0) {
        energy -= 0.5 * contact.multiplier * contact.multiplier / k;
      }
    }
  }

  if (surroundings_.held_apex) {
    apex_gap_ = surroundings_.held_apex->position - positions.col(positions.cols() - 1);
    energy += (apex_multiplier_ + 0.5 * penalty_ * apex_gap_).dot(apex_gap_);
    add(positions.cols() - 1, apex_multiplier_ + penalty_ * apex_gap_);
  }
  return energy;
}

void SurroundingsPotential::writeStiffness(double emphasis, std::vector<ChainLink>& links) const {
  for (ChainLink& link : links) link.stiffness.setZero();
  for (std::size_t s = 0; s < tied_.size(); ++s) {
    if (tied_[s] > 0) links[tied_[s] - 1].stiffness.diagonal().array() += surroundings_.springs[s].stiffness;
  }
  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    const double k = std::isinf(wall.stiffness) ? emphasis * penalty_ : wall.stiffness;
    const Matrix3 across = k * wall.normal * wall.normal.transpose();
    for (std::size_t e = 0; e < links.size(); ++e) {
      if (push(wall, contacts_[w][e + 1]) > 0.0) links[e].stiffness += across;
    }
  }
  if (surroundings_.held_apex) links.back().stiffness.diagonal().array() += emphasis * penalty_;
}

double SurroundingsPotential::largestStiffness() const {
  double largest = surroundings_.held_apex ? penalty_ : 0.0;
  for (const Spring& spring : surroundings_.springs) largest = std::max(largest, spring.stiffness);
  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    const auto touches = [&](const Contact& contact) { return push(wall, contact) > 0.0; };
    if (std::any_of(contacts_[w].begin(), contacts_[w].end(), touches)) largest = std::max(largest, stiffnessOf(wall));
  }
  return largest;
}

double SurroundingsPotential::violation() const {
  double largest = surroundings_.held_apex ? apex_gap_.norm() : 0.0;
  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    if (!std::isinf(wall.stiffness)) continue;
    for (const Contact& contact : contacts_[w]) {
      largest = std::max(largest, std::abs(push(wall, contact) - contact.multiplier) / penalty_);
    }
  }
  return largest;
}

void SurroundingsPotential::updateMultipliers() {
  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    if (!std::isinf(wall.stiffness)) continue;
    for (Contact& contact : contacts_[w]) contact.multiplier = push(wall, contact);
  }
  if (surroundings_.held_apex) apex_multiplier_ += penalty_ * apex_gap_;
}

void SurroundingsPotential::setPenalty(double penalty) { penalty_ = penalty; }

Reactions SurroundingsPotential::reactions() const {
  Reactions reactions;
  for (std::size_t s = 0; s < tied_.size(); ++s) {
    const Spring& spring = surroundings_.springs[s];
    const auto vertex = static_cast<Eigen::Index>(tied_[s]);
    reactions.springs.push_back(spring.stiffness * (spring.anchor - positions_.col(vertex)));
  }
  for (std::size_t w = 0; w < contacts_.size(); ++w) {
    const Wall& wall = surroundings_.walls[w];
    double sum = 0.0;
    for (const Contact& contact : contacts_[w]) sum += push(wall, contact);
    reactions.walls.push_back(sum * wall.normal);
  }
  if (surroundings_.held_apex) reactions.apex_force = apex_multiplier_ + penalty_ * apex_gap_;
  return reactions;
}

}  // namespace sensory_growth::mechanics
