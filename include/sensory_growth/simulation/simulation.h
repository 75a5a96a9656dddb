#pragma once

/// Organs that grow and relax together under shared stimuli.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/simulation/commands.h"
#include "sensory_growth/simulation/organ.h"
#include "sensory_growth/simulation/organ_sources.h"
#include "sensory_growth/simulation/scenario.h"
#include "sensory_growth/simulation/schedule.h"
#include "sensory_growth/simulation/simulation_state.h"
#include "sensory_growth/simulation/workers.h"

namespace sensory_growth::simulation {

struct StepReport {
  bool ok = true;
  std::string message;  ///< names organ, element, reason and figures when not ok
};

/// Not thread-safe; one thread owns it. Equal scenarios and equal commands at equal steps give equal bits, whatever the
/// number of threads that organs are shared out to.
class Simulation {
 public:
  /// Builds every organ in equilibrium at step 0, with the stimuli of time 0 in force. Organs advance on at most
  /// `threads` threads at a time; 0: as many as there are processors.
  /// Throws std::invalid_argument naming the organ and the fault.
  explicit Simulation(Scenario scenario, int threads = 1);

  /// Goes on from what state() returned of a simulation of this scenario. Throws std::invalid_argument naming the
  /// fault also if the state is none that the scenario can lead to.
  Simulation(Scenario scenario, const SimulationState& state, int threads = 1);

  /// Advances every organ by one step, then takes the commands of the protocol and switches the stimuli that have
  /// fallen due. When an organ fails, no organ and no counter moves and the report says why; what was applied before
  /// stays in force.
  StepReport step();

  /// Applies a command now, between two steps, and keeps it for takeApplied().
  AppliedCommand apply(const Command& command);

  /// Back to step 0 of the scenario, its organs and its numbers; everything applied since is forgotten.
  void reset();

  /// All that the steps to come depend on, but for the scenario.
  SimulationState state() const;

  /// Takes over gravity and the stimuli that are in force in another simulation, in place of its own.
  void takeStimuliOf(const Simulation& other);

  const Scenario& scenario() const { return scenario_; }
  const std::vector<Organ>& organs() const { return organs_; }

  /// What all organs sense; organs that sense each other come on top.
  const growth::Environment& environment() const { return environment_; }

  /// What one organ senses: all that and the other organs.
  growth::Environment seenBy(std::size_t organ) const { return OrganSources(sources_).seenBy(organ, environment_); }

  /// Stimuli that will switch on or off by themselves.
  const Schedule& schedule() const { return schedule_; }

  /// In force, in the world frame [m/s^2].
  const rod::Vector3& gravity() const { return gravity_; }

  /// Steps taken since the start or the last reset.
  std::uint64_t stepIndex() const { return step_index_; }

  /// Growth time [s]: the step index times the step, never a running sum.
  double time() const { return static_cast<double>(step_index_) * scenario_.stepping.step; }

  /// True once the duration of the scenario is reached (never if it has none).
  bool finished() const;

  /// Commands taken since the previous call, in order: those of the protocol, those given to apply(), and plain
  /// additions and removals of stimuli that switched themselves.
  std::vector<AppliedCommand> takeApplied();

 private:
  bool isDue(double time_asked) const;
  void applyDue();
  void restore(const SimulationState& state);
  void setGravity(const rod::Vector3& gravity);
  std::optional<std::string> take(const StimulusCommand& command);
  std::optional<std::string> take(const ParameterCommand& command);
  std::optional<std::string> take(const GravityCommand& command);
  std::optional<std::string> take(const SpawnCommand& command);
  std::optional<std::string> take(const RemoveCommand& command);
  void switchNext();
  void add(const std::string& organ, const rod::Vector3& gravity);
  void restoreBirths(const std::vector<Birth>& births);
  void restoreOrgans(const SimulationState& state);
  std::vector<Organ>::iterator find(const std::string& id);

  Scenario scenario_;
  Workers workers_;
  rod::Vector3 gravity_ = rod::Vector3::Zero();
  bool gravity_changed_ = false;  ///< since the last step
  growth::Environment environment_;
  Schedule schedule_;
  std::vector<Organ> organs_;
  std::vector<Birth> births_;  ///< of the organs that the scenario does not have
  OrganSources sources_;
  std::uint64_t step_index_ = 0;
  std::size_t next_in_protocol_ = 0;
  std::vector<AppliedCommand> applied_;
};

}  // namespace sensory_growth::simulation
