#pragma once

/// Running a scenario of one organ through the public interface, and what one reads off it.

#include <cmath>

#include <gtest/gtest.h>

#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::support {

inline void takeSteps(simulation::Simulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) {
    const simulation::StepReport report = simulation.step();
    ASSERT_TRUE(report.ok) << report.message;
  }
}

inline const rod::Rod& onlyRod(const simulation::Simulation& simulation) { return simulation.organs().front().rod(); }

inline rod::Rod grown(const simulation::Scenario& scenario, long steps) {
  simulation::Simulation simulation(scenario);
  takeSteps(simulation, steps);
  return onlyRod(simulation);
}

inline rod::Vector3 tip(const rod::Rod& rod) { return rod.vertices.back().position; }

inline rod::Vector3 tipDirection(const rod::Rod& rod) { return rod.apex().frame * rod::Vector3::UnitZ(); }

/// Angle of the apex from the vertical in the x-z plane [rad], negative once it has passed it.
inline double tipAngle(const rod::Rod& rod) {
  const rod::Vector3 direction = tipDirection(rod);
  return std::atan2(direction.x(), direction.z());
}

inline double degrees(double radians) { return radians * 180.0 / M_PI; }

}  // namespace sensory_growth::support
