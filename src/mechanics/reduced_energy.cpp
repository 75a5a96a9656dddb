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

using BlockMatrix = Eigen::Matrix<double, kernels::kBlock, kernels::kBlock, Eigen::RowMajor>;
using BlockMap = Eigen::Map<Eigen::Matrix<double, 3, kernels::kBlock, Eigen::RowMajor>>;
using ConstBlockMap = Eigen::Map<const Eigen::Matrix<double, 3, kernels::kBlock, Eigen::RowMajor>>;

/// The same turn by an angle of at most pi.
Vector3 resolved(const Vector3& turn) { return turn.squaredNorm() < M_PI * M_PI ? turn : rod::log(rod::exp(turn)); }

void setLane(kernels::Packet (&packets)[3], std::size_t lane, const Vector3& value) {
  for (int i = 0; i < 3; ++i) packets[i].lane[lane] = value[i];
}

}  // namespace

template <std::size_t N>
void ReducedEnergy::Columns<N>::resize(std::size_t elements) {
  // An odd number of cache lines keeps the columns out of each other's way in the cache.
  const std::size_t lines = kernels::packetCount(elements) + 1;
  stride_ = kernels::kPacket * (lines | 1);
  data_.resize(N * stride_);
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
  packets_.resize(kernels::packetCount(n));
  view_ = {n, rod.base_support == rod::BaseSupport::frozen_first_element ? std::size_t{1} : 0, packets_.data()};
  factor_.resize(n);
  frames_.resize(n);
  trial_.resize(n);
  step_.resize(n);
  assignElements(rod);
  assignForces(rod, loads);
  clearPadding();
  assignCurvature(rod);
}

void ReducedEnergy::assignCurvature(const rod::Rod& rod) {
  double length_below = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    const double length = rod.elements[e].rest_length;
    const double voronoi = 0.5 * (length_below + length);
    const rod::Bend& bend = rod.bends[e];
    setLane(packets_[e / kernels::kPacket].rest_angle, e % kernels::kPacket, voronoi * bend.rest_curvature);
    step_.set(e, e < view_.first ? Vector3(Vector3::Zero()) : resolved(voronoi * bend.curvature));
    length_below = length;
  }
  for (std::size_t e = size(); e < packets_.size() * kernels::kPacket; ++e) step_.set(e, Vector3::Zero());
  kernels_->rebuild(view_, step_.view(), frames_.view());
}

void ReducedEnergy::assignElements(const rod::Rod& rod) {
  double stiffest = 0.0;
  double stiffness_below = 0.0;
  Vector3 compliance_below = Vector3::Zero();
  stiffness_scale_ = 0.0;
  rest_length_ = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    const rod::Element& element = rod.elements[e];
    kernels::RodPacket& packet = packets_[e / kernels::kPacket];
    const std::size_t lane = e % kernels::kPacket;
    const double length = element.rest_length;
    const Vector3 bend_stiffness = element.section.bendStiffness();
    const Vector3 compliance = 0.5 * length * bend_stiffness.cwiseInverse();  // of half the element
    Vector3 stiffness = (compliance_below + compliance).cwiseInverse();
    if (e < rod.firstBend()) stiffness.setZero();
    const Vector3 stretch_compliance = element.section.stretchCompliance() / length;

    setLane(packet.stiffness, lane, stiffness);
    setLane(packet.couple, lane, Vector3::Zero());
    setLane(packet.rest_stretch, lane, Vector3::UnitZ() + element.rest_strain);
    packet.compliance[0].lane[lane] = stretch_compliance.x();
    packet.compliance[1].lane[lane] = stretch_compliance.z();

    stiffest = std::max(stiffest, bend_stiffness.x());
    stiffness_scale_ = std::max(stiffness_scale_, stiffness_below + stiffness.maxCoeff());
    rest_length_ += length;
    stiffness_below = stiffness.maxCoeff();
    compliance_below = compliance;
  }
  frames_.set(-1, rod.base.frame);
  trial_.set(-1, rod.base.frame);
  bending_scale_ = stiffest / rest_length_;
  stiffness_scale_ = std::max(stiffness_scale_, bending_scale_);
}

void ReducedEnergy::assignForces(const rod::Rod& rod, const Loads& loads) {
  const std::size_t n = size();
  Vector3 carried = loads.tip_force;
  double total = 0.0;
  Vector3 above = loads.tip_force;  // on the vertex at the upper end, from the element beyond it
  for (std::size_t e = n; e-- > 0;) {
    const rod::Element& element = rod.elements[e];
    const Vector3 half = 0.5 * (element.mass() * loads.gravity + element.rest_length * loads.line_force);
    carried += half;
    total += (above + half).norm();
    setLane(packets_[e / kernels::kPacket].force, e % kernels::kPacket, element.rest_length * carried);
    carried += half;
    above = half;
  }
  total += above.norm();
  tip_couple_ = coupleOnLastElement(rod, loads);
  setLane(packets_[(n - 1) / kernels::kPacket].couple, (n - 1) % kernels::kPacket, tip_couple_);
  couple_scale_ = std::max({total * rest_length_, bending_scale_, tip_couple_.norm()});
}

void ReducedEnergy::clearPadding() {
  for (std::size_t e = size(); e < packets_.size() * kernels::kPacket; ++e) {
    double* packet = packets_[e / kernels::kPacket].stiffness[0].lane;
    constexpr std::size_t kRows = sizeof(kernels::RodPacket) / sizeof(kernels::Packet);
    for (std::size_t row = 0; row < kRows; ++row) packet[row * kernels::kPacket + e % kernels::kPacket] = 0.0;
  }
}

bool ReducedEnergy::factor(double shift, kernels::PivotInverse* room) {
  const kernels::Elimination elimination = kernels_->eliminate(view_, frames_.view(), shift, factor_.data(), room);
  if (elimination.positive) decrement_ = elimination.decrement;
  return elimination.positive;
}

bool ReducedEnergy::findStep(double shift) {
  step_is_spelled_out_ = false;
  return factor(shift, nullptr);
}

void ReducedEnergy::take(const kernels::Advance& advance) {
  largest_turn_ = advance.largest_turn;
  last_turn_ = Eigen::Map<const Vector3>(advance.last_turn);
}

ReducedEnergy::Evaluation ReducedEnergy::tryWholeStep() {
  const kernels::Advance advance = kernels_->advance(view_, factor_.data(), frames_.view(), trial_.view());
  take(advance);
  return advance.there;
}

void ReducedEnergy::tryWholeStepBlindly() {
  take(kernels_->advanceBlindly(view_, factor_.data(), frames_.view(), trial_.view()));
}

ReducedEnergy::Evaluation ReducedEnergy::tryStep(double scale) {
  if (!step_is_spelled_out_) kernels_->substitute(view_, factor_.data(), step_.view());
  step_is_spelled_out_ = true;
  kernels_->move(view_, frames_.view(), step_.view(), scale, trial_.view());
  return kernels_->evaluate(view_, trial_.view());
}

void ReducedEnergy::setStep(const TurnField& step) {
  step_is_spelled_out_ = true;
  largest_turn_ = 0.0;
  for (std::size_t e = 0; e < size(); ++e) {
    step_.set(e, step[e]);
    largest_turn_ = std::max(largest_turn_, step[e].norm());
  }
  last_turn_ = step.back();
}

void ReducedEnergy::writeTo(rod::Rod& rod) {
  // The step is done with: its memory serves as scratch.
  strain_.resize(size());
  chord_.resize(size());
  kernels_->strains(view_, frames_.view(), step_.view(), strain_.view(), chord_.view());
  Vector3 position = rod.base.position;
  double length_below = 0.0;
  rod.vertices.front().position = position;
  for (std::size_t e = 0; e < size(); ++e) {
    rod::Element& element = rod.elements[e];
    element.frame = frames_.at(static_cast<std::ptrdiff_t>(e));
    element.strain = strain_.at(e);
    rod.bends[e].curvature = step_.at(e) / (0.5 * (length_below + element.rest_length));
    rod.vertices[e + 1].position = position += element.rest_length * chord_.at(e);
    length_below = element.rest_length;
  }
}

double ReducedEnergy::leaning(std::size_t e) const {
  const double x = (static_cast<double>(e) + 0.5) / static_cast<double>(size());
  return x * (3.0 - x * x);  // nearly the sine of a cantilever's first mode
}

Vector3 ReducedEnergy::leaningAxis() const {
  const Vector3 tangent = frames_.at(-1) * Vector3::UnitZ();
  const Vector3 towards = std::abs(tangent.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
  return tangent.cross(towards);
}

TurnField ReducedEnergy::lean() const {
  const Vector3 axis = leaningAxis();
  TurnField field(size());
  for (std::size_t e = 0; e < size(); ++e) {
    field[e] = leaning(e) * (frames_.at(static_cast<std::ptrdiff_t>(e)).conjugate() * axis);
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

std::optional<double> ReducedEnergy::lowestEigenvalue(double shift) {
  // Inverse iteration with a block of vectors. The lowest eigenvalues of a slender rod belong to bending in two
  // directions, often equally easy, and to twist; with these three and one more in the block the next eigenvalue,
  // several times the first, decides how fast it converges.
  constexpr int kMaxIterations = 200;
  constexpr int kIterationsPerShift = 8;
  constexpr double kTolerance = 1e-4;  // of the change; the error is smaller by another order or two

  const std::size_t freedoms = 3 * (size() - view_.first);
  if (freedoms == 0) return stiffness_scale_;
  pivots_.resize(size());
  if (!factor(shift, pivots_.data())) return std::nullopt;
  const auto m = static_cast<Eigen::Index>(std::min(kernels::kBlock, freedoms));
  block_.resize(3 * kernels::kBlock * size());
  image_.resize(block_.size());
  const Vector3 axis = leaningAxis();
  const Vector3 other_axis = (frames_.at(-1) * Vector3::UnitZ()).cross(axis);
  for (std::size_t e = 0; e < size(); ++e) {
    const Quaternion world = frames_.at(static_cast<std::ptrdiff_t>(e)).conjugate();
    const double x = leaning(e);
    BlockMap fields(&block_[3 * kernels::kBlock * e]);
    fields << x * (world * axis), x * (world * other_axis), x * Vector3::UnitZ(), x * (x - 1.2) * (world * axis);
  }

  mix_.setIdentity(m, m);
  double lowest = 0.0;
  for (int iteration = 1; iteration <= kMaxIterations; ++iteration) {
    double mix[kernels::kBlock][kernels::kBlock] = {};
    BlockMatrix::Map(&mix[0][0]).topLeftCorner(m, m) = mix_;
    const kernels::BlockProducts products =
        kernels_->solveBlock(view_, factor_.data(), pivots_.data(), mix, block_.data(), image_.data());
    block_.swap(image_);
    // Y^T A Y = Y^T X, with X mixed as it went in.
    const SmallMatrix stiffness = BlockMatrix::Map(&products.yx[0][0]).topLeftCorner(m, m) * mix_.transpose();
    const SmallMatrix mass = BlockMatrix::Map(&products.yy[0][0]).topLeftCorner(m, m);
    ritz_.compute(0.5 * (stiffness + stiffness.transpose()), mass);
    mix_ = ritz_.eigenvectors().transpose();

    const double value = ritz_.eigenvalues()[0] - shift;
    const double change = std::abs(value - lowest);
    lowest = value;
    if (iteration > 1 && change <= kTolerance * std::abs(value) + 1e-15 * stiffness_scale_) break;
    if (iteration % kIterationsPerShift == 0) {
      // The Ritz value is an upper bound: a shift slightly beyond it sharpens the ratio to the next eigenvalue.
      const double closer = -value + 0.3 * std::abs(value) + change;
      if (closer < shift || shift == 0.0) {
        if (factor(closer, pivots_.data())) {
          shift = closer;
        } else if (!factor(shift, pivots_.data())) {
          break;
        }
      }
    }
  }
  return lowest;
}

TurnField ReducedEnergy::eigenvector(const TurnField& towards) const {
  constexpr double kDouble = 1e-3;  // eigenvalues closer than this, relative, are one
  const auto fields = [this](std::size_t e) -> Eigen::Matrix<double, 3, 2> {
    return ConstBlockMap(&block_[3 * kernels::kBlock * e]).leftCols(mix_.rows()) * mix_.topRows<2>().transpose();
  };
  // Of a double eigenvalue, the vector closest to the wanted direction; of a single one, the sign.
  Eigen::Vector2d overlap = Eigen::Vector2d::Zero();
  for (std::size_t e = 0; e < size(); ++e) overlap += fields(e).transpose() * towards[e];
  const auto& values = ritz_.eigenvalues();
  const bool is_double = values[1] - values[0] <= kDouble * std::abs(values[1]);
  const Eigen::Vector2d choice = is_double ? overlap.normalized() : Eigen::Vector2d(overlap[0] < 0.0 ? -1.0 : 1.0, 0.0);
  TurnField vector(size());
  for (std::size_t e = 0; e < size(); ++e) vector[e] = fields(e) * choice;
  return vector;
}

std::size_t ReducedEnergy::worstElement() const {
  TurnField gradient;
  std::vector<rod::Matrix3> diagonal, upper;
  blocks(gradient, diagonal, upper);
  std::size_t worst = 0;
  for (std::size_t e = 0; e < gradient.size(); ++e) {
    if (!gradient[e].allFinite()) return e;
    if (gradient[e].squaredNorm() > gradient[worst].squaredNorm()) worst = e;
  }
  return worst;
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
