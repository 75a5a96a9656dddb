#include "sensory_growth/mechanics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "rod_motion.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "thresholds.h"

namespace sensory_growth::mechanics {
namespace {

constexpr double kRestingEnergy = 1e-12;   // of W L + B / L, model.md 13
constexpr double kRestingPeriods = 0.5;    // for so long residual and kinetic energy stay small
constexpr double kChecksPerPeriod = 50.0;  // of the residual rule
constexpr double kCarried = 0.99;          // share of the loads from which the rest need not come on smoothly
constexpr int kMostSteps = 1000000000;     // of one call; days of computing

/// Rises from 0 to 1 with x, with horizontal ends.
double smoothStep(double x) { return x < 1.0 ? x * x * (3.0 - 2.0 * x) : 1.0; }

bool isPositive(double x) { return std::isfinite(x) && x > 0.0; }

RelaxationReport stopped(RelaxationReport report, RelaxationReason reason) {
  report.reason = reason;
  return report;
}

/// sqrt(m / k) of the lightest vertex between all springs and walls [s]; zero if some are rigid, infinite without any.
double bounceTime(const rod::Rod& rod, const Surroundings& surroundings) {
  if (surroundings.held_apex) return 0.0;
  double stiffness = 0.0;
  for (const Spring& spring : surroundings.springs) stiffness += spring.stiffness;
  for (const Wall& wall : surroundings.walls) stiffness += wall.stiffness;
  double lightest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 1; v <= rod.size(); ++v) lightest = std::min(lightest, rod.vertexMass(v));
  return std::sqrt(lightest / stiffness);
}

}  // namespace

struct DynamicRelaxation::Timing {
  double damping = 0.0;       ///< [1/s]
  double first_period = 0.0;  ///< [s]
  double step = 0.0;          ///< longest [s]

  Timing(const rod::Rod& rod, const Surroundings& surroundings, const DynamicsSettings& settings) {
    const double frequency = firstFrequency(rod);
    damping = settings.damping.value_or(2.0 * frequency);
    first_period = 2.0 * M_PI / frequency;
    step = settings.time_step * std::min(waveTime(rod), bounceTime(rod, surroundings));
  }
};

double firstFrequency(const rod::Rod& rod) {
  const std::size_t n = rod.size();
  // Moments of the weight at unit gravity about every vertex, from the tip; then turns and deflections from the base.
  std::vector<double> moment(n);
  double beyond = 0.0;
  for (std::size_t e = n; e-- > 0;) {
    beyond += rod.vertexMass(e + 1);
    moment[e] = (e + 1 < n ? moment[e + 1] : 0.0) + beyond * rod.elements[e].rest_length;
  }
  double turn = 0.0, deflection = 0.0, work = 0.0, square = 0.0;
  for (std::size_t e = 0; e < n; ++e) {
    const auto compliance = [&](std::size_t i) { return 1.0 / rod.elements[i].section.bendStiffness().x(); };
    turn += moment[e] * rod.voronoiLength(e) * rod::voronoiMean(rod, e, compliance);
    deflection += turn * rod.elements[e].rest_length;
    work += rod.vertexMass(e + 1) * deflection;
    square += rod.vertexMass(e + 1) * deflection * deflection;
  }
  return std::sqrt(work / square);
}

double waveTime(const rod::Rod& rod) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const rod::Element& e : rod.elements) {
    if (e.section.inextensible) return 0.0;
    shortest = std::min({shortest, e.rest_length * std::sqrt(e.section.density / e.section.young_modulus),
                         e.section.radius * std::sqrt(e.section.density / e.section.shear_modulus)});
  }
  return shortest;
}

DynamicRelaxation::DynamicRelaxation(const DynamicsSettings& settings)
    : settings_(settings), motion_(std::make_unique<RodMotion>()) {}
DynamicRelaxation::~DynamicRelaxation() = default;
DynamicRelaxation::DynamicRelaxation(DynamicRelaxation&&) noexcept = default;
DynamicRelaxation& DynamicRelaxation::operator=(DynamicRelaxation&&) noexcept = default;

RelaxationReport DynamicRelaxation::relax(rod::Rod& rod, const Loads& loads) {
  const Timing times(rod, loads.surroundings, settings_);
  rod::Rod moving = rod;
  moving.rebuild();
  motion_->assign(moving, loads, settings_.dilatation);
  motion_->stop();
  RelaxationReport report = reportAtStart(times);
  if (!report.ok()) return report;
  settle(times, report);
  if (!report.ok()) return report;
  report.largest_bend = motion_->largestBend();
  if (report.largest_bend > settings_.max_bend_angle) return stopped(report, RelaxationReason::unresolved_bend);

  motion_->stop();
  motion_->write(moving);
  if (settings_.stopping == StoppingRule::residual && !isStable(moving, loads, report)) {
    return stopped(report, RelaxationReason::unstable);
  }
  rod = std::move(moving);
  return report;
}

RelaxationReport DynamicRelaxation::advance(rod::Rod& rod, const Loads& loads, double duration) {
  if (!(duration >= 0.0)) {
    throw std::invalid_argument("the duration is " + std::to_string(duration) + " s; it must not be negative");
  }
  const Timing times(rod, loads.surroundings, settings_);
  rod::Rod moving = rod;
  moving.rebuild();
  motion_->assign(moving, loads, settings_.dilatation);
  RelaxationReport report = reportAtStart(times);
  if (!report.ok()) return report;
  const double whole_steps = std::ceil(duration / times.step * (1.0 - 1e-12));
  if (!(duration <= settings_.max_periods * times.first_period && whole_steps <= kMostSteps)) {
    return stopped(report, RelaxationReason::too_many_iterations);
  }

  const int steps = static_cast<int>(whole_steps);
  if (steps > 0) {
    const double dt = duration / steps;
    motion_->setTimeStep(dt, times.damping);
    motion_->drift(0.5 * dt);
    for (int i = 1; i <= steps; ++i) {
      motion_->evaluate();
      motion_->kickAndDrift(i < steps ? dt : 0.5 * dt);
    }
  }
  report.iterations = steps;
  report.time = duration;
  measure(report);
  if (!report.ok()) return report;
  report.largest_bend = motion_->largestBend();
  if (report.largest_bend > settings_.max_bend_angle) return stopped(report, RelaxationReason::unresolved_bend);
  motion_->write(moving);
  rod = std::move(moving);
  return report;
}

RelaxationReport DynamicRelaxation::reportAtStart(const Timing& times) {
  RelaxationReport report;
  report.in_time = true;
  if (times.step == 0.0) return stopped(report, RelaxationReason::no_time_step);
  const bool has_times = isPositive(times.step) && isPositive(times.first_period) && std::isfinite(times.damping);
  if (!has_times) return stopped(report, RelaxationReason::not_finite);
  motion_->evaluate();
  measure(report);
  return report;
}

/// Residual and kinetic energy as of the last evaluation of the forces.
void DynamicRelaxation::measure(RelaxationReport& report) const {
  const Residual residual = motion_->residual();
  report.residual = residual.value;
  report.worst_element = residual.element;
  report.kinetic_energy = motion_->kineticEnergy();
  const bool finite = std::isfinite(report.residual) && std::isfinite(report.kinetic_energy);
  if (!finite) report.reason = RelaxationReason::not_finite;
}

/// Steps until the rod rests. The report says if it did.
void DynamicRelaxation::settle(const Timing& times, RelaxationReport& report) {
  const double tolerance = std::max(settings_.tolerance, motion_->restingResidual());
  if (report.residual < tolerance) return;
  const double dt = times.step;
  const double carried = motion_->carriedShare();
  const double ramp = carried < kCarried ? settings_.ramp_periods * times.first_period : 0.0;
  const int check_interval = std::max(1, static_cast<int>(times.first_period / (kChecksPerPeriod * dt)));
  double quiet_since = 0.0;
  int quiet_steps = 0;

  motion_->setTimeStep(dt, times.damping);
  motion_->drift(0.5 * dt);
  while (true) {
    report.time = (report.iterations + 0.5) * dt;
    const bool ramping = ramp > 0.0 && report.time < ramp + dt;
    if (ramping) motion_->setShare(carried + (1.0 - carried) * smoothStep(report.time / ramp));
    motion_->evaluate();
    const bool is_due = report.iterations % check_interval == 0;
    if (is_due) {
      measure(report);
      if (!report.ok()) return;
    }
    if (settings_.stopping == StoppingRule::rotational_energy) {
      quiet_steps = motion_->rotationalEnergy() < settings_.rest_energy ? quiet_steps + 1 : 0;
      if (quiet_steps == settings_.rest_steps) return measure(report);
    } else if (is_due) {
      const bool is_quiet =
          !ramping && report.residual < tolerance && report.kinetic_energy < kRestingEnergy * motion_->energyScale();
      if (!is_quiet) quiet_since = report.time;
      if (report.time - quiet_since > kRestingPeriods * times.first_period) return;
    }
    if (report.time > settings_.max_periods * times.first_period || report.iterations == kMostSteps) {
      report.reason = RelaxationReason::too_many_iterations;
      return measure(report);
    }
    motion_->kickAndDrift(dt);
    ++report.iterations;
  }
}

/// Whether the equilibrium found is stable. Motion follows what the imperfections of a rod give; one without any rests
/// even where it could fall. The part of a body couple that has no potential may lower the eigenvalue by half of it.
bool DynamicRelaxation::isStable(const rod::Rod& rod, const Loads& loads, RelaxationReport& report) const {
  const double lowest = StaticEquilibrium().lowestEigenvalue(rod, loads);
  report.lowest_eigenvalue = lowest;
  const double left = std::max(kUnstable * motion_->bendingScale(), 10.0 * report.residual * motion_->coupleScale());
  if (lowest >= -(left + 0.5 * loads.tip_couple.norm())) return true;
  if (loads.surroundings.empty()) return false;
  // Springs and walls may hold what would fall without them.
  rod::Rod settled = rod;
  const RelaxationReport supported = StaticEquilibrium().relax(settled, loads);
  report.lowest_eigenvalue = supported.lowest_eigenvalue;
  return supported.ok() && supported.branch_switches == 0;
}

}  // namespace sensory_growth::mechanics
