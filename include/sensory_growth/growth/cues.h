#pragma once

/// From what an organ senses to the differential growth that each cue asks for (model.md 4.3 and 5).

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sensory_growth/growth/distance_law.h"
#include "sensory_growth/growth/environment.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

enum class Cue { gravity, light_direction, point_source, oscillator };
constexpr std::size_t kCues = 4;

const char* name(Cue cue);

/// A clock within the tissue that makes an organ circumnutate: it asks for growth towards a direction that turns in the
/// cross-section, from d1 to d2 for positive periods.
struct Oscillator {
  double amplitude = 0.0;       ///< [-]
  double period = 1.0;          ///< of growth time [s]; negative turns from d2 to d1
  double phase = 0.0;           ///< angle from d1 at time 0, at the apex [rad]
  double phase_gradient = 0.0;  ///< by which tissue lags behind the apex, per rest length [rad/m]
};

/// How strongly an organ answers each cue. All sensitivities are dimensionless; a negative one turns away.
struct Senses {
  double gravity = 0.0;  ///< > 0 for a shoot (grows up), < 0 for a root
  double light_direction = 0.0;
  double point_source = 0.0;
  double softening_length =
      0.0;  ///< distance to a point source below which its pull fades, so that it stays finite [m]
  double intensity_exponent =
      1.0;  ///< lights and point sources of strength I act as |I|^exponent, with the sign of I [-]
  DistanceLaw distance = ConstantPull{};  ///< of the pull of point sources
  Oscillator oscillator = {};
};

/// Why the senses make no sense, or nothing.
std::optional<std::string> findFault(const Senses& senses);

/// Somewhere in an organ.
struct Place {
  rod::Vector3 position;
  rod::Quaternion frame;
  double from_apex = 0.0;  ///< along the rest arc length [m]
};

/// Differential growth vector [-] of every cue at one place: components along d1 and d2 there.
using SectionCues = std::array<Eigen::Vector2d, kCues>;

/// Components along d1 and d2 of the frame of every bend; size n, zero at a bend without stiffness.
using SectionField = std::vector<Eigen::Vector2d>;

/// The field of every cue; cues that an organ does not answer have the field zero.
using CueFields = std::array<SectionField, kCues>;

/// What the cues ask for at one time, as a function of place. Must not outlive its arguments.
class CueField {
 public:
  CueField(const Senses& senses, const Environment& environment, double time);

  /// Finite for every finite input.
  SectionCues at(const Place& place) const;

  /// What every bend of a rod senses, with its actual frame and position, several bends at a time.
  void along(const rod::Rod& rod, CueFields& cues) const;

 private:
  double response(double strength) const;
  rod::Vector3 towardsPointSources(const rod::Vector3& position) const;
  Eigen::Vector2d oscillation(double from_apex) const;

  const Senses& senses_;
  const std::vector<PointSource>& point_sources_;
  double later_;                 ///< than the time for which they stand [s]
  rod::Vector3 up_;              ///< of gravity alone, the same everywhere
  rod::Vector3 towards_lights_;  ///< the same for parallel light
  double apical_phase_;          ///< of the oscillator [rad]
};

/// What every bend senses of every cue there and then, with its actual frame and position.
void sense(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod, CueFields& cues);

}  // namespace sensory_growth::growth
