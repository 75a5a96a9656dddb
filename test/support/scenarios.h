#pragma once

/// Small scenarios in the units of the reference solutions: length about 1, growth rate 1, no step limits.

#include <limits>

#include "sensory_growth/simulation/scenario.h"
#include "support/rods.h"

namespace sensory_growth::support {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

inline simulation::StepLimits noLimits() {
  simulation::StepLimits limits;
  limits.tip_advance = limits.growth_strain = limits.bend_angle = limits.total_angle = limits.oscillation = kUnlimited;
  return limits;
}

/// One horizontal organ along +x of radius 0.05 that grows uniformly at rate 1, without elasticity and without cues.
inline simulation::Scenario kinematicScenario(double step, std::size_t elements = 100) {
  simulation::OrganScenario organ;
  organ.id = "organ";
  organ.base.frame = alongX();
  organ.length = 1.0;
  organ.elements = elements;
  organ.section = section(0.05, 1.0, 0.0);
  organ.profile = growth::UniformProfile{1.0};
  organ.longest_element = kUnlimited;

  simulation::Scenario scenario;
  scenario.name = "test";
  scenario.weight = false;
  scenario.relaxation = simulation::RelaxationMethod::kinematics;
  scenario.stepping.step = step;
  scenario.stepping.limits = noLimits();
  scenario.organs = {organ};
  return scenario;
}

}  // namespace sensory_growth::support
