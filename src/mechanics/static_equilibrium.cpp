#include "sensory_growth/mechanics/static_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sensory_growth/mechanics/block_tridiagonal.h"
#include "sensory_growth/mechanics/reduced_energy.h"

namespace sensory_growth::mechanics {
namespace {

using rod::Vector3;

constexpr double kArmijo = 1e-4;
constexpr double kUnstable = 1e-9;  // of B / L: eigenvalues below minus this are unstable, model.md 12.4
constexpr double kEigenvalueTolerance = 1e-6;
constexpr double kUnresolvable = 3.0;  // rad: near pi the rotation vector of a bend jumps

bool isFinite(const rod::Rod& rod, const Loads& loads) {
  bool finite = loads.gravity.allFinite() && loads.tip_force.allFinite() && rod.base.frame.coeffs().allFinite();
  for (const rod::Element& e : rod.elements) {
    const bool has_length = std::isfinite(e.rest_length) && e.rest_length > 0.0;
    finite = finite && has_length && std::isfinite(e.mass()) && e.section.bendStiffness().allFinite() &&
             e.section.stretchCompliance().allFinite() && e.rest_strain.allFinite() && e.frame.coeffs().allFinite();
  }
  for (const rod::Bend& b : rod.bends) finite = finite && b.rest_curvature.allFinite();
  return finite;
}

/// A rod with the given frames leaning over towards a fixed direction of the world, as material rotations. Eigenvector
/// searches that start from it find a reproducible direction of buckling when every direction is equally good.
RotationField lean(const Vector3& tangent, const ReducedEnergy::Frames& frames, const Vector3& towards) {
  const Vector3 axis = tangent.cross(towards);
  RotationField field(frames.size());
  for (std::size_t e = 0; e < frames.size(); ++e) {
    field[e] = (static_cast<double>(e) + 0.5) * (frames[e].conjugate() * axis);
  }
  return field;
}

/// Lowest eigenpair, searched from two leanings at right angles so that no symmetry can hide it.
Eigenpair lowestEigenpair(const rod::Quaternion& base, const ReducedEnergy::Frames& frames,
                          const BlockTridiagonal& hessian) {
  const Vector3 tangent = base * Vector3::UnitZ();
  const Vector3 first = std::abs(tangent.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
  Eigenpair one = lowestEigenpair(hessian, lean(tangent, frames, first), kEigenvalueTolerance);
  Eigenpair other = lowestEigenpair(hessian, lean(tangent, frames, tangent.cross(first)), kEigenvalueTolerance);
  const bool clearly_lower = other.value < one.value - 10.0 * kEigenvalueTolerance * std::abs(one.value);
  return clearly_lower ? other : one;
}

}  // namespace

struct StaticEquilibrium::Workspace {
  ReducedEnergy energy;
  RotationField gradient, step;
  BlockTridiagonal hessian;
  BlockCholesky factor;
  ReducedEnergy::Frames frames, trial;

  double tryStep(double scale) {
    trial.resize(frames.size());
    for (std::size_t e = 0; e < frames.size(); ++e) {
      trial[e] = (frames[e] * rod::exp(scale * step[e])).normalized();
    }
    const double value = energy.evaluate(trial);
    return energy.largestBend() < kUnresolvable ? value : std::numeric_limits<double>::infinity();
  }

  double residual() const { return largestRotation(gradient) / energy.coupleScale(); }

  /// Newton direction; an indefinite Hessian is shifted until it is positive. The shift is remembered between
  /// iterations. The first one vanishes with the residual: at a buckled equilibrium the free azimuth makes the Hessian
  /// singular, and a shift that stayed would stall the last iterations.
  void newtonDirection(double& shift) {
    const double scale = hessian.largestDiagonal();
    const double first = std::max(1e-6 * std::min(1.0, 1e5 * residual()), 1e-16);
    double tau = shift;
    while (!factor.factor(hessian, tau * scale)) tau = tau > 0.0 ? 4.0 * tau : first;
    shift = tau > 4.0 * first ? tau / 4.0 : 0.0;
    step = gradient;
    for (Vector3& w : step) w = -w;
    factor.solve(step);
  }

  /// Armijo backtracking on the true energy. True if a step was taken.
  bool lineSearch(double value, double max_rotation) {
    const double slope = dot(gradient, step);
    const double noise = 1e-13 * energy.magnitude();
    double scale = std::min(1.0, max_rotation / largestRotation(step));
    for (int halvings = 0; halvings < 40; ++halvings, scale *= 0.5) {
      if (tryStep(scale) <= value + kArmijo * scale * slope + noise) {
        frames.swap(trial);
        return true;
      }
    }
    return false;
  }

  /// Moves along the unstable direction to about the least energy: doubling until it rises, then through three points.
  void leaveAlong(const RotationField& direction, double value) {
    step = direction;
    const double unit = 1.0 / largestRotation(step);
    double angle = 0.02;
    double before = value, here = tryStep(angle * unit), beyond = tryStep(2.0 * angle * unit);
    while (beyond < here && angle < 0.75) {
      angle *= 2.0;
      before = here;
      here = beyond;
      beyond = tryStep(2.0 * angle * unit);
    }
    // Vertex of the parabola through angle / 2, angle and 2 angle (0, angle and 2 angle if the first trial was beyond
    // it).
    const double width = angle > 0.02 ? 0.5 * angle : angle;
    const double left = (here - before) / width;
    const double right = (beyond - here) / angle;
    const double curvature = (right - left) / (0.5 * (width + angle));
    if (curvature > 0.0) angle = std::clamp(angle - 0.5 * width - left / curvature, 0.25 * angle, 2.0 * angle);
    tryStep(angle * unit);
    frames.swap(trial);
  }

  void readFrames(const rod::Rod& rod) {
    frames.resize(rod.size());
    for (std::size_t e = 0; e < rod.size(); ++e) frames[e] = rod.elements[e].frame;
  }
};

StaticEquilibrium::StaticEquilibrium(const RelaxationSettings& settings)
    : settings_(settings), workspace_(std::make_unique<Workspace>()) {}
StaticEquilibrium::~StaticEquilibrium() = default;
StaticEquilibrium::StaticEquilibrium(StaticEquilibrium&&) noexcept = default;
StaticEquilibrium& StaticEquilibrium::operator=(StaticEquilibrium&&) noexcept = default;

RelaxationReport StaticEquilibrium::relax(rod::Rod& rod, const Loads& loads) {
  Workspace& w = *workspace_;
  RelaxationReport report;
  const auto stop = [&report](RelaxationReason reason) {
    report.reason = reason;
    return report;
  };
  if (!isFinite(rod, loads)) return stop(RelaxationReason::not_finite);

  w.energy.assign(rod, loads);
  w.readFrames(rod);
  // Forces of all elements beyond add up in each, so round-off grows with their number.
  const double round_off = 10.0 * static_cast<double>(rod.size()) * std::numeric_limits<double>::epsilon();
  const double tolerance = std::max(settings_.tolerance, round_off);
  double shift = 0.0;
  while (true) {
    const double value = w.energy.evaluate(w.frames);
    w.energy.differentiate(w.gradient, w.hessian);
    report.residual = w.residual();
    report.largest_bend = w.energy.largestBend();
    if (!std::isfinite(report.residual) || !std::isfinite(value)) return stop(RelaxationReason::not_finite);

    if (report.residual < tolerance) {
      const Eigenpair lowest = lowestEigenpair(rod.base.frame, w.frames, w.hessian);
      report.lowest_eigenvalue = lowest.value;
      // What is left of the gradient shows up as an eigenvalue of the free azimuth of a buckled column; it is no
      // instability.
      const double neutral = std::max(kUnstable * w.energy.bendingScale(), 10.0 * largestRotation(w.gradient));
      if (lowest.value >= -neutral) break;
      if (report.branch_switches == settings_.max_branch_switches) return stop(RelaxationReason::unstable);
      ++report.branch_switches;
      w.leaveAlong(lowest.vector, value);
      continue;
    }

    if (report.iterations == settings_.max_iterations) return stop(RelaxationReason::too_many_iterations);
    ++report.iterations;
    w.newtonDirection(shift);
    if (!w.lineSearch(value, settings_.max_rotation)) return stop(RelaxationReason::line_search_failed);
  }
  if (report.largest_bend > settings_.max_bend_angle) return stop(RelaxationReason::unresolved_bend);

  for (std::size_t e = 0; e < rod.size(); ++e) {
    rod.elements[e].frame = w.frames[e];
    rod.elements[e].strain = w.energy.strain(e);
    rod.bends[e].curvature = w.energy.curvature(e);
  }
  rod.rebuildPositions();
  return report;
}

double StaticEquilibrium::lowestEigenvalue(const rod::Rod& rod, const Loads& loads) {
  Workspace& w = *workspace_;
  w.energy.assign(rod, loads);
  w.readFrames(rod);
  w.energy.evaluate(w.frames);
  w.energy.differentiate(w.gradient, w.hessian);
  return lowestEigenpair(rod.base.frame, w.frames, w.hessian).value;
}

}  // namespace sensory_growth::mechanics
