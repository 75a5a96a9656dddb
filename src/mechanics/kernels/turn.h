#pragma once

/// Turns between frames and their rotation vectors with derivatives (model.md 15), without branches. The functions of
/// rod/rotations.h do the same for one element.

#include "kernels/lanes.h"

namespace sensory_growth::mechanics::kernels {
namespace {

struct Quaternion {
  Lanes w;
  Vector v;
};

/// conj(a) * b: b as seen from a.
inline Quaternion between(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w + a.v.dot(b.v), Vector(b.v * a.w - a.v * b.w - a.v.cross(b.v))};
}

/// Components of the world vector x in the frame q.
inline Vector inFrame(const Quaternion& q, const Vector& x) {
  const Vector t = Lanes(2.0) * q.v.cross(x);
  return x - q.w * t + q.v.cross(t);
}

/// The vector with components x in the frame q, in the world.
inline Vector inWorld(const Quaternion& q, const Vector& x) {
  const Vector t = Lanes(2.0) * q.v.cross(x);
  return x + q.w * t + q.v.cross(t);
}

inline Quaternion normalized(const Quaternion& q) {
  const Lanes scale = Lanes(1.0) / sqrt(q.w * q.w + q.v.dot(q.v));
  return {q.w * scale, Vector(q.v * scale)};
}

/// The same for a quaternion that is short or long by round-off only: a Newton step towards 1 / |q|.
inline Quaternion renormalized(const Quaternion& q) {
  const Lanes scale = Lanes(1.5) - Lanes(0.5) * (q.w * q.w + q.v.dot(q.v));
  return {q.w * scale, Vector(q.v * scale)};
}

/// sum of coefficient[k] x^k, k < N.
template <std::size_t N>
Lanes polynomial(const double (&coefficient)[N], const Lanes& x) {
  Lanes sum(coefficient[N - 1]);
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + Lanes(coefficient[k]);
  return sum;
}

/// q * exp(w), normalised, for turns up to pi.
inline Quaternion turned(const Quaternion& q, const Vector& w) {
  // sin(x) / x and cos(x) as series in x^2 for x up to pi / 2. Library functions would reduce larger arguments with
  // code of external linkage, which must not be compiled for one instruction set and linked for another.
  constexpr double kSine[] = {1.0,
                              -1.0 / 6.0,
                              1.0 / 120.0,
                              -1.0 / 5040.0,
                              1.0 / 362880.0,
                              -1.0 / 39916800.0,
                              1.0 / 6227020800.0,
                              -1.0 / 1307674368000.0,
                              1.0 / 355687428096000.0,
                              -1.0 / 121645100408832000.0,
                              1.0 / 51090942171709440000.0};
  constexpr double kCosine[] = {1.0,
                                -1.0 / 2.0,
                                1.0 / 24.0,
                                -1.0 / 720.0,
                                1.0 / 40320.0,
                                -1.0 / 3628800.0,
                                1.0 / 479001600.0,
                                -1.0 / 87178291200.0,
                                1.0 / 20922789888000.0,
                                -1.0 / 6402373705728000.0,
                                1.0 / 2432902008176640000.0,
                                -1.0 / 1124000727777607680000.0};
  const Lanes half2 = Lanes(0.25) * w.dot(w);
  const Lanes cosine = polynomial(kCosine, half2);
  const Vector u = (Lanes(0.5) * polynomial(kSine, half2)) * w;
  return normalized({q.w * cosine - q.v.dot(u), Vector(cosine * q.v + q.w * u + q.v.cross(u))});
}

/// Rotation vector theta of a turn and the coefficient c of J_l^-1(theta) = 1 - [theta]/2 + c [theta]^2.
struct Turn {
  Vector theta;
  Lanes phi2;  ///< |theta|^2
  Lanes c;
  Lanes slope;  ///< c'(phi) / phi

  /// J_l^-1(theta) m and its transpose times m.
  Vector inverseJacobian(const Vector& m) const { return even(m) - odd(m); }
  Vector inverseJacobianTransposed(const Vector& m) const { return even(m) + odd(m); }

  Matrix inverseJacobian() const {
    const Vector half = Lanes(0.5) * theta;
    const Vector ct = c * theta;
    const Lanes diagonal = Lanes(1.0) - c * phi2;
    Matrix j = ct * theta.transpose();
    j(0, 0) += diagonal, j(1, 1) += diagonal, j(2, 2) += diagonal;
    j(0, 1) += half[2], j(1, 0) -= half[2];
    j(2, 0) += half[1], j(0, 2) -= half[1];
    j(1, 2) += half[0], j(2, 1) -= half[0];
    return j;
  }

  /// Even part in theta of the derivative of J_l^-1(theta) m; the odd part is [m] / 2.
  Matrix derivative(const Vector& m) const {
    const Lanes along = theta.dot(m);
    const Vector left = slope * (along * theta - phi2 * m) - Lanes(2.0) * c * m;
    const Vector ct = c * theta;
    Matrix d = ct * m.transpose() + left * theta.transpose();
    const Lanes diagonal = c * along;
    d(0, 0) += diagonal, d(1, 1) += diagonal, d(2, 2) += diagonal;
    return d;
  }

 private:
  Vector even(const Vector& m) const { return m + c * (theta * theta.dot(m) - phi2 * m); }
  Vector odd(const Vector& m) const { return Lanes(0.5) * theta.cross(m); }
};

/// From the unit quaternion of the turn, for turns below pi.
inline Turn turn(const Quaternion& q) {
  // |B_2k| / (2k)!, of the series of c in phi^2; closed forms take over where it would need more terms.
  constexpr double kSeries[] = {1.0 / 12.0,
                                1.0 / 720.0,
                                1.0 / 30240.0,
                                1.0 / 1209600.0,
                                1.0 / 47900160.0,
                                691.0 / 1307674368000.0,
                                1.0 / 74724249600.0,
                                3617.0 / 10670622842880000.0,
                                43867.0 / 5109094217170944000.0,
                                174611.0 / 802857662698291200000.0};
  constexpr double kSlopeSeries[] = {2.0 * kSeries[1],  4.0 * kSeries[2],  6.0 * kSeries[3],
                                     8.0 * kSeries[4],  10.0 * kSeries[5], 12.0 * kSeries[6],
                                     14.0 * kSeries[7], 16.0 * kSeries[8], 18.0 * kSeries[9]};
  const Lanes one(1.0);
  const Lanes sign = select(q.w < Lanes(0.0), Lanes(-1.0), one);
  const Lanes w = sign * q.w;
  const Lanes sine2 = q.v.dot(q.v);
  const Lanes sine = sqrt(sine2);
  const Lanes ratio = select(sine2 > Lanes(0.0), atan2(sine, w) / sine, one);  // half angle over its sine

  Turn turn;
  turn.theta = (Lanes(2.0) * sign * ratio) * q.v;
  turn.phi2 = Lanes(4.0) * ratio * ratio * sine2;
  const Lanes per_phi2 = one / turn.phi2;
  const Lanes half_cotangent = ratio * w;  // phi/2 cot(phi/2)
  const auto small = turn.phi2 < one;
  const Lanes c_closed = (one - half_cotangent) * per_phi2;
  const Lanes slope_closed = (Lanes(0.25) / sine2 + (half_cotangent - Lanes(2.0)) * per_phi2) * per_phi2;
  turn.c = select(small, polynomial(kSeries, turn.phi2), c_closed);
  turn.slope = select(small, polynomial(kSlopeSeries, turn.phi2), slope_closed);
  return turn;
}

}  // namespace
}  // namespace sensory_growth::mechanics::kernels
