#pragma once

/// The growing organs of the figures.

#include <cstddef>
#include <limits>
#include <string>

#include "rods.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::bench {

/// Stems that lean by 30 degrees, each to another side, and grow by 2 % in a logistic zone per step, of one part. They
/// sense gravity, a light direction and a lamp.
inline simulation::Simulation growingStems(std::size_t organs, std::size_t elements, int threads = 1) {
  using rod::Vector3;
  simulation::Scenario scenario;
  scenario.name = "stems";
  scenario.stepping.step = 0.02;
  scenario.stepping.limits.tip_advance = scenario.stepping.limits.bend_angle = scenario.stepping.limits.total_angle =
      std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < organs; ++i) {
    simulation::OrganScenario organ;
    organ.id = "stem_" + std::to_string(i);
    organ.base.frame = rod::exp(static_cast<double>(i) * Vector3::UnitZ()) * rod::exp(M_PI / 6.0 * Vector3::UnitY());
    organ.length = 0.1;
    organ.elements = elements;
    organ.section = stemSection();
    organ.profile = growth::LogisticProfile{1.0, 0.04, 15.0};
    organ.senses = {0.05, 0.1, 0.1, 0.01};
    organ.bending.proprioception.intrinsic_length = 1e-4;
    scenario.organs.push_back(organ);
  }
  using simulation::StimulusCommand;
  using simulation::StimulusKind;
  using simulation::StimulusOperation;
  scenario.protocol = {
      {0.0, StimulusCommand{StimulusKind::light_direction, StimulusOperation::add, "sun", {1.0, 0.3, 0.0}, 1.0}},
      {0.0, StimulusCommand{StimulusKind::point_source, StimulusOperation::add, "lamp", {0.1, 0.1, 0.2}, 1.0}}};
  return simulation::Simulation(scenario, threads);
}

}  // namespace sensory_growth::bench
