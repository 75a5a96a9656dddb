#include "sensory_growth/mechanics/supported_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "chain_cholesky.h"
#include "least_energy.h"
#include "supported_energy.h"
#include "thresholds.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

constexpr double kEigenvalueTolerance = 1e-6;
constexpr double kTwist = 0.1;  // of what an eigenvector search starts from, or it would not find a mode of twist
constexpr double kReportTolerance = 1e-3;  // on the lowest eigenvalue of a rod whose factor has shown it to be stable

constexpr double kFar = 1e-2;             // of the length: beyond this rigid surroundings start out soft
constexpr double kSoft = 1e-2;            // of the penalty, for that
constexpr double kFirstTolerance = 1e-3;  // on the residual, in the first round
constexpr double kTighter = 1e-2;         // of the tolerance is left for the next round
constexpr double kProgress = 0.1;         // of the violation is left by a round, or the penalty grows
constexpr double kPenaltyGrowth = 10.0;
constexpr double kLargestPenalty = 1e8;   // over the first: the rod cannot reach what holds it
constexpr double kTestedStiffness = 1e4;  // times the penalty: nearly rigid, where stability is judged
constexpr double kLargestShift = 1e6;     // of the diagonal: far beyond what makes any Hessian positive

/// Rigid surroundings are met in rounds; in each their forces stay as they are but for the penalty.
struct Round {
  double tolerance = 0.0;                                      ///< on the residual [-]
  double violation = std::numeric_limits<double>::infinity();  ///< that the round before left [m]
  double support_tolerance = 0.0;                              ///< on the violation [m]
  double largest_penalty = 0.0;                                ///< [N/m]
};

bool isFinite(const rod::Rod& rod, const Loads& loads) {
  bool finite = loads.gravity.allFinite() && loads.tip_force.allFinite() && loads.line_force.allFinite() &&
                loads.tip_couple.allFinite() && rod.base.position.allFinite() && rod.base.frame.coeffs().allFinite();
  for (const rod::Element& e : rod.elements) {
    const bool has_length = std::isfinite(e.rest_length) && e.rest_length > 0.0;
    finite = finite && has_length && std::isfinite(e.mass()) && e.section.bendStiffness().allFinite() &&
             e.section.stretchCompliance().allFinite() && e.rest_strain.allFinite() && e.strain.allFinite() &&
             e.frame.coeffs().allFinite();
  }
  for (const rod::Bend& b : rod.bends) finite = finite && b.rest_curvature.allFinite();
  for (const Spring& s : loads.surroundings.springs) {
    finite = finite && std::isfinite(s.stiffness) && s.anchor.allFinite() && std::isfinite(s.label);
  }
  for (const Wall& w : loads.surroundings.walls) {
    finite = finite && w.point.allFinite() && w.normal.allFinite() && !std::isnan(w.stiffness);
  }
  if (const auto& apex = loads.surroundings.held_apex) {
    finite = finite && apex->position.allFinite() && (!apex->frame || apex->frame->coeffs().allFinite());
  }
  return finite;
}

double largestColumn(const Field& field) { return field.colwise().norm().maxCoeff(); }

}  // namespace

struct SupportedEquilibrium::Workspace {
  SupportedEnergy energy;
  Variation gradient, step;
  ChainHessian hessian;
  ChainCholesky factor;
  Configuration here, trial;
  Reactions reactions;
  Round round;
  Vector3 first_side, second_side;  ///< directions of the world across the base: where columns buckle

  /// The rod as it stands. Inextensible elements have their rest strain.
  void readConfiguration(const rod::Rod& rod) {
    here.frames.resize(rod.size());
    here.strains.resize(3, static_cast<Eigen::Index>(rod.size()));
    for (std::size_t e = 0; e < rod.size(); ++e) {
      const rod::Element& element = rod.elements[e];
      here.frames[e] = element.frame;
      here.strains.col(static_cast<Eigen::Index>(e)) =
          element.section.inextensible ? element.rest_strain : element.strain;
    }
    if (rod.base_support == rod::BaseSupport::frozen_first_element) here.frames.front() = rod.base.frame;

    const Vector3 tangent = rod.base.frame * Vector3::UnitZ();
    first_side = std::abs(tangent.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
    first_side = (first_side - tangent * tangent.dot(first_side)).normalized();
    second_side = tangent.cross(first_side);
  }

  /// Twists and bends the rod evenly until its apex has the frame that holds it, so that no bend is beyond what a
  /// rotation vector can tell.
  void turnTowards(const rod::Quaternion& held) {
    const Vector3 missing = rod::log(held * here.frames.back().conjugate());
    const auto n = static_cast<double>(here.frames.size());
    for (std::size_t e = 0; e < here.frames.size(); ++e) {
      here.frames[e] = (rod::exp((static_cast<double>(e) + 0.5) / n * missing) * here.frames[e]).normalized();
    }
  }

  double tryStep(double scale) {
    trial.frames.resize(here.frames.size());
    for (std::size_t e = 0; e < here.frames.size(); ++e) {
      const Vector3 w = step.rotations.col(static_cast<Eigen::Index>(e));
      trial.frames[e] = (here.frames[e] * rod::exp(scale * w)).normalized();
    }
    trial.strains = here.strains + scale * step.strains;
    const double value = energy.evaluate(trial);
    if (!(energy.largestBend() < kUnresolvable)) return std::numeric_limits<double>::infinity();
    // The couple on the apex has no potential, but along this path it does this work.
    return value - scale * energy.tipCouple().dot(step.rotations.rightCols<1>());
  }

  void takeTrial() { std::swap(here, trial); }

  /// Newton direction; an indefinite Hessian is shifted until it is positive. The shift is remembered between
  /// iterations. The first one vanishes with the residual: at a buckled equilibrium the free azimuth makes the Hessian
  /// singular, and a shift that stayed would stall the last iterations. There is always a tiny one, far below the
  /// stiffness of the rod as a whole, because a hinged rod may turn about itself. False where no shift helps.
  bool newtonDirection(double residual, double& shift) {
    const double scale = hessian.largestDiagonal();
    const double first = std::max(1e-6 * std::min(1.0, 1e5 * residual), 1e-14);
    const double least = 1e-9 * energy.bendingScale() / static_cast<double>(energy.size());
    double tau = shift;
    while (!factor.factor(hessian, tau * scale + least)) {
      tau = tau > 0.0 ? 4.0 * tau : first;
      if (tau > kLargestShift) return false;
    }
    shift = tau > 4.0 * first ? tau / 4.0 : 0.0;
    energy.newtonStep(hessian, factor, gradient, step);
    return true;
  }

  /// Armijo backtracking on the true energy. True if a step was taken.
  bool lineSearch(double value, double max_rotation) {
    const double slope = gradient.dot(step);
    const double noise = 1e-13 * energy.magnitude();
    double scale = std::min(1.0, max_rotation / largestColumn(step.rotations));
    for (int halvings = 0; halvings < 40; ++halvings, scale *= 0.5) {
      if (tryStep(scale) <= value + kArmijo * scale * slope + noise) {
        takeTrial();
        return true;
      }
    }
    return false;
  }

  /// A rod leaning over towards a fixed direction of the world, as material rotations. Eigenvector searches that start
  /// from it find a reproducible direction of buckling when every direction is equally good.
  Field lean(const Vector3& towards) const {
    const Vector3 axis = first_side.cross(second_side).cross(towards);
    Field field(3, here.strains.cols());
    for (Eigen::Index e = 0; e < field.cols(); ++e) {
      field.col(e) = (static_cast<double>(e) + 0.5) *
                     (here.frames[static_cast<std::size_t>(e)].conjugate() * axis + kTwist * Vector3::UnitZ());
    }
    return field;
  }

  /// How far the vertices of a buckling rod go towards a side, summed.
  double bulge(const ChainResponse& mode, const Vector3& side) const {
    Vector3 displacement = Vector3::Zero();
    double sum = 0.0;
    for (std::size_t e = 0; e < hessian.links.size(); ++e) {
      displacement += hessian.links[e].lever * mode.rotations.col(static_cast<Eigen::Index>(e));
      sum += displacement.dot(side);
    }
    return sum;
  }

  /// Lowest eigenpair, searched from two leanings at right angles so that no symmetry can hide it. The mode bulges to
  /// the side it was searched from.
  ChainEigenpair lowestEigenpair(double tolerance) const {
    const auto search = [&](const Vector3& side) {
      ChainEigenpair pair = mechanics::lowestEigenpair(hessian, lean(side), tolerance);
      if (bulge(pair.response, side) < 0.0) {
        pair.response.rotations *= -1.0;
        pair.response.forces *= -1.0;
      }
      return pair;
    };
    const ChainEigenpair one = search(first_side);
    const ChainEigenpair other = search(second_side);
    const bool clearly_lower = other.value < one.value - 10.0 * tolerance * std::abs(one.value);
    return clearly_lower ? other : one;
  }

  /// What is left of the gradient shows up as an eigenvalue of the free azimuth of a buckled column; it is no
  /// instability.
  double neutral() const {
    return std::max(kUnstable * energy.bendingScale(), 10.0 * largestColumn(gradient.rotations));
  }

  /// Moves along the unstable direction to about the least energy.
  void leaveAlong(const ChainEigenpair& pair, double value) {
    step.rotations = pair.response.rotations;
    step.strains = energy.strainsOf(pair.response);
    const double unit = 1.0 / largestColumn(step.rotations);
    const double angle = angleOfLeastEnergy(value, [&](double trial_angle) { return tryStep(trial_angle * unit); });
    tryStep(angle * unit);
    takeTrial();
  }

  /// Rigid surroundings that are far off start out soft.
  void startFirstRound(double rest_length) {
    energy.evaluate(here);
    SurroundingsPotential& surroundings = energy.surroundings();
    round = Round();
    round.tolerance = surroundings.isRigid() ? kFirstTolerance : 0.0;
    round.support_tolerance = kSupportTolerance * rest_length;
    round.largest_penalty = kLargestPenalty * surroundings.penalty();
    if (surroundings.violation() > kFar * rest_length) surroundings.setPenalty(kSoft * surroundings.penalty());
  }

  bool meetsSupports() { return energy.surroundings().violation() <= round.support_tolerance; }

  /// Corrects the forces of rigid surroundings. False if the rod cannot reach them.
  bool startNextRound() {
    SurroundingsPotential& surroundings = energy.surroundings();
    const double violation = surroundings.violation();
    surroundings.updateMultipliers();
    const bool stalls = violation > std::max(round.support_tolerance, kProgress * round.violation);
    if (stalls) surroundings.setPenalty(kPenaltyGrowth * surroundings.penalty());
    round.violation = violation;
    round.tolerance *= kTighter;
    return surroundings.penalty() <= round.largest_penalty;
  }

  bool isStable() { return factor.factor(hessian, neutral()); }

  /// True if it is only for the softness of rigid surroundings that the equilibrium is unstable; they are then made
  /// stiffer.
  bool isStableIfStiffer() {
    energy.differentiateTwice(kTestedStiffness, hessian);
    if (!isStable()) return false;
    energy.surroundings().setPenalty(kPenaltyGrowth * energy.surroundings().penalty());
    return true;
  }

  /// Needs a call of isStableIfStiffer(), so that the direction respects rigid surroundings.
  void leaveUnstable() {
    const ChainEigenpair lowest = lowestEigenpair(kEigenvalueTolerance);
    energy.surroundings().updateMultipliers();
    leaveAlong(lowest, energy.evaluate(here));
    round.tolerance *= kTighter;
  }

  void writeRod(rod::Rod& rod) const {
    for (std::size_t e = 0; e < rod.size(); ++e) {
      rod.elements[e].frame = here.frames[e];
      rod.elements[e].strain = here.strains.col(static_cast<Eigen::Index>(e));
      rod.bends[e].curvature = energy.curvature(e);
    }
    rod.rebuildPositions();
  }
};

SupportedEquilibrium::SupportedEquilibrium(const RelaxationSettings& settings)
    : settings_(settings), workspace_(std::make_unique<Workspace>()) {}
SupportedEquilibrium::~SupportedEquilibrium() = default;
SupportedEquilibrium::SupportedEquilibrium(SupportedEquilibrium&&) noexcept = default;
SupportedEquilibrium& SupportedEquilibrium::operator=(SupportedEquilibrium&&) noexcept = default;

const Reactions& SupportedEquilibrium::reactions() const { return workspace_->reactions; }

RelaxationReport SupportedEquilibrium::relax(rod::Rod& rod, const Loads& loads) {
  Workspace& w = *workspace_;
  RelaxationReport report;
  const auto stop = [&report](RelaxationReason reason) {
    report.reason = reason;
    return report;
  };
  if (!isFinite(rod, loads)) return stop(RelaxationReason::not_finite);

  rod.rebuild();
  w.energy.assign(rod, loads);
  w.readConfiguration(rod);
  if (loads.surroundings.held_apex && loads.surroundings.held_apex->frame) {
    w.turnTowards(*loads.surroundings.held_apex->frame);
  }

  w.startFirstRound(rod.restLength());

  // A couple does work that depends on the path, so that no Hessian decides about stability: the unstable direction is
  // tried once, and where the rod ends then is taken.
  const bool is_conservative = loads.tip_couple.isZero(0.0);
  // Forces of all elements beyond add up in each, so round-off grows with their number.
  const double round_off = 10.0 * static_cast<double>(rod.size()) * std::numeric_limits<double>::epsilon();
  double shift = 0.0;
  while (true) {
    const double value = w.energy.evaluate(w.here);
    w.energy.differentiate(w.gradient);
    const Residual residual = w.energy.residual(w.gradient);
    report.residual = residual.value;
    report.worst_element = residual.element;
    report.largest_bend = w.energy.largestBend();
    if (!std::isfinite(report.residual) || !std::isfinite(value)) return stop(RelaxationReason::not_finite);

    const double tolerance = std::max({settings_.tolerance, round_off, w.energy.residualRoundOff()});
    w.energy.differentiateTwice(1.0, w.hessian);
    if (!w.hessian.isFinite()) return stop(RelaxationReason::not_finite);

    if (report.residual < std::max(tolerance, w.round.tolerance)) {
      if ((is_conservative || report.branch_switches == 0) && !w.isStable()) {
        if (w.isStableIfStiffer()) continue;
        if (report.branch_switches == settings_.max_branch_switches) return stop(RelaxationReason::unstable);
        ++report.branch_switches;
        w.leaveUnstable();
        continue;
      }
      if (report.residual < tolerance && w.meetsSupports()) break;
      if (!w.startNextRound()) return stop(RelaxationReason::out_of_reach);
      continue;
    }

    if (report.iterations == settings_.max_iterations) return stop(RelaxationReason::too_many_iterations);
    ++report.iterations;
    const bool has_direction = w.newtonDirection(report.residual, shift);
    if (!has_direction || !w.lineSearch(value, settings_.max_rotation))
      return stop(RelaxationReason::line_search_failed);
  }
  if (report.largest_bend > settings_.max_bend_angle) return stop(RelaxationReason::unresolved_bend);

  w.energy.differentiateTwice(kTestedStiffness, w.hessian);
  report.lowest_eigenvalue = w.lowestEigenpair(kReportTolerance).value;
  w.reactions = w.energy.reactions();
  w.writeRod(rod);
  return report;
}

}  // namespace sensory_growth::mechanics
