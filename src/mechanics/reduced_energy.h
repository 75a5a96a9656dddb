#pragma once

/// Energy of a rod under dead loads as a function of its frames alone (model.md 12.2, 12.3).
///
/// For given frames the energy is quadratic in the strains, whose optimum is sigma = sigma0 + S^-1 p with p the element
/// force in the material frame. Perturbations are R_e -> R_e exp(w_e). The Hessian is block tridiagonal with 3x3
/// blocks; it is factored as it is made.

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "kernels/reduced_kernels.h"
#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// One rotation vector per element [rad], in material components.
using TurnField = std::vector<rod::Vector3>;

/// Owns the arrays of one relaxation and reuses their memory in the next.
class ReducedEnergy {
 public:
  using Evaluation = kernels::Evaluation;

  /// Takes the rod in the shape of its curvature, and what acts on it. Surroundings are not looked at.
  void assign(const rod::Rod& rod, const Loads& loads);

  /// Takes the curvature and the rest curvature alone, of a rod that is otherwise as it was assigned.
  void assignCurvature(const rod::Rod& rod);

  std::size_t size() const { return view_.size; }
  std::size_t firstFree() const { return view_.first; }  ///< element; those below are frozen

  /// At the current frames.
  Evaluation evaluate() const { return kernels_->evaluate(view_, frames_.view()); }

  /// Factors Hessian + shift * 1 at the current frames, which is all that is needed of the Newton step to take it.
  /// False if that matrix is not positive definite; there is no step then.
  bool findStep(double shift);

  double decrement() const { return decrement_; }  ///< minus the gradient times the Newton step [J]

  /// At the frames turned by the whole Newton step, which accept() makes the current ones.
  Evaluation tryWholeStep();

  /// The same without looking at what holds there.
  void tryWholeStepBlindly();

  /// At the frames turned by a part of the Newton step, or of the step set from outside.
  Evaluation tryStep(double scale);
  void accept() { frames_.swap(trial_); }

  /// Takes a step from outside in place of Newton's.
  void setStep(const TurnField& step);

  double largestTurn() const { return largest_turn_; }  ///< of an element in the step tried or set last [rad]

  /// Work of body couples along that step [J]; it is no part of the energy.
  double coupleWork() const { return tip_couple_.dot(last_turn_); }

  /// Writes frames, strains and positions of the current frames to the rod that was assigned.
  void writeTo(rod::Rod& rod);

  /// Lowest eigenvalue of the Hessian at the current frames [N m], to four digits, found by way of the factor of
  /// Hessian + shift * 1; nothing if that is not positive definite.
  std::optional<double> lowestEigenvalue(double shift);

  /// Vector of the lowest eigenvalue found last, of Euclidean norm 1. If the eigenvalue is double, as it is for a
  /// straight rod of circular section, the one closest to `towards`.
  TurnField eigenvector(const TurnField& towards) const;

  /// The rod leaning over, as a cantilever would, towards a fixed direction of the world at right angles to its base.
  TurnField lean() const;

  /// Turns that lead from the frames of `rod` to the current ones.
  TurnField turnsFrom(const rod::Rod& rod) const;

  const rod::Vector3& tipCouple() const { return tip_couple_; }  ///< in the frame of the last element [N m]
  double coupleScale() const { return couple_scale_; }           ///< max(W L, B / L), W the sum of the forces [N m]
  double bendingScale() const { return bending_scale_; }         ///< B / L: bends the rod by about a radian [N m]
  double stiffnessScale() const { return stiffness_scale_; }     ///< about the largest entry of the Hessian [N m]

  /// Element with the largest gradient, or the first where that is not finite. Allocates.
  std::size_t worstElement() const;

  /// Gradient and Hessian as a whole: blocks at (e, e) and at (e - 1, e).
  void blocks(TurnField& gradient, std::vector<rod::Matrix3>& diagonal, std::vector<rod::Matrix3>& upper) const;

 private:
  /// Columns of doubles, readable from index -1 to the end of the last packet.
  template <std::size_t N>
  class Columns {
   public:
    void resize(std::size_t elements);
    double* column(std::size_t i) { return data_.data() + i * stride_ + kLead; }
    const double* column(std::size_t i) const { return data_.data() + i * stride_ + kLead; }
    void swap(Columns& other) {
      data_.swap(other.data_);
      std::swap(stride_, other.stride_);
    }

   private:
    static constexpr std::size_t kLead = kernels::kPacket;
    std::vector<double> data_;
    std::size_t stride_ = 0;
  };

  struct FrameColumns : Columns<4> {
    rod::Quaternion at(std::ptrdiff_t e) const;
    void set(std::ptrdiff_t e, const rod::Quaternion& q);
    kernels::FrameView view() const;
  };
  struct TurnColumns : Columns<3> {
    rod::Vector3 at(std::size_t e) const { return {column(0)[e], column(1)[e], column(2)[e]}; }
    void set(std::size_t e, const rod::Vector3& w);
    kernels::TurnView view();
  };

  /// Up to kBlock rows and columns, on the stack.
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kernels::kBlock, kernels::kBlock>;

  bool factor(double shift, kernels::PivotInverse* room);
  void take(const kernels::Advance& advance);
  void assignElements(const rod::Rod& rod);
  void assignForces(const rod::Rod& rod, const Loads& loads);
  void clearPadding();
  double leaning(std::size_t e) const;
  rod::Vector3 leaningAxis() const;

  const kernels::ReducedKernels* kernels_ = nullptr;
  kernels::RodView view_;
  std::vector<kernels::RodPacket> packets_;
  FrameColumns frames_, trial_;
  TurnColumns step_, strain_, chord_;
  bool step_is_spelled_out_ = false;  ///< in step_; otherwise it is implied by factor_
  std::vector<kernels::FactorRow> factor_;
  std::vector<kernels::PivotInverse> pivots_;
  std::vector<double> block_, image_;
  SmallMatrix mix_;
  Eigen::GeneralizedSelfAdjointEigenSolver<SmallMatrix> ritz_;
  double rest_length_ = 0.0;
  rod::Vector3 tip_couple_ = rod::Vector3::Zero();
  rod::Vector3 last_turn_ = rod::Vector3::Zero();  ///< of the element at the apex in the step
  double decrement_ = 0.0, largest_turn_ = 0.0;
  double couple_scale_ = 0.0, bending_scale_ = 0.0, stiffness_scale_ = 0.0;
};

}  // namespace sensory_growth::mechanics
