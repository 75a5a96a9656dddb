#include "reduced_energy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "sensory_growth/mechanics/energy.h"

namespace sensory_growth::mechanics {

using rod::Quaternion;
using rod::Vector3;

namespace {

void setLane(kernels::Packet (&packets)[3], std::size_t lane, const Vector3& value) {
  for (int i = 0; i < 3; ++i) packets[i].lane[lane] = value[i];
}

}  // namespace

template <std::size_t N>
void ReducedEnergy::Columns<N>::resize(std::size_t elements) {
  // An odd number of cache lines keeps the columns out of each other's way in the cache.
  const std::size_t lines = kernels::packetCount(elements) + 1;
  stride_ = kernels::kPacket * (lines | 1);
  data_.assign(N * stride_, 0.0);
}

Quaternion ReducedEnergy::FrameColumns::at(std::ptrdiff_t e) const {
  return {column(0)[e], column(1)[e], column(2)[e], column(3)[e]};
}

void ReducedEnergy::FrameColumns::set(std::ptrdiff_t e, const Quaternion& q) {
  column(0)[e] = q.w();
  column(1)[e] = q.x();
  column(2)[e] = q.y();
  column(3)[e] = q.z();
}

kernels::FrameView ReducedEnergy::FrameColumns::view() const {
  // A view is for reading unless it is given to ReducedKernels::move.
  auto& columns = const_cast<FrameColumns&>(*this);
  return {{columns.column(0), columns.column(1), columns.column(2), columns.column(3)}};
}

void ReducedEnergy::TurnColumns::set(std::size_t e, const Vector3& w) {
  for (int i = 0; i < 3; ++i) column(i)[e] = w[i];
}

kernels::TurnView ReducedEnergy::TurnColumns::view() { return {{column(0), column(1), column(2)}}; }

void ReducedEnergy::assign(const rod::Rod& rod, const Loads& loads) {
  const std::size_t n = rod.size();
  kernels_ = &kernels::reducedKernels();
  packets_.assign(kernels::packetCount(n), {});
  view_ = {n, rod.base_support == rod::BaseSupport::frozen_first_element ? std::size_t{1} : 0, packets_.data()};
  factor_.resize(n);
  frames_.resize(n);
  trial_.resize(n);
  step_.resize(n);

  elementForces(rod, loads, forces_);
  double stiffest = 0.0;
  stiffness_scale_ = 0.0;
  double stiffness_below = 0.0;
  for (std::size_t e = 0; e < n; ++e) {
    const rod::Element& element = rod.elements[e];
    kernels::RodPacket& packet = packets_[e / kernels::kPacket];
    const std::size_t lane = e % kernels::kPacket;
    const double length = element.rest_length;
    const double voronoi = rod.voronoiLength(e);
    const Vector3 stiffness = bendStiffness(rod, e);
    const Vector3 compliance = element.section.stretchCompliance() / length;
    setLane(packet.stiffness, lane, stiffness / voronoi);
    setLane(packet.rest_angle, lane, voronoi * rod.bends[e].rest_curvature);
    setLane(packet.force, lane, length * forces_[e]);
    setLane(packet.couple, lane, e + 1 == n ? loads.tip_couple : Vector3::Zero());
    setLane(packet.rest_stretch, lane, Vector3::UnitZ() + element.rest_strain);
    packet.compliance[0].lane[lane] = compliance.x();
    packet.compliance[1].lane[lane] = compliance.z();
    frames_.set(static_cast<std::ptrdiff_t>(e), element.frame);
    stiffest = std::max(stiffest, stiffness.head<2>().maxCoeff());
    const double stiffness_above = stiffness.maxCoeff() / voronoi;
    stiffness_scale_ = std::max(stiffness_scale_, stiffness_below + stiffness_above);
    stiffness_below = stiffness_above;
  }
  frames_.set(-1, rod.base.frame);
  trial_.set(-1, rod.base.frame);
  if (view_.first == 1) frames_.set(0, rod.base.frame);
  for (std::size_t e = n; e < packets_.size() * kernels::kPacket; ++e) {
    frames_.set(static_cast<std::ptrdiff_t>(e), rod.elements.back().frame);
  }

  double total_force = 0.0;
  for (std::size_t v = 0; v <= n; ++v) total_force += vertexForce(rod, loads, v).norm();
  const double L = rod.restLength();
  bending_scale_ = stiffest / L;
  couple_scale_ = std::max({total_force * L, bending_scale_, loads.tip_couple.norm()});
}

bool ReducedEnergy::findStep(double shift) {
  const kernels::Elimination elimination = kernels_->eliminate(view_, frames_.view(), shift, factor_.data());
  if (!elimination.positive) return false;
  decrement_ = elimination.decrement;
  largest_turn_ = kernels_->substitute(view_, factor_.data(), step_.view());
  return true;
}

void ReducedEnergy::setStep(const TurnField& step) {
  largest_turn_ = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    step_.set(e, step[e]);
    largest_turn_ = std::max(largest_turn_, step[e].norm());
  }
}

ReducedEnergy::Evaluation ReducedEnergy::tryStep(double scale) {
  kernels_->move(view_, frames_.view(), step_.view(), scale, trial_.view());
  return kernels_->evaluate(view_, trial_.view());
}

void ReducedEnergy::writeTo(rod::Rod& rod) {
  // The step and the trial are done with: their memory serves as scratch.
  strain_.resize(size());
  kernels_->strains(view_, frames_.view(), step_.view(), strain_.view());
  for (std::size_t e = 0; e < size(); ++e) {
    rod.elements[e].frame = frames_.at(static_cast<std::ptrdiff_t>(e));
    rod.elements[e].strain = strain_.at(e);
    rod.bends[e].curvature = step_.at(e) / rod.voronoiLength(e);
  }
  rod.rebuildPositions();
}

TurnField ReducedEnergy::lean() const {
  const Vector3 tangent = frames_.at(-1) * Vector3::UnitZ();
  const Vector3 towards = std::abs(tangent.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 axis = tangent.cross(towards);
  TurnField field(size());
  for (std::size_t e = 0; e < size(); ++e) {
    field[e] = (static_cast<double>(e) + 0.5) * (frames_.at(static_cast<std::ptrdiff_t>(e)).conjugate() * axis);
  }
  return field;
}

TurnField ReducedEnergy::turnsFrom(const rod::Rod& rod) const {
  TurnField field(size());
  for (std::size_t e = 0; e < size(); ++e) {
    field[e] = rod::log(rod.elements[e].frame.conjugate() * frames_.at(static_cast<std::ptrdiff_t>(e)));
  }
  return field;
}

Eigenpair ReducedEnergy::lowestEigenpair(double shift, const TurnField& towards) {
  // Inverse iteration with two vectors at once: the two directions in which a slender rod can fall are often equally
  // good, and with both of them the third eigenvalue, about nine times the first, decides how fast it converges.
  constexpr int kMaxIterations = 200;
  constexpr int kIterationsPerShift = 8;
  constexpr double kTolerance = 1e-6;  // of the eigenvalue
  constexpr double kDouble = 1e-4;     // eigenvalues closer than this, relative, are one

  using Eigen::Matrix2d;
  using Pair = Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic>>;
  const std::size_t n = size();
  const Vector3 tangent = frames_.at(-1) * Vector3::UnitZ();
  const TurnField start = lean();
  pair_.resize(6 * n);
  for (std::size_t e = 0; e < n; ++e) {
    const Quaternion frame = frames_.at(static_cast<std::ptrdiff_t>(e));
    const Vector3 other = frame.conjugate() * tangent.cross(frame * start[e]);
    for (int i = 0; i < 3; ++i) {
      pair_[6 * e + 2 * i] = start[e][i];
      pair_[6 * e + 2 * i + 1] = other[i];
    }
  }

  Eigenpair lowest;
  Pair y(pair_.data(), 2, static_cast<Eigen::Index>(3 * n));
  Eigen::Vector2d values = Eigen::Vector2d::Zero();
  for (int iteration = 1; iteration <= kMaxIterations; ++iteration) {
    before_ = pair_;
    kernels_->solvePair(view_, factor_.data(), pair_.data());
    const Pair x(before_.data(), 2, y.cols());
    const Matrix2d stiffness = 0.5 * (y * x.transpose() + x * y.transpose());
    const Matrix2d mass = y * y.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix2d> ritz(stiffness, mass);
    values = ritz.eigenvalues();
    y = (ritz.eigenvectors().transpose() * y).eval();
    const double value = values[0] - shift;
    const double change = std::abs(value - lowest.value);
    lowest.value = value;
    if (iteration > 1 && change <= kTolerance * std::abs(value) + 1e-15 * stiffness_scale_) break;
    if (iteration % kIterationsPerShift == 0) {
      // The Ritz value is an upper bound: a shift slightly beyond it sharpens the ratio to the next eigenvalue.
      const double closer = -value + 0.3 * std::abs(value) + change;
      if (closer < shift || shift == 0.0) {
        if (findStep(closer)) {
          shift = closer;
        } else {
          findStep(shift);
        }
      }
    }
  }

  // Of a double eigenvalue, the vector closest to the wanted direction; of a single one, the sign.
  Eigen::Vector2d overlap = Eigen::Vector2d::Zero();
  for (std::size_t e = 0; e < n; ++e) overlap += y.middleCols<3>(static_cast<Eigen::Index>(3 * e)) * towards[e];
  const bool is_double = values[1] - values[0] <= kDouble * std::abs(values[1]);
  const Eigen::Vector2d mix = is_double ? overlap.normalized() : Eigen::Vector2d(overlap[0] < 0.0 ? -1.0 : 1.0, 0.0);
  lowest.vector.resize(n);
  for (std::size_t e = 0; e < n; ++e) {
    lowest.vector[e] = y.middleCols<3>(static_cast<Eigen::Index>(3 * e)).transpose() * mix;
  }
  return lowest;
}

void ReducedEnergy::blocks(TurnField& gradient, std::vector<rod::Matrix3>& diagonal,
                           std::vector<rod::Matrix3>& upper) const {
  const std::size_t n = size();
  std::vector<double> g(3 * n), d(6 * n), u(9 * n);
  kernels_->blocks(view_, frames_.view(), reinterpret_cast<double(*)[3]>(g.data()),
                   reinterpret_cast<double(*)[6]>(d.data()), reinterpret_cast<double(*)[9]>(u.data()));
  gradient.resize(n);
  diagonal.resize(n);
  upper.resize(n);
  for (std::size_t e = 0; e < n; ++e) {
    gradient[e] = Eigen::Map<const Vector3>(&g[3 * e]);
    const double* s = &d[6 * e];
    diagonal[e] << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
    upper[e] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&u[9 * e]);
  }
}

}  // namespace sensory_growth::mechanics
