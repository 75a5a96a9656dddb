#pragma once

/// Runs random scenarios and looks at every state.

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"
#include "support/random_scenarios.h"

namespace sensory_growth::support {

/// Nothing infinite, no length that is not positive.
inline bool isSound(const simulation::Organ& organ) {
  const rod::Rod& rod = organ.rod();
  bool sound = true;
  for (const rod::Vertex& v : rod.vertices) sound = sound && v.position.allFinite() && v.velocity.allFinite();
  for (const rod::Bend& b : rod.bends) sound = sound && b.curvature.allFinite() && b.rest_curvature.allFinite();
  for (const rod::Element& e : rod.elements) {
    sound = sound && std::isfinite(e.rest_length) && e.rest_length > 0.0 && e.reference_length > 0.0 &&
            std::isfinite(e.section.radius) && e.section.radius > 0.0 && e.strain.allFinite() &&
            e.rest_strain.allFinite() && std::isfinite(e.age) && e.age >= 0.0 && e.angular_velocity.allFinite() &&
            std::abs(e.frame.norm() - 1.0) < 1e-6;
  }
  for (const double rate : organ.growthRates()) sound = sound && std::isfinite(rate) && rate >= 0.0;
  const mechanics::Energy energy = organ.energy();
  return sound && std::isfinite(energy.bending + energy.stretching + energy.load) &&
         std::isfinite(organ.report().largest_differential_growth);
}

/// Takes an organ away or adds another, if the dice say so; 1 if there was a change.
inline int exchangeOrgan(Dice& dice, simulation::Simulation& simulation, int step, int steps) {
  if (!dice.chance(0.3)) return 0;
  if (!simulation.organs().empty() && dice.chance(0.5)) {
    const simulation::RemoveCommand command{dice.pick(simulation.organs()).scenario().id};
    return simulation.apply(command).refusal.empty() ? 1 : 0;
  }
  Draft draft = {};
  draft.steps = steps;
  draft.method = "static";
  draft.step = simulation.scenario().stepping.step;
  std::string text = organText(dice, draft, 100 + step);
  text[text.find('-')] = ' ';  // no entry of a sequence
  return simulation.apply(simulation::SpawnCommand{text}).refusal.empty() ? 1 : 0;
}

/// How many of `count` scenarios, from the given seed on, took all their steps; the others reported a fault, and all
/// states were sound.
inline int soundRuns(unsigned first_seed, int count, int steps, const std::string& method) {
  int complete = 0;
  for (unsigned seed = first_seed; seed < first_seed + static_cast<unsigned>(count); ++seed) {
    const std::string text = randomScenario(seed, steps, method);
    SCOPED_TRACE(text);
    try {
      simulation::Simulation simulation(simulation::parseScenario(text, "random"));
      bool ok = true;
      for (int i = 0; i < steps && ok; ++i) {
        const simulation::StepReport report = simulation.step();
        ok = report.ok;
        EXPECT_EQ(ok, report.message.empty());
        for (const simulation::Organ& organ : simulation.organs()) {
          if (isSound(organ)) continue;
          ADD_FAILURE() << "organ " << organ.scenario().id << " after step " << simulation.stepIndex() << "; "
                        << report.message;
          return complete;
        }
      }
      if (ok) ++complete;
    } catch (const std::invalid_argument&) {
      // No equilibrium to start from.
    }
  }
  return complete;
}

}  // namespace sensory_growth::support
