#include "sensory_growth/mechanics/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "couple_newton.h"
#include "least_energy.h"
#include "reduced_energy.h"
#include "sensory_growth/mechanics/rest_shape.h"
#include "sensory_growth/mechanics/supported_equilibrium.h"
#include "thresholds.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using Evaluation = ReducedEnergy::Evaluation;

constexpr double kClose = 0.1;            // rad: a first step up to this is taken without a look where it leads
constexpr double kCloseToBalance = 1e-2;  // residual
constexpr int kIterationsToCouple = 40;
constexpr double kSmallStep = 1e-5;  // rad: the Hessian before such a step serves after it

bool hasLengths(const rod::Rod& rod) {
  return std::all_of(rod.elements.begin(), rod.elements.end(),
                     [](const rod::Element& e) { return e.rest_length > 0.0; });
}

double norm(const TurnField& field) {
  double sum = 0.0;
  for (const Vector3& w : field) sum += w.squaredNorm();
  return std::sqrt(sum);
}

/// Factors the Hessian, shifted if it is not positive. Returns the shift that served [N m], infinity if none did.
double factorShifted(ReducedEnergy& energy, double shift, double first) {
  const double largest = 1e9 * energy.stiffnessScale();
  while (!energy.findStep(shift)) {
    shift = shift > 0.0 ? 4.0 * shift : first;
    if (!(shift < largest)) return std::numeric_limits<double>::infinity();
  }
  return shift;
}

/// Newton's step from an energy that is convex or made so by a shift, which is remembered for the next one. The first
/// shift vanishes with the residual: at a buckled equilibrium the free azimuth makes the Hessian singular, and a shift
/// that stayed would stall the last iterations.
class ShiftedNewton {
 public:
  /// False if no finite shift serves.
  bool findStep(ReducedEnergy& energy, double residual) {
    // The lowest eigenvalues fall with the square of the number of elements, compared with the largest.
    const double slowest = std::min(1.0, 100.0 / static_cast<double>(energy.size()));
    const double vanishing = 1e-6 * slowest * slowest * std::min(1.0, 1e5 * residual);
    const double first = std::max(vanishing, 1e-16) * energy.stiffnessScale();
    used_ = factorShifted(energy, next_, first);
    next_ = used_ > 4.0 * first ? used_ / 4.0 : 0.0;
    return std::isfinite(used_);
  }

  double shift() const { return used_; }

 private:
  double used_ = 0.0;
  double next_ = 0.0;
};

/// Armijo backtracking on the true energy and the work of body couples. Returns the part of the step that was taken,
/// zero if none lowers the energy; `here` is then where it led.
double searchLine(ReducedEnergy& energy, double max_rotation, Evaluation& here) {
  const double noise = 1e-13 * here.magnitude;
  Evaluation there = energy.tryWholeStep();
  double scale = 1.0;
  if (energy.largestTurn() > max_rotation) {
    scale = max_rotation / energy.largestTurn();
    there = energy.tryStep(scale);
  }
  for (int halvings = 0; halvings < 40; ++halvings, there = energy.tryStep(scale *= 0.5)) {
    const double gain = here.energy - there.energy + scale * energy.coupleWork();
    if (there.largest_bend < kUnresolvable && gain >= kArmijo * scale * energy.decrement() - noise) {
      energy.accept();
      here = there;
      return scale;
    }
  }
  return 0.0;
}

/// Moves along the unstable direction to about the least energy.
void leaveAlong(ReducedEnergy& energy, const TurnField& direction, Evaluation& here) {
  energy.setStep(direction);
  const double unit = 1.0 / energy.largestTurn();
  const double angle = angleOfLeastEnergy(here.energy, [&](double trial) {
    const Evaluation there = energy.tryStep(trial * unit);
    return there.largest_bend < kUnresolvable ? there.energy : std::numeric_limits<double>::infinity();
  });
  here = energy.tryStep(angle * unit);
  energy.accept();
}

double measureStability(ReducedEnergy& energy) {
  const auto lowest = energy.lowestEigenvalue(0.0);
  if (lowest && *lowest > 1e-3 * energy.bendingScale() / static_cast<double>(energy.size())) return *lowest;
  // A free turn makes the Hessian singular; without a shift, round-off would decide whether it has a factor.
  const double first = 1e-12 * energy.stiffnessScale();
  const double shift = factorShifted(energy, first, first);
  return energy.lowestEigenvalue(shift).value_or(-energy.stiffnessScale());
}

/// Leaves an unstable equilibrium in the direction of the last increment, or of a fixed one if there was none.
void leaveUnstable(ReducedEnergy& energy, const rod::Rod& start, Evaluation& here) {
  constexpr double kNoIncrement = 1e-9;  // rad
  const TurnField increment = energy.turnsFrom(start);
  leaveAlong(energy, energy.eigenvector(norm(increment) > kNoIncrement ? increment : energy.lean()), here);
}

}  // namespace

struct StaticEquilibrium::Workspace {
  explicit Workspace(const RelaxationSettings& settings) : supported(settings) {}

  ReducedEnergy energy;
  SupportedEquilibrium supported;
};

StaticEquilibrium::StaticEquilibrium(const RelaxationSettings& settings)
    : settings_(settings), workspace_(std::make_unique<Workspace>(settings)) {}
StaticEquilibrium::~StaticEquilibrium() = default;
StaticEquilibrium::StaticEquilibrium(StaticEquilibrium&&) noexcept = default;
StaticEquilibrium& StaticEquilibrium::operator=(StaticEquilibrium&&) noexcept = default;

RelaxationReport StaticEquilibrium::approach(rod::Rod& rod, const Loads& loads, int iterations) {
  const bool has_energy = loads.surroundings.empty() && loads.tip_couple.isZero(0.0);
  if (!has_energy || !hasLengths(rod)) return relax(rod, loads, Stability::decided);
  ReducedEnergy& energy = workspace_->energy;
  energy.assign(rod, loads);
  RelaxationReport report;
  for (; report.iterations < iterations; ++report.iterations) {
    if (!energy.findStep(0.0)) return relax(rod, loads, Stability::decided);
    energy.tryWholeStepBlindly();
    if (!(energy.largestTurn() < kClose)) return relax(rod, loads, Stability::decided);
    energy.accept();
  }
  energy.writeTo(rod);
  return report;
}

RelaxationReport StaticEquilibrium::relax(rod::Rod& rod, const Loads& loads, Stability stability) {
  if (!loads.surroundings.empty()) return workspace_->supported.relax(rod, loads);
  if (!hasLengths(rod)) {
    RelaxationReport report;
    report.reason = RelaxationReason::not_finite;
    return report;
  }
  workspace_->energy.assign(rod, loads);
  return relaxAssigned(rod, loads, stability, false);
}

RelaxationReport StaticEquilibrium::relaxCorrected(rod::Rod& rod, const Loads& loads) {
  const bool has_energy = loads.surroundings.empty() && loads.tip_couple.isZero(0.0);
  if (!has_energy) return relax(rod, loads, Stability::decided);
  workspace_->energy.assignCurvature(rod);
  return relaxAssigned(rod, loads, Stability::decided, true);
}

RelaxationReport StaticEquilibrium::relaxAssigned(rod::Rod& rod, const Loads& loads, Stability stability,
                                                  bool is_close) {
  RelaxationReport report;
  ReducedEnergy& energy = workspace_->energy;
  const auto stop = [&report, &energy](RelaxationReason reason) {
    report.reason = reason;
    report.worst_element = energy.worstElement();
    return report;
  };
  // Forces of all elements beyond add up in each, so round-off grows with their number.
  const double round_off = 10.0 * static_cast<double>(rod.size()) * std::numeric_limits<double>::epsilon();
  const double stiffest = std::numeric_limits<double>::epsilon() * energy.stiffnessScale() / energy.coupleScale();
  const double tolerance = std::max({settings_.tolerance, round_off, stiffest});
  const bool is_hinged = rod.base_support == rod::BaseSupport::hinged;
  ShiftedNewton newton;
  bool factor_is_fresh = false;
  Evaluation here;
  if (is_close && energy.findStep(0.0) && (here = energy.tryWholeStep(), energy.largestTurn() < kClose)) {
    ++report.iterations;
    energy.accept();
    factor_is_fresh = energy.largestTurn() < kSmallStep && !is_hinged;
  } else {
    here = energy.evaluate();
  }
  // A rod that turns the couple which bends it goes down no energy. Steps that lower the energy and count the work of
  // the couple lead to the right balance, but slowly or not to its end; the last way is for steps to the balance
  // itself.
  const bool turns_a_couple = !loads.tip_couple.isZero(0.0);
  bool may_balance = turns_a_couple;
  int balance_from = kIterationsToCouple;
  const auto balance = [&] {
    const double largest_gradient = tolerance * energy.coupleScale();
    const bool found = balanceCouple(energy, largest_gradient, settings_.max_rotation, report.iterations);
    if (!found) energy.assignCurvature(rod);
    here = energy.evaluate();
    return found;
  };
  while (true) {
    report.residual = here.largest_gradient / energy.coupleScale();
    report.largest_bend = here.largest_bend;
    if (!std::isfinite(report.residual) || !std::isfinite(here.energy)) return stop(RelaxationReason::not_finite);

    if (report.residual < tolerance) {
      if (stability == Stability::decided && (factor_is_fresh || energy.findStep(0.0))) break;
      // What is left of the gradient shows up as an eigenvalue of the free azimuth of a buckled column; it is no
      // instability. Nor is what the part of a body couple that has no potential, of norm |M| / 2, may add.
      const double left = std::max(kUnstable * energy.bendingScale(), 10.0 * here.largest_gradient);
      const double neutral = left + 0.5 * loads.tip_couple.norm();
      const double lowest = measureStability(energy);
      report.lowest_eigenvalue = lowest;
      if (lowest >= -neutral) break;
      if (report.branch_switches == settings_.max_branch_switches) return stop(RelaxationReason::unstable);
      ++report.branch_switches;
      leaveUnstable(energy, rod, here);
      may_balance = turns_a_couple;
      balance_from = report.iterations + kIterationsToCouple;
      factor_is_fresh = false;
      continue;
    }

    const bool is_close_to_balance = may_balance && report.residual < kCloseToBalance && energy.findStep(0.0);
    if (may_balance && (is_close_to_balance || report.iterations >= balance_from)) {
      may_balance = false;
      if (balance() || balance()) continue;
    }
    if (report.iterations >= settings_.max_iterations) return stop(RelaxationReason::too_many_iterations);
    ++report.iterations;
    if (!newton.findStep(energy, report.residual)) return stop(RelaxationReason::not_finite);
    const double taken = searchLine(energy, settings_.max_rotation, here);
    if (taken == 0.0) return stop(RelaxationReason::line_search_failed);
    factor_is_fresh = !is_hinged && newton.shift() == 0.0 && taken * energy.largestTurn() < kSmallStep;
  }
  if (report.largest_bend > settings_.max_bend_angle) return stop(RelaxationReason::unresolved_bend);

  energy.writeTo(rod);
  return report;
}

RelaxationReport StaticEquilibrium::relaxInLoadSteps(rod::Rod& rod, const Loads& loads) {
  constexpr double kSmallestStep = 1.0 / 1024.0;
  rod::Rod trial = rod;
  RelaxationReport report = assumeRestShape(trial, settings_);
  if (!report.ok()) return report;

  double applied = 0.0;
  double step = 0.25;
  while (applied < 1.0) {
    const double next = std::min(1.0, applied + step);
    RelaxationReport part = relax(trial, scaled(loads, next));
    part.load_steps = report.load_steps + 1;
    part.iterations += report.iterations;
    part.branch_switches += report.branch_switches;
    report = part;
    if (part.ok()) {
      applied = next;
      step *= 1.5;
    } else if (step > kSmallestStep && part.reason != RelaxationReason::unresolved_bend) {
      step *= 0.5;
    } else {
      return report;
    }
  }
  rod = std::move(trial);
  return report;
}

const Reactions& StaticEquilibrium::reactions() const { return workspace_->supported.reactions(); }

double StaticEquilibrium::lowestEigenvalue(const rod::Rod& rod, const Loads& loads) {
  workspace_->energy.assign(rod, loads);
  return measureStability(workspace_->energy);
}

}  // namespace sensory_growth::mechanics
