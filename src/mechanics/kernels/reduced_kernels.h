#pragma once

/// The innermost loops of the reduced energy (model.md 12.2, 12.3), one set per instruction set.
///
/// Elements are addressed through packets; those beyond the last one are padding without stiffness or force. The
/// Hessian never exists as a whole: it is made a few packets at a time, from the tip to the base, and eliminated at
/// once, so that long rods are not limited by memory.

#include <cstddef>

#include "kernels/packets.h"

namespace sensory_growth::mechanics::kernels {

/// What stays constant while frames change, of eight elements e and the bends below them.
struct RodPacket {
  Packet stiffness[3];     ///< of the bend over its Voronoi length, B / D [N m]
  Packet rest_angle[3];    ///< of the bend, D kappa0 [rad]
  Packet force[3];         ///< carried by the element times its rest length, in the world [N m]
  Packet couple[3];        ///< from outside, in the material frame [N m]
  Packet rest_stretch[3];  ///< e3 + sigma0 [-]
  Packet compliance[2];    ///< shear and stretch compliance over the rest length [1/(N m)]
};

struct RodView {
  std::size_t size = 0;   ///< elements
  std::size_t first = 0;  ///< the first element that may turn: 1 if element 0 is frozen
  const RodPacket* packets = nullptr;
};

/// Unit quaternions (w, x, y, z), a column each, readable from index -1, which is the base, to the end of the padding.
struct FrameView {
  double* column[4];
};

/// A rotation vector per element, a column per component.
struct TurnView {
  double* column[3];
};

struct Evaluation {
  double energy = 0.0;            ///< [J], up to a constant
  double magnitude = 0.0;         ///< sum of the magnitudes of its terms [J], which bounds its round-off
  double largest_gradient = 0.0;  ///< of an element [N m]; NaN if any is
  double largest_bend = 0.0;      ///< turn between neighbours [rad]
};

/// Row of the block Cholesky factor A = L D L^T that belongs to one element, and the right-hand side on its way.
struct FactorRow {
  double coupling[9];  ///< row e - 1, column e of the unit upper factor, by rows
  double solution[3];  ///< of the elimination from the tip
};

/// Inverse of the block of D that belongs to one element: xx, xy, xz, yy, yz, zz.
struct PivotInverse {
  double entry[6];
};

struct Elimination {
  bool positive = false;   ///< the matrix was positive definite; otherwise nothing else holds
  double decrement = 0.0;  ///< -g . step of the Newton step [J]
};

/// Where a whole Newton step leads.
struct Advance {
  double largest_turn = 0.0;  ///< of an element in the step [rad]
  double last_turn[3] = {};   ///< of the element at the apex [rad]
  Evaluation there;
};

/// Vectors that are solved for at once.
constexpr std::size_t kBlock = 4;

struct BlockProducts {
  double yx[kBlock][kBlock];  ///< row k, column l: vector k of Y times vector l of X
  double yy[kBlock][kBlock];  ///< of the vectors of Y with each other
};

struct ReducedKernels {
  /// Frames from the turns of the bends, up from the base frame at index -1. The turns are those of whole packets.
  void (*rebuild)(const RodView&, const TurnView& bends, const FrameView& frames);

  Evaluation (*evaluate)(const RodView&, const FrameView&);

  /// Factors Hessian + shift * 1 and eliminates minus the gradient. The inverses of the pivots, which the Newton step
  /// does not need, are kept if there is room for them.
  Elimination (*eliminate)(const RodView&, const FrameView&, double shift, FactorRow*, PivotInverse* room);

  /// The Newton step by substitution after eliminate().
  void (*substitute)(const RodView&, const FactorRow*, const TurnView& step);

  /// frames turned by the Newton step, and what holds there, in one go through memory.
  Advance (*advance)(const RodView&, const FactorRow*, const FrameView& frames, const FrameView& moved);

  /// The same without an evaluation.
  Advance (*advanceBlindly)(const RodView&, const FactorRow*, const FrameView& frames, const FrameView& moved);

  /// frames turned by scale * step.
  void (*move)(const RodView&, const FrameView& frames, const TurnView& step, double scale, const FrameView& moved);

  /// Y = (Hessian + shift * 1)^-1 mix X after eliminate(), for a block of vectors, of which each component of an
  /// element lies side by side: 3 * kBlock numbers per element. X and Y must not overlap.
  BlockProducts (*solveBlock)(const RodView&, const FactorRow*, const PivotInverse*,
                              const double (&mix)[kBlock][kBlock], const double* x, double* y);

  /// Turn of every bend, strain of every element, and its chord in the world over its rest length.
  void (*strains)(const RodView&, const FrameView&, const TurnView& angle, const TurnView& strain,
                  const TurnView& chord);

  /// Gradient, diagonal blocks (xx, xy, xz, yy, yz, zz) and the blocks at row e - 1, column e (by rows) of the Hessian.
  void (*blocks)(const RodView&, const FrameView&, double (*gradient)[3], double (*diagonal)[6], double (*upper)[9]);
};

/// Those of the instruction set in use.
const ReducedKernels& reducedKernels();

const ReducedKernels& reducedKernelsBaseline();
const ReducedKernels& reducedKernelsAvx2();
const ReducedKernels& reducedKernelsAvx512();

}  // namespace sensory_growth::mechanics::kernels
