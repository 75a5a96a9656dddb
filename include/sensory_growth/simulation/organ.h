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
#include "sensory_growth/simulation/elastic_response.h"
#include "sensory_growth/simulation/parameters.h"
#include "sensory_growth/simulation/scenario.h"

namespace sensory_growth::simulation {

/// Why a step of an organ was given up.
enum class OrganFault {
  none,
  relaxation,         ///< no equilibrium, however small the part of the step
  too_many_elements,  ///< more than kMostElements: growth outran longest_element
  step_limits,        ///< the step limits ask for smaller parts than Stepping allows: the step is far too long
};

/// What happened in one step of one organ.
struct OrganReport {
  OrganFault fault = OrganFault::none;
  mechanics::RelaxationReport relaxation;  ///< of the last relaxation
  int substeps = 0;                        ///< parts the step was cut into
  int retries = 0;                         ///< parts that were cut again because relaxation failed
  int iterations = 0;                      ///< Newton iterations or time steps, of all relaxations
  int branch_switches = 0;                 ///< unstable equilibria left, in all relaxations
  std::size_t divisions = 0;

  /// Largest differential growth [-]; above 1, tissue on one side of the organ would have to shrink.
  double largest_differential_growth = 0.0;

  bool ok() const { return fault == OrganFault::none; }
};

/// One sentence for people, with the figures.
std::string describe(const OrganReport& report);

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
  const rod::Rod& rod() const { return rod_; }
  const OrganReport& report() const { return report_; }
  /// Of the Hessian of the organ in equilibrium [N m], measured on demand; nothing for organs that are not relaxed to
  /// one.
  std::optional<double> lowestEigenvalue() const;

  mechanics::Energy energy() const { return mechanics::energy(rod_, loads_); }

  /// Relative elongation rate of every element as the organ stands, stress included [1/s].
  std::vector<double> growthRates() const;

  /// What every bend perceives of every cue as the organ stands.
  growth::CueFields cues(const growth::Environment& environment) const;

 private:
  double longestPart(const growth::Environment& environment, double time);
  OrganFault growAndRelax(double dt, const growth::Environment& environment, double time);
  bool startsWithStep() const { return report_.substeps == 0 && !weight_changed_before_step_; }
  const rod::Rod& beforePart() const { return startsWithStep() ? before_step_ : before_part_; }
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
  rod::Rod rod_, before_step_, before_part_;
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
  ElasticResponse response_, response_before_step_;
  bool trend_is_known_ = false;  ///< for the part that is under way
  OrganReport report_, report_before_step_;
  bool weight_changed_ = false, weight_changed_before_step_ = false;  ///< since the last relaxation
  bool has_begun_ = false;
};

}  // namespace sensory_growth::simulation
