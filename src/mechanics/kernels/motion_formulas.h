#pragma once

/// The formulas of one element and one bend that a time step needs (model.md 13, 15), beyond those of turn.h: without
/// branches and without trigonometric functions, because the turn of a time step is small and that of a bend moderate.

#include "kernels/lanes.h"
#include "kernels/turn.h"

namespace sensory_growth::mechanics::kernels {
namespace {

/// q * exp(theta), of unit length to round-off; exact for |theta| < 0.2 rad, where the series end. The turn of a stable
/// time step is far smaller.
inline Quaternion turnedLittle(const Quaternion& q, const Vector& theta) {
  constexpr double kCosine[] = {1.0, -1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0};
  constexpr double kSineRatio[] = {1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0};
  const Vector half = Lanes(0.5) * theta;
  const Lanes y = half.dot(half);
  const Lanes cosine = polynomial(kCosine, y);
  const Vector u = polynomial(kSineRatio, y) * half;
  return renormalized({q.w * cosine - q.v.dot(u), Vector(cosine * q.v + q.w * u + q.v.cross(u))});
}

/// atan(sqrt(u)) / sqrt(u), interpolated at Chebyshev points: to 1e-15 for 0 <= u <= 0.44.
inline Lanes arctangentRatio(const Lanes& u) {
  constexpr double kSeries[] = {1.0,
                                -0.333333333333331,
                                0.1999999999982119,
                                -0.14285714262818605,
                                0.11111109953399516,
                                -0.09090878498865912,
                                0.07691823138191412,
                                -0.06661693268157243,
                                0.05847686444184053,
                                -0.05094397348372883,
                                0.04179211842474561,
                                -0.02909907711172361,
                                0.014463833564925692,
                                -0.0036577736717552487};
  return polynomial(kSeries, u);
}

/// What a bend does to the elements at its ends [N m], each in the frame of its element: `upper` is J(theta) m and
/// `lower` its transpose J(-theta) m.
struct BendCouples {
  Vector lower, upper;
};

/// With turn = (cos(phi/2), s), theta = 2 a s, a = (phi/2) / sin(phi/2) and J m = m - a s x m + b s x (s x m), where
/// b = (1 - a cos(phi/2)) / |s|^2. That b loses its digits near zero does no harm, since it multiplies |s|^2. To 1e-15
/// for turns of less than 2.3 rad.
inline BendCouples bendCouples(const Quaternion& turn, const Lanes& inverse_voronoi, const Vector& rest_curvature,
                               const Vector& stiffness) {
  const Lanes one(1.0);
  const Lanes s2 = turn.v.dot(turn.v);
  // A hinge, which has no stiffness, may turn all the way round, where the formula has no limit.
  const auto bends = stiffness[0] > Lanes(0.0);
  const Lanes quarter = one / select(bends, one + turn.w, one);
  const Lanes a = Lanes(2.0) * quarter * arctangentRatio(s2 * quarter * quarter);
  const Lanes b = (one - turn.w * a) / (s2 + Lanes(1e-300));
  const Vector curvature = (Lanes(2.0) * a * inverse_voronoi) * turn.v;
  const Vector m = stiffness.cwiseProduct(curvature - rest_curvature);
  const Vector across = turn.v.cross(m);
  const Vector even = m + b * turn.v.cross(across);
  const Vector odd = a * across;
  return {even + odd, even - odd};
}

/// Angular velocity of a free body with moments of inertia in the ratio 1:1:2 after the time dt: the first two
/// components turn about the third, by Cayley's map, which keeps their length.
inline Vector precessed(const Vector& w, const Lanes& dt) {
  const Lanes one(1.0);
  const Lanes t = Lanes(0.5) * dt * w[2];
  const Lanes scale = one / (one + t * t);
  const Lanes cosine = (one - t * t) * scale;
  const Lanes sine = Lanes(2.0) * t * scale;
  return {cosine * w[0] - sine * w[1], sine * w[0] + cosine * w[1], w[2]};
}

}  // namespace
}  // namespace sensory_growth::mechanics::kernels
