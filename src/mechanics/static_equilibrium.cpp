#include "sensory_growth/mechanics/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reduced_energy.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;
using Evaluation = ReducedEnergy::Evaluation;

constexpr double kArmijo = 1e-4;
constexpr double kUnstable = 1e-9;     // of B / L: eigenvalues below minus this are unstable, model.md 12.4
constexpr double kUnresolvable = 3.0;  // rad: near pi the rotation vector of a bend jumps

bool isFinite(const rod::Rod& rod, const Loads& loads) {
  bool finite = loads.gravity.allFinite() && loads.tip_force.allFinite() && loads.line_force.allFinite() &&
                loads.tip_couple.allFinite() && rod.base.frame.coeffs().allFinite();
  for (const rod::Element& e : rod.elements) {
    const bool has_length = std::isfinite(e.rest_length) && e.rest_length > 0.0;
    finite = finite && has_length && std::isfinite(e.mass()) && e.section.bendStiffness().allFinite() &&
             e.section.stretchCompliance().allFinite() && e.rest_strain.allFinite() && e.frame.coeffs().allFinite();
  }
  for (const rod::Bend& b : rod.bends) finite = finite && b.rest_curvature.allFinite();
  return finite;
}

double norm(const TurnField& field) {
  double sum = 0.0;
  for (const Vector3& w : field) sum += w.squaredNorm();
  return std::sqrt(sum);
}

/// Newton direction; an indefinite Hessian is shifted until it is positive. `shift` [N m] is remembered between
/// iterations. The first one vanishes with the residual: at a buckled equilibrium the free azimuth makes the Hessian
/// singular, and a shift that stayed would stall the last iterations. Returns the shift that served.
double findStep(ReducedEnergy& energy, double residual, double& shift) {
  const double first = std::max(1e-6 * std::min(1.0, 1e5 * residual), 1e-16) * energy.stiffnessScale();
  double tau = shift;
  while (!energy.findStep(tau)) tau = tau > 0.0 ? 4.0 * tau : first;
  shift = tau > 4.0 * first ? tau / 4.0 : 0.0;
  return tau;
}

/// Armijo backtracking on the true energy. True if a step was taken; `here` is then where it led.
bool searchLine(ReducedEnergy& energy, double max_rotation, Evaluation& here) {
  const double noise = 1e-13 * here.magnitude;
  double scale = std::min(1.0, max_rotation / energy.largestTurn());
  for (int halvings = 0; halvings < 40; ++halvings, scale *= 0.5) {
    const Evaluation there = energy.tryStep(scale);
    if (there.largest_bend < kUnresolvable &&
        there.energy <= here.energy - kArmijo * scale * energy.decrement() + noise) {
      energy.accept();
      here = there;
      return true;
    }
  }
  return false;
}

/// Moves along the unstable direction to about the least energy: doubling until it rises, then through three points.
void leaveAlong(ReducedEnergy& energy, const TurnField& direction, Evaluation& here) {
  energy.setStep(direction);
  const double unit = 1.0 / energy.largestTurn();
  const auto energyAt = [&](double angle) {
    const Evaluation there = energy.tryStep(angle * unit);
    return there.largest_bend < kUnresolvable ? there.energy : std::numeric_limits<double>::infinity();
  };
  double angle = 0.02;
  double before = here.energy, middle = energyAt(angle), beyond = energyAt(2.0 * angle);
  while (beyond < middle && angle < 0.75) {
    angle *= 2.0;
    before = middle;
    middle = beyond;
    beyond = energyAt(2.0 * angle);
  }
  // Vertex of the parabola through angle / 2, angle and 2 angle (0, angle and 2 angle if the first trial was beyond
  // it).
  const double width = angle > 0.02 ? 0.5 * angle : angle;
  const double left = (middle - before) / width;
  const double right = (beyond - middle) / angle;
  const double curvature = (right - left) / (0.5 * (width + angle));
  if (curvature > 0.0) angle = std::clamp(angle - 0.5 * width - left / curvature, 0.25 * angle, 2.0 * angle);
  here = energy.tryStep(angle * unit);
  energy.accept();
}

}  // namespace

struct StaticEquilibrium::Workspace {
  ReducedEnergy energy;
};

StaticEquilibrium::StaticEquilibrium(const RelaxationSettings& settings)
    : settings_(settings), workspace_(std::make_unique<Workspace>()) {}
StaticEquilibrium::~StaticEquilibrium() = default;
StaticEquilibrium::StaticEquilibrium(StaticEquilibrium&&) noexcept = default;
StaticEquilibrium& StaticEquilibrium::operator=(StaticEquilibrium&&) noexcept = default;

RelaxationReport StaticEquilibrium::relax(rod::Rod& rod, const Loads& loads) {
  RelaxationReport report;
  const auto stop = [&report](RelaxationReason reason) {
    report.reason = reason;
    return report;
  };
  if (!isFinite(rod, loads)) return stop(RelaxationReason::not_finite);

  ReducedEnergy& energy = workspace_->energy;
  energy.assign(rod, loads);
  // Forces of all elements beyond add up in each, so round-off grows with their number.
  const double round_off = 10.0 * static_cast<double>(rod.size()) * std::numeric_limits<double>::epsilon();
  const double tolerance = std::max(settings_.tolerance, round_off);
  double shift = 0.0;
  Evaluation here = energy.evaluate();
  while (true) {
    report.residual = here.largest_gradient / energy.coupleScale();
    report.largest_bend = here.largest_bend;
    if (!std::isfinite(report.residual) || !std::isfinite(here.energy)) return stop(RelaxationReason::not_finite);

    if (report.residual < tolerance) {
      double last_shift = 0.0;
      while (!energy.findStep(last_shift))
        last_shift = last_shift > 0.0 ? 4.0 * last_shift : 1e-12 * energy.stiffnessScale();
      TurnField towards = energy.turnsFrom(rod);
      if (norm(towards) < 1e-9) towards = energy.lean();
      const Eigenpair lowest = energy.lowestEigenpair(last_shift, towards);
      report.lowest_eigenvalue = lowest.value;
      // What is left of the gradient shows up as an eigenvalue of the free azimuth of a buckled column; it is no
      // instability.
      const double neutral = std::max(kUnstable * energy.bendingScale(), 10.0 * here.largest_gradient);
      if (lowest.value >= -neutral) break;
      if (report.branch_switches == settings_.max_branch_switches) return stop(RelaxationReason::unstable);
      ++report.branch_switches;
      leaveAlong(energy, lowest.vector, here);
      continue;
    }

    if (report.iterations == settings_.max_iterations) return stop(RelaxationReason::too_many_iterations);
    ++report.iterations;
    findStep(energy, report.residual, shift);
    if (!searchLine(energy, settings_.max_rotation, here)) return stop(RelaxationReason::line_search_failed);
  }
  if (report.largest_bend > settings_.max_bend_angle) return stop(RelaxationReason::unresolved_bend);

  energy.writeTo(rod);
  return report;
}

double StaticEquilibrium::lowestEigenvalue(const rod::Rod& rod, const Loads& loads) {
  ReducedEnergy& energy = workspace_->energy;
  energy.assign(rod, loads);
  double shift = 0.0;
  while (!energy.findStep(shift)) shift = shift > 0.0 ? 4.0 * shift : 1e-12 * energy.stiffnessScale();
  return energy.lowestEigenpair(shift, energy.lean()).value;
}

}  // namespace sensory_growth::mechanics
