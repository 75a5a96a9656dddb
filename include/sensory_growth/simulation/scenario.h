#pragma once

/// Everything that defines a simulation before it starts. Plain data in SI units; simulation/scenario_yaml.h reads it.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sensory_growth/growth/aging.h"
#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/differential_growth.h"
#include "sensory_growth/growth/perception.h"
#include "sensory_growth/growth/profile.h"
#include "sensory_growth/growth/stress_coupling.h"
#include "sensory_growth/mechanics/dynamics.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/division.h"
#include "sensory_growth/rod/rod.h"
#include "sensory_growth/simulation/commands.h"

namespace sensory_growth::simulation {

/// An organ whose elements become more than these fails: without a limit, growth would go on until memory ends.
constexpr std::size_t kMostElements = 100000;

/// How the organ finds its shape once the rest state has grown.
enum class RelaxationMethod {
  statics,     ///< elastic equilibrium at every step, by Newton's method
  dynamics,    ///< the same by damped motion
  continuous,  ///< no equilibrium: growth and motion go on together
  kinematics,  ///< no elasticity: the organ is its rest state
};

/// An organ that the others sense as a point source that moves (model.md 14).
struct OrganSource {
  double label = 1.0;     ///< of the tissue that they sense, in [0, 1]; 1 is the apex
  double strength = 1.0;  ///< multiplies their sensitivity to point sources [-]; negative repels
};

struct OrganScenario {
  std::string id;  ///< a valid ROS graph name: letters, digits, '_', starts with a letter
  rod::Pose base;
  double length = 0.0;       ///< rest length at the start [m]
  std::size_t elements = 0;  ///< at the start
  rod::Section section;
  rod::BaseSupport base_support = rod::BaseSupport::clamped;
  mechanics::Loads loads;                              ///< without gravity, which the scenario gives for all organs
  rod::Vector3 rest_curvature = rod::Vector3::Zero();  ///< of every bend at the start, material components [1/m]

  growth::Profile profile = growth::UniformProfile{};
  bool elongation = true;  ///< off: the organ bends by growth but keeps its length (the AC model)
  growth::TwistTransport twist_transport = growth::TwistTransport::angle;
  std::optional<growth::StressCoupling> stress_coupling;  ///< of tissue that can stretch: not if inextensible
  growth::Senses senses;
  std::vector<growth::Route> sensing;  ///< of cues that are not perceived where and when they are
  growth::BendingLaw bending;
  std::optional<growth::Aging> aging;
  std::optional<OrganSource> source;  ///< nothing: the others do not sense it

  double longest_element = std::numeric_limits<double>::infinity();  ///< longer elements divide [m]; infinity: never
  rod::DivisionMode division = rod::DivisionMode::keep_strain;
};

/// Limits on a growth step; longer steps are cut into equal parts (model.md 11.2). Infinity switches a limit off.
struct StepLimits {
  double tip_advance = 0.5;     ///< of the tip, as a fraction of longest_element [-]
  double growth_strain = 0.05;  ///< of any element [-]
  double growth_stress = 0.5;   ///< that growth builds up where it is held, as a fraction of the yield margin [-]
  double bend_angle = 0.02;     ///< turning of one bend [rad]
  double total_angle = 0.1;     ///< summed turning of all bends [rad]
  double oscillation = 0.1;     ///< of any circumnutation, as a fraction of its period [-]
  double smallest_part =
      1.0 / 4096.0;  ///< of a step; when failing relaxations or the limits above ask for less, it fails [-]
};

struct Stepping {
  double step = 0.0;         ///< growth time between two published states and between stimulus changes [s]
  bool second_order = true;  ///< predictor-corrector; false stops after the predictor
  StepLimits limits;
};

struct Scenario {
  std::string name;
  std::string description;                   ///< what one should see; may be empty
  rod::Vector3 gravity = {0.0, 0.0, -9.81};  ///< [m/s^2]; its direction is what organs sense as down
  bool weight = true;                        ///< off: gravity is sensed but does not load the organs
  RelaxationMethod relaxation = RelaxationMethod::statics;
  mechanics::RelaxationSettings relaxation_settings;  ///< of statics and kinematics
  mechanics::DynamicsSettings dynamics_settings;      ///< of dynamics and continuous
  double growth_per_second = 0.0;  ///< continuous: growth time that passes in a second of motion [s/s]
  Stepping stepping;
  double duration = 0.0;  ///< growth time after which an unattended run ends [s]; 0: never
  std::vector<OrganScenario> organs;
  std::vector<TimedCommand> protocol;  ///< in order of time; time 0 is the start
};

}  // namespace sensory_growth::simulation
