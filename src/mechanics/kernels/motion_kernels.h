#pragma once

/// The passes of a time step over a moving rod (model.md 13), one set per instruction set.

#include <cstddef>

namespace sensory_growth::mechanics::kernels {

/// A column per component. Columns can be read and written from index 0 to two packets beyond the rod, where they hold
/// padding: zeros, so that nothing acts there.
struct Columns3 {
  double* column[3];
};

/// A column each for w, x, y, z of unit quaternions.
struct Columns4 {
  double* column[4];
};

/// Element e, vertex e + 1 and bend e share index e, unless a comment says more. What belongs to vertex 0 is left out,
/// for it is held.
struct MotionView {
  std::size_t size = 0;  ///< elements

  // What stays constant.
  const double* rest_length;      ///< [m]
  const double* inverse_length;   ///< [1/m]
  const double* inverse_voronoi;  ///< [1/m]
  const double* inverse_mass;     ///< [1/kg]
  const double* inverse_inertia;  ///< of the turn of an element about d1 and d2 [1/(kg m^2)]; zero if it may not turn
  Columns3 stretch_stiffness;     ///< [N]
  Columns3 rest_stretch;          ///< e3 + sigma0 [-]
  Columns3 bend_stiffness;        ///< [N m^2]
  Columns3 rest_curvature;        ///< [1/m]
  Columns3 applied_force;         ///< on vertices from outside [N]
  Columns3 applied_couple;        ///< on elements from outside, in their frames [N m]

  // The state.
  Columns3 position;          ///< vertex v at v [m]
  Columns4 frame;             ///< the base at 0, element e at e + 1
  Columns3 velocity;          ///< [m/s]
  Columns3 angular_velocity;  ///< in the material frame [rad/s]

  // Forces where the rod stands.
  Columns3 force;          ///< of an element on its lower vertex, in the world [N]
  Columns3 couple;         ///< on an element, of its own force and of the bend below it [N m]
  Columns3 lower_couple;   ///< of a bend on the element below it [N m]
  double* current_length;  ///< of element e at e + 1, zero at 0 [m]; for the classical law
};

struct Kick {
  double dt = 0.0;       ///< time step [s]
  double decay = 1.0;    ///< of velocities in a time step [-]
  double impulse = 0.0;  ///< what a unit of force adds to the momentum in a time step [s]
};

struct MotionKernels {
  void (*evaluate)(const MotionView&);           ///< forces from the energy
  void (*evaluateClassical)(const MotionView&);  ///< forces with dilatation factors (model.md 1.5)
  void (*kickAndDrift)(const MotionView&, const Kick&, double drift);
  void (*drift)(const MotionView&, double dt);
};

/// Those of the instruction set in use.
const MotionKernels& motionKernels();

const MotionKernels& motionKernelsBaseline();
const MotionKernels& motionKernelsAvx2();
const MotionKernels& motionKernelsAvx512();

}  // namespace sensory_growth::mechanics::kernels
