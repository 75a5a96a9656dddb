#include "sensory_growth/simulation/organ.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sensory_growth/mechanics/rest_shape.h"
#include "sensory_growth/rod/division.h"

namespace sensory_growth::simulation {
namespace {

/// Of the step that led to this moment, not of one that failed since.
const OrganReport& goodReport(const OrganMoment& now, const OrganMoment& before_step) {
  return now.report.ok() ? now.report : before_step.report;
}

}  // namespace

Organ::Organ(const OrganScenario& organ, const Scenario& scenario)
    : scenario_(organ),
      stepping_(scenario.stepping),
      method_(scenario.relaxation),
      has_weight_(scenario.weight),
      growth_per_second_(scenario.growth_per_second),
      relaxation_settings_(scenario.relaxation_settings),
      equilibrium_(scenario.relaxation_settings),
      dynamics_(scenario.dynamics_settings),
      perception_(organ.sensing) {
  if (method_ == RelaxationMethod::continuous && !(growth_per_second_ > 0.0)) {
    throw std::invalid_argument("growth_per_second must be positive");
  }
  loads_ = organ.loads;
  if (has_weight_) loads_.gravity = scenario.gravity;
  for (const auto& fault :
       {mechanics::findFault(loads_.surroundings), growth::findFault(organ.senses), growth::findFault(organ.bending)}) {
    if (fault) throw std::invalid_argument("organ '" + organ.id + "': " + *fault);
  }

  now_.rod = rod::straightRod(organ.base, organ.length, organ.elements, organ.section);
  now_.rod.base_support = organ.base_support;
  for (std::size_t j = now_.rod.firstBend(); j < now_.rod.size(); ++j) {
    now_.rod.bends[j].curvature = now_.rod.bends[j].rest_curvature = organ.rest_curvature;
  }
  now_.report.divisions = rod::divideLongElements(now_.rod, organ.longest_element, organ.division);
  now_.report.fault = relaxFromAnywhere();
  if (!now_.report.ok()) {
    throw std::invalid_argument("organ '" + organ.id + "' has no equilibrium to start from: " + describe(now_.report));
  }
  before_step_ = now_;
}

const OrganReport& Organ::advance(double dt, const growth::Environment& environment) {
  const double smallest = stepping_.limits.smallest_part * dt;
  if (!has_begun_) begin();
  has_begun_ = false;
  const auto giveUp = [this](OrganFault fault) -> const OrganReport& {
    const OrganReport report = now_.report;
    takeBack();
    now_.report = report;
    now_.report.fault = fault;
    return now_.report;
  };
  if (!now_.report.ok()) return giveUp(now_.report.fault);

  double remaining = dt;
  double longest_allowed = dt;
  while (remaining > 0.0) {
    if (longest_allowed < smallest) return giveUp(OrganFault::relaxation);
    const double time = environment.time + (dt - remaining);
    const double limit = std::min(longestPart(environment, time), longest_allowed);
    if (!(limit >= smallest)) return giveUp(OrganFault::step_limits);
    // A remainder is cut into equal parts, so that none is a sliver.
    // What is perceived may jump on the way; no part reaches across.
    const double jump = perception_.nextJump(time) - time;
    const double stretch = jump > smallest && jump < remaining ? jump : remaining;
    const double parts = std::max(1.0, std::ceil(stretch / limit * (1.0 - 1e-12)));
    const double part = stretch / parts;

    if (!startsWithStep()) before_part_ = now_.rod;
    const OrganFault fault = growAndRelax(part, environment, time);
    if (fault == OrganFault::too_many_elements) return giveUp(fault);
    if (fault == OrganFault::none) {
      remaining = part < remaining ? remaining - part : 0.0;
      longest_allowed = dt;
      ++now_.report.substeps;
      if (perception_.hasMemory()) {
        perception_.remember(scenario_.senses, environment, time + part, now_.rod, cues_);
      }
    } else {
      now_.rod = beforePart();
      now_.response.forgetTrend();
      longest_allowed = 0.5 * part;
      ++now_.report.retries;
    }
  }
  return now_.report;
}

void Organ::undo() {
  takeBack();
  has_begun_ = false;
}

void Organ::takeBack() {
  now_ = before_step_;
  perception_.takeBack(perception_before_step_);
}

void Organ::setGravity(const rod::Vector3& gravity) {
  if (!has_weight_) return;
  loads_.gravity = gravity;
  // An organ in continuous motion takes the change as it comes.
  now_.weight_changed = method_ != RelaxationMethod::continuous;
}

void Organ::begin() {
  now_.report = goodReport(now_, before_step_);
  before_step_ = now_;
  perception_.forgetTheOld();
  perception_.setMark(perception_before_step_);
  has_begun_ = true;
  now_.report = {};
  if (!now_.weight_changed) return;
  now_.report.fault = relaxFromAnywhere();
  now_.weight_changed = false;
}

OrganState Organ::state() const {
  OrganState state{scenario_.id, now_, perception_.histories(), {}};
  state.moment.report = goodReport(now_, before_step_);
  for (const Parameter& parameter : simulation::parameters()) {
    if (const auto value = parameter.get(scenario_)) state.parameters.push_back({parameter.name, *value});
  }
  return state;
}

void Organ::restore(const OrganState& state, double time) {
  if (const auto fault = findFault(state.moment)) throw std::invalid_argument(*fault);
  const rod::Rod& rod = state.moment.rod;
  if (rod.base_support != scenario_.base_support) throw std::invalid_argument("the rod is held in another way");
  for (const growth::History& history : state.memories) {
    if (!history.empty() && history.back().time > time * (1.0 + growth::kSameTime)) {
      throw std::invalid_argument("it remembers what is yet to come");
    }
  }
  restoreParameters(state.parameters);
  perception_.restore(state.memories, rod);
  now_ = before_step_ = state.moment;
}

void Organ::restoreParameters(const std::vector<ParameterValue>& values) {
  const auto has = [this](const Parameter& parameter) { return parameter.get(scenario_).has_value(); };
  const auto& all = simulation::parameters();
  if (values.size() != static_cast<std::size_t>(std::count_if(all.begin(), all.end(), has))) {
    throw std::invalid_argument("its parameters are those of another organ");
  }
  for (const auto& [name, value] : values) {
    if (const auto fault = findFault(ParameterCommand{scenario_.id, name, value})) throw std::invalid_argument(*fault);
    const Parameter& parameter = *findParameter(name);
    if (!has(parameter)) throw std::invalid_argument("it has no " + name);
    parameter.set(scenario_, value);
  }
  for (const auto& fault : {growth::findFault(scenario_.senses), growth::findFault(scenario_.bending)}) {
    if (fault) throw std::invalid_argument(*fault);
  }
}

/// Expects rates_, factors_ and drive_ at the start of the part, as longestPart() leaves them.
OrganFault Organ::growAndRelax(double dt, const growth::Environment& environment, double time) {
  const growth::GrowthStrain& strain = growthStrain(dt);
  // Half of the aging comes before the growth of the rest state and half after, so that neither sees the other late.
  if (scenario_.aging) deposition_.begin(now_.rod.size());
  growOlder(strain, dt, 0.5);
  if (scenario_.elongation) growth::elongate(now_.rod, strain, scenario_.twist_transport, drive_);
  if (scenario_.bending.rotation) {
    growth::elementRates(scenario_.profile, factors_, now_.rod, new_rates_);
    growth::turn(now_.rod, *scenario_.bending.rotation, rates_, new_rates_, dt, drive_);
  }
  growth::predict(now_.rod, scenario_.bending, strain, drive_);
  growOlder(strain, dt, 1.0);
  // Deposition moves the elastic part on its own.
  trend_is_known_ = method_ == RelaxationMethod::statics && !scenario_.aging && now_.response.knowsTrend(now_.rod);
  if (trend_is_known_) now_.response.anticipate(now_.rod, dt);
  const bool moves = method_ == RelaxationMethod::continuous;
  const auto relax_predicted = [&] { return stepping_.second_order ? relaxInPassing() : relax(); };
  if ((moves ? move(dt / growth_per_second_) : relax_predicted()) != OrganFault::none) return OrganFault::relaxation;

  if (stepping_.second_order) {
    perception_.expect(scenario_.senses, environment, time + dt, now_.rod, cues_);
    growth::drive(now_.rod, scenario_.bending, cues_, new_drive_);
    growth::correct(now_.rod, scenario_.bending, strain, drive_, new_drive_);
    if (scenario_.stress_coupling) correctFactors(strain, dt);
    if (scenario_.aging) deposition_.correct(now_.rod, beforePart());
    if (moves) now_.rod.rebuild();
    if (!moves && relaxCorrected() != OrganFault::none) return OrganFault::relaxation;
  }
  learnElasticResponse(dt);

  const std::size_t divisions = rod::divideLongElements(now_.rod, scenario_.longest_element, scenario_.division);
  now_.report.divisions += divisions;
  if (now_.rod.size() > kMostElements) return OrganFault::too_many_elements;
  return divisions == 0 || moves ? OrganFault::none : relax();
}

void Organ::learnElasticResponse(double dt) {
  if (method_ == RelaxationMethod::kinematics || method_ == RelaxationMethod::continuous) return;
  now_.response.learn(beforePart(), now_.rod, dt);
  if (now_.report.relaxation.branch_switches > 0) now_.response.forgetTrend();
}

const growth::GrowthStrain& Organ::growthStrain(double dt) {
  return scenario_.elongation ? elongation_.strain(scenario_.profile, factors_, beforePart(), rates_, dt)
                              : elongation_.strainAtFixedLength(beforePart(), rates_, dt);
}

/// Ages the organ by a share of the time that it does not spend growing, as it stood before.
void Organ::growOlder(const growth::GrowthStrain& strain, double dt, double share) {
  if (!scenario_.aging) return;
  growth::growOlder(now_.rod, beforePart(), *scenario_.aging, scenario_.section, strain,
                    growth::largestRate(scenario_.profile), dt, share);
  deposition_.predict(now_.rod, beforePart());
}

/// Grows by what the mean of the growth factors at the start and the end of the part adds to the predicted strain.
void Organ::correctFactors(const growth::GrowthStrain& strain, double dt) {
  predicted_strain_ = strain;
  growth::stressFactors(*scenario_.stress_coupling, now_.rod, new_factors_);
  for (std::size_t e = 0; e < factors_.size(); ++e) factors_[e] = 0.5 * (factors_[e] + new_factors_[e]);
  growth::elementRates(scenario_.profile, factors_, beforePart(), rates_);
  const growth::GrowthStrain& corrected = growthStrain(dt);
  growth::difference(predicted_strain_, corrected, extra_strain_);
  if (scenario_.elongation) growth::elongate(now_.rod, extra_strain_, scenario_.twist_transport, new_drive_);
  growth::predict(now_.rod, scenario_.bending, extra_strain_, new_drive_);
  growOlder(corrected, dt, 1.0);
}

OrganFault Organ::relax() {
  switch (method_) {
    case RelaxationMethod::statics:
      return take(equilibrium_.relax(now_.rod, loads_, mechanics::Stability::decided));
    case RelaxationMethod::dynamics:
    case RelaxationMethod::continuous:
      return take(dynamics_.relax(now_.rod, loads_));
    case RelaxationMethod::kinematics:
      return take(mechanics::assumeRestShape(now_.rod, relaxation_settings_));
  }
  return OrganFault::none;
}

/// For loads that the organ does not carry yet.
OrganFault Organ::relaxFromAnywhere() {
  const OrganFault fault = relax();
  if (fault == OrganFault::none || method_ != RelaxationMethod::statics) return fault;
  return take(equilibrium_.relaxInLoadSteps(now_.rod, loads_));
}

/// The predicted equilibrium is only sensed: it need not be stable, nor more exact than the step.
OrganFault Organ::relaxInPassing() {
  return method_ == RelaxationMethod::statics ? take(equilibrium_.approach(now_.rod, loads_, trend_is_known_ ? 1 : 2))
                                              : relax();
}

OrganFault Organ::relaxCorrected() {
  const bool only_curvature_was_corrected = !scenario_.stress_coupling && !scenario_.aging;
  if (method_ != RelaxationMethod::statics || !only_curvature_was_corrected) return relax();
  return take(equilibrium_.relaxCorrected(now_.rod, loads_));
}

std::optional<double> Organ::lowestEigenvalue() const {
  const bool was_only_decided = method_ == RelaxationMethod::statics && loads_.surroundings.empty();
  if (!was_only_decided) return now_.report.relaxation.lowest_eigenvalue;
  return mechanics::StaticEquilibrium(relaxation_settings_).lowestEigenvalue(now_.rod, loads_);
}

OrganFault Organ::move(double duration) { return take(dynamics_.advance(now_.rod, loads_, duration)); }

OrganFault Organ::take(const mechanics::RelaxationReport& relaxation) {
  now_.report.relaxation = relaxation;
  now_.report.iterations += relaxation.iterations;
  now_.report.branch_switches += relaxation.branch_switches;
  return relaxation.ok() ? OrganFault::none : OrganFault::relaxation;
}

/// Leaves the growth rates and the drive of the organ as it stands in rates_ and drive_.
double Organ::longestPart(const growth::Environment& environment, double time) {
  const StepLimits& limits = stepping_.limits;
  const growth::BendingLaw& law = scenario_.bending;
  if (scenario_.stress_coupling) growth::stressFactors(*scenario_.stress_coupling, now_.rod, factors_);
  growth::elementRates(scenario_.profile, factors_, now_.rod, rates_);
  perception_.remember(scenario_.senses, environment, time, now_.rod, cues_);
  const double differential_growth = growth::drive(now_.rod, law, cues_, drive_);
  now_.report.largest_differential_growth = std::max(now_.report.largest_differential_growth, differential_growth);

  const double rotation = law.rotation ? std::abs(law.rotation->angularVelocity()) : 0.0;
  double fastest_growth = 0.0;
  double fastest_bend = 0.0;
  double total_turning = 0.0;
  double tip_speed = 0.0;
  double fastest_stress = 0.0;  // that builds up where growth is held
  for (std::size_t j = 0; j < now_.rod.size(); ++j) {
    const double growth_rate = rod::voronoiMean(now_.rod, j, [this](std::size_t e) { return rates_[e]; });
    double bending = growth_rate * growth::bendingRate(now_.rod, law, drive_, j).norm();
    if (growth_rate > 0.0) bending += rotation * now_.rod.bends[j].rest_curvature.head<2>().norm();
    const double turning = now_.rod.voronoiLength(j) * bending;
    fastest_growth = std::max(fastest_growth, rates_[j]);
    fastest_stress = std::max(fastest_stress, rates_[j] * now_.rod.elements[j].section.young_modulus);
    fastest_bend = std::max(fastest_bend, turning);
    total_turning += turning;
    tip_speed += now_.rod.elements[j].rest_length * rates_[j];
  }

  const auto longest = [](double limit, double speed) {
    return speed > 0.0 ? limit / speed : std::numeric_limits<double>::infinity();
  };
  double dt = std::min(longest(limits.growth_strain, fastest_growth), 0.5 * perception_.shortestDelay());
  if (scenario_.elongation) dt = std::min(dt, longest(limits.tip_advance * scenario_.longest_element, tip_speed));
  if (scenario_.senses.oscillator.amplitude != 0.0) {
    dt = std::min(dt, limits.oscillation * std::abs(scenario_.senses.oscillator.period));
  }
  if (law.rotation) dt = std::min(dt, limits.oscillation * std::abs(law.rotation->period));
  if (scenario_.stress_coupling) {
    dt = std::min(dt, longest(limits.growth_stress * scenario_.stress_coupling->yield_margin, fastest_stress));
  }
  dt = std::min(dt, longest(limits.bend_angle, now_.response.amplification() * fastest_bend));
  return std::min(dt, longest(limits.total_angle, now_.response.amplification() * total_turning));
}

growth::CueFields Organ::cues(const growth::Environment& environment) const {
  growth::CueFields cues;
  growth::Perception(perception_).expect(scenario_.senses, environment, environment.time, now_.rod, cues);
  return cues;
}

std::vector<double> Organ::growthRates() const {
  std::vector<double> rates;
  growth::GrowthFactors factors;
  if (scenario_.stress_coupling) growth::stressFactors(*scenario_.stress_coupling, now_.rod, factors);
  growth::elementRates(scenario_.profile, factors, now_.rod, rates);
  return rates;
}

std::string describe(const OrganReport& report) {
  std::ostringstream out;
  switch (report.fault) {
    case OrganFault::none:
      out << "ok";
      break;
    case OrganFault::relaxation:
      out << "relaxation failed";
      break;
    case OrganFault::too_many_elements:
      out << "more than " << kMostElements << " elements; let growth end earlier or allow a longer longest_element";
      break;
    case OrganFault::step_limits:
      out << "the step limits ask for parts smaller than stepping allows; shorten the step or relax the limits";
      break;
  }
  out << " (" << report.substeps << " parts done, " << report.retries << " cut again; last relaxation "
      << mechanics::describe(report.relaxation) << ")";
  return out.str();
}

}  // namespace sensory_growth::simulation
