#pragma once

/// A rod in motion: position Verlet for its vertices and frames (model.md 13; Gazzola et al. 2018).
///
/// The forces derive from the energy that the statics minimises. State and parameters are structures of arrays for the
/// kernels, which work on several neighbouring elements at once. A step allocates nothing.

#include <cstddef>
#include <vector>

#include "kernels/motion_kernels.h"
#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/rod/rod.h"
#include "surroundings_potential.h"

namespace sensory_growth::mechanics {

class RodMotion {
 public:
  /// Takes state, velocities, parameters and loads. With `dilatation` the forces follow the classical law (model.md
  /// 1.5): forces of an element over its stretch, couples of a bend over the cube of it. Reuses the memory of earlier
  /// calls.
  void assign(const rod::Rod& rod, const Loads& loads, bool dilatation);

  /// Writes positions, frames, strains and velocities. Expects the rod that was assigned.
  void write(rod::Rod& rod) const;

  std::size_t size() const { return view_.size; }

  /// Sets all velocities to zero.
  void stop();

  /// Length [s] and damping rate [1/s] of the steps to come.
  void setTimeStep(double dt, double damping);

  /// Moves on with the velocities there are, for `dt` [s].
  void drift(double dt);

  /// Forces and couples where the rod stands.
  void evaluate();

  /// Changes the velocities by the forces of the last evaluate() over one time step, then drifts for `dt`. A drift of a
  /// whole step is the second half of one step and the first half of the next.
  void kickAndDrift(double dt);

  /// Share of the dead forces that the elements carry where the rod stands, between 0 and 1 (least squares); 1 if there
  /// are none. Of the last evaluate().
  double carriedShare() const;

  /// Applies only this share of the dead forces.
  void setShare(double share);

  /// Largest couple on an element, and largest force on all that lies beyond an element times the rod's length, over
  /// coupleScale() [-] (model.md 12.4). Of the last evaluate(); NaN if anything is.
  Residual residual() const;

  /// Bound on the residual that round-off keeps alive [-]: strains are differences of positions, so they are wrong by
  /// about the machine precision times L over the length of an element, and their vibration adds up along the rod. Ten
  /// times what was measured for 20 to 100 elements, L / R from 20 to 400 and w L^3 / B from 0.1 to 10.
  double restingResidual() const;

  double kineticEnergy() const;     ///< [J]
  double rotationalEnergy() const;  ///< the part of it in the turning of elements [J]
  double largestBend() const;       ///< largest turn between neighbouring elements [rad]

  /// max(W L, B / L) with W the sum of the forces [N m].
  double coupleScale() const { return couple_scale_; }

  /// B / L, the couple that bends the rod by about one radian [N m].
  double bendingScale() const { return bending_scale_; }

  /// W L + B / L [J].
  double energyScale() const { return energy_scale_; }

 private:
  struct Vectors {
    std::vector<double> x, y, z;

    void clear(std::size_t n);  ///< n zeros each
    kernels::Columns3 columns() { return {{x.data(), y.data(), z.data()}}; }
    rod::Vector3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const rod::Vector3& v);
  };
  struct Frames {
    std::vector<double> w;
    Vectors v;

    rod::Quaternion at(std::size_t i) const { return {w[i], v.x[i], v.y[i], v.z[i]}; }
    void set(std::size_t i, const rod::Quaternion& q);
  };

  void clear(std::size_t elements);
  void makeView(std::size_t elements);
  void addUpForces();
  rod::Vector3 freeForce(std::size_t e) const;
  rod::Vector3 freeCouple(std::size_t e) const;

  const kernels::MotionKernels* kernels_ = nullptr;
  kernels::MotionView view_;  // of the arrays below, which are explained where it is declared
  kernels::Kick kick_;
  std::vector<double> rest_length_, inverse_length_, inverse_voronoi_, inverse_mass_, inverse_inertia_;
  Vectors stretch_stiffness_, rest_stretch_, bend_stiffness_, rest_curvature_;
  Vectors dead_force_, dead_couple_;
  bool has_surroundings_ = false;
  SurroundingsPotential surroundings_;
  rod::Vector3 base_ = rod::Vector3::Zero();
  Field from_base_;  ///< positions relative to the base
  double couple_scale_ = 0.0;
  double bending_scale_ = 0.0;
  double energy_scale_ = 0.0;
  double rest_length_sum_ = 0.0;
  bool dilatation_ = false;
  std::size_t first_bend_ = 0;

  Vectors position_, velocity_, angular_velocity_;
  Frames frame_;
  Vectors force_, couple_, lower_couple_, applied_force_;
  std::vector<double> current_length_;
  double share_ = 1.0;
};

}  // namespace sensory_growth::mechanics
