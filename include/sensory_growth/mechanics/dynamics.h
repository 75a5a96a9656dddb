#pragma once

/// The motion of a damped rod: as a way to relax, and on its own (model.md 13; Gazzola et al. 2018).
///
/// Forces derive from the energy that the statics minimises, so both end in the same shape; this one takes tens of
/// thousands of steps for it. It follows the rod down from where it stands, so it never jumps between branches.

#include <memory>
#include <optional>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// When a moving rod counts as relaxed.
enum class StoppingRule {
  residual,           ///< scaled residual and kinetic energy stay below their bounds for half a first period
  rotational_energy,  ///< the draft's rule, neither scale-free nor safe: a rod that starts at rest fulfils it at once
};

/// "First period" is 2 pi / firstFrequency(rod).
struct DynamicsSettings {
  std::optional<double> damping;  ///< rate c at which velocities decay [1/s], >= 0; empty: 2 firstFrequency(rod)
  double time_step = 0.3;      ///< over min(h sqrt(rho / E), R sqrt(rho / G)) [-]; in (0, 1], unstable above about 0.7
  double ramp_periods = 3.0;   ///< time over which forces not yet carried come on, in first periods [-]; >= 0
  double max_periods = 200.0;  ///< longest time of one relaxation, in first periods [-]; in (0, 10000]
  double max_bend_angle = 1.5707963267948966;  ///< larger turns between neighbours are refused as unresolved [rad]
  bool dilatation = false;  ///< the classical law, which has no potential, instead of the energy's (model.md 1.5)

  StoppingRule stopping = StoppingRule::residual;
  double tolerance = 1e-9;     ///< residual rule: on the scaled residual [-], in (0, 1); docs/model.md 13
  double rest_energy = 1e-12;  ///< the draft's rule: bound on the rotational kinetic energy [J]; > 0
  int rest_steps = 500;        ///< the draft's rule: time steps in a row [-]; >= 1
};

/// First angular frequency [rad/s] of the straightened rod, clamped at its base and without loads: Rayleigh's quotient
/// of the deflection under its own weight, which is 0.4 % above 3.516 sqrt(E I / rho A) / L^2 where that holds, and
/// takes any distribution of stiffness and mass. A hinged rod swings more slowly than that.
double firstFrequency(const rod::Rod& rod);

/// min(h sqrt(rho / E), R sqrt(rho / G)) over the elements [s]; zero if one is inextensible or has no mass.
double waveTime(const rod::Rod& rod);

class RodMotion;

/// Owns the work space of its steps.
class DynamicRelaxation {
 public:
  explicit DynamicRelaxation(const DynamicsSettings& settings = {});
  ~DynamicRelaxation();
  DynamicRelaxation(DynamicRelaxation&&) noexcept;
  DynamicRelaxation& operator=(DynamicRelaxation&&) noexcept;

  /// Lets the rod move from where it stands, starting at rest, until it rests. Forces that it does not carry yet
  /// come on smoothly. On failure the rod is left as it was given.
  RelaxationReport relax(rod::Rod& rod, const Loads& loads);

  /// Lets the rod move for `duration` [s], starting with its velocities, and leaves it moving. Rest state, loads and
  /// number of elements may change between calls. On failure the rod is left as it was given.
  RelaxationReport advance(rod::Rod& rod, const Loads& loads, double duration);

 private:
  struct Timing;
  RelaxationReport reportAtStart(const Timing& times);
  void measure(RelaxationReport& report) const;
  void settle(const Timing& times, RelaxationReport& report);
  bool isStable(const rod::Rod& rod, const Loads& loads, RelaxationReport& report) const;

  DynamicsSettings settings_;
  std::unique_ptr<RodMotion> motion_;
};

}  // namespace sensory_growth::mechanics
