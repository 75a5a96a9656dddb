#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/differential_growth.h"
#include "sensory_growth/growth/elongation.h"
#include "sensory_growth/growth/perception.h"
#include "sensory_growth/mechanics/dynamics.h"
#include "sensory_growth/mechanics/energy.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/simulation/organ_report.h"
#include "sensory_growth/simulation/organ_state.h"
#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/scenario.h"

namespace sensory_growth::simulation {

/// One organ: it grows a little, then relaxes to equilibrium (the draft's Figure 1) or moves on for a while.
class Organ {
 public:
  /// Builds the organ and relaxes it under its load. Throws std::invalid_argument if it cannot be built, naming the
  /// fault.
  Organ(const OrganScenario& organ, const Scenario& scenario);

  /// Advances by dt [s] of growth time, from environment.time, in as many parts as the step limits ask for. On
  /// failure (report.ok() is false) the organ is left as it was before the call.
  const OrganReport& advance(double dt, const growth::Environment& environment);

  /// Takes back the last advance(), its report included; once. What was set before it stays set.
  void undo();

  /// Gives a parameter that the organ has another value, from the next step on.
  void set(const Parameter& parameter, double value) { parameter.set(scenario_, value); }

  /// Changes the weight, if the organ has any. An organ in equilibrium relaxes under it when the next step begins.
  void setGravity(const rod::Vector3& gravity);

  /// Begins a step: relaxes under a weight that changed, so that the step starts from equilibrium. advance() does so
  /// itself; called before it, others can sense where the organ went. What fails here fails advance().
  void begin();

  const OrganScenario& scenario() const { return scenario_; }
  const rod::Rod& rod() const { return now_.rod; }
  const OrganReport& report() const { return now_.report; }

  /// All that decides how the organ goes on, between two steps.
  OrganState state() const;

  /// Goes on from that state at growth time `time` [s], under the gravity that was set. Throws std::invalid_argument
  /// naming what in it no organ of this scenario can have; the organ is of no use then.
  void restore(const OrganState& state, double time);

  /// Of the Hessian of the organ in equilibrium [N m], measured on demand; nothing for organs that are not relaxed to
  /// one.
  std::optional<double> lowestEigenvalue() const;

  mechanics::Energy energy() const { return mechanics::energy(now_.rod, loads_); }

  /// Relative elongation rate of every element as the organ stands, stress included [1/s].
  std::vector<double> growthRates() const;

  /// What every bend perceives of every cue as the organ stands.
  growth::CueFields cues(const growth::Environment& environment) const;

 private:
  void takeBack();
  void restoreParameters(const std::vector<ParameterValue>& values);
  double longestPart(const growth::Environment& environment, double time);
  OrganFault growAndRelax(double dt, const growth::Environment& environment, double time);
  bool startsWithStep() const { return now_.report.substeps == 0 && !before_step_.weight_changed; }
  const rod::Rod& beforePart() const { return startsWithStep() ? before_step_.rod : before_part_; }
  const growth::GrowthStrain& growthStrain(double dt);
  void correctFactors(const growth::GrowthStrain& strain, double dt);
  void growOlder(const growth::GrowthStrain& strain, double dt, double share);
  void learnElasticResponse(double dt);
  OrganFault relax();
  OrganFault relaxFromAnywhere();
  OrganFault relaxInPassing();
  OrganFault relaxCorrected();
  OrganFault move(double duration);
  OrganFault take(const mechanics::RelaxationReport& relaxation);

  OrganScenario scenario_;
  Stepping stepping_;
  RelaxationMethod method_;
  bool has_weight_;
  double growth_per_second_;
  mechanics::RelaxationSettings relaxation_settings_;
  mechanics::Loads loads_;
  OrganMoment now_, before_step_;
  rod::Rod before_part_;
  mechanics::StaticEquilibrium equilibrium_;
  mechanics::DynamicRelaxation dynamics_;
  growth::Elongation elongation_;
  growth::Perception perception_;
  growth::Perception::Mark perception_before_step_;
  growth::GrowthFactors factors_, new_factors_;
  growth::GrowthStrain predicted_strain_, extra_strain_;
  growth::Deposition deposition_;
  growth::CueFields cues_;
  std::vector<rod::Vector3> drive_, new_drive_;
  std::vector<double> rates_, new_rates_;
  bool trend_is_known_ = false;  ///< for the part that is under way
  bool has_begun_ = false;
};

}  // namespace sensory_growth::simulation
