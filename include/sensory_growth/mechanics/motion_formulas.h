#pragma once

/// The formulas of one element and one bend that a time step needs (model.md 13, 15): free of branches and of
/// trigonometric functions, and templated over the scalar, which may be a number or a vector of numbers.

namespace sensory_growth::mechanics::formulas {

template <typename T>
struct Triple {
  T x, y, z;
};

template <typename T>
Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <typename T>
Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <typename T>
Triple<T> operator*(const T& s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <typename T>
Triple<T> componentwise(const Triple<T>& a, const Triple<T>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

template <typename T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation as a unit quaternion.
template <typename T>
struct Frame {
  T w;
  Triple<T> v;
};

/// Material components to world components.
template <typename T>
Triple<T> toWorld(const Frame<T>& q, const Triple<T>& a) {
  const Triple<T> t = T(2.0) * cross(q.v, a);
  return a + q.w * t + cross(q.v, t);
}

/// World components to material components.
template <typename T>
Triple<T> toMaterial(const Frame<T>& q, const Triple<T>& a) {
  const Triple<T> t = T(2.0) * cross(q.v, a);
  return a - q.w * t + cross(q.v, t);
}

template <typename T>
Frame<T> operator*(const Frame<T>& a, const Frame<T>& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

/// The rotation that takes `below` to `above`, in material components.
template <typename T>
Frame<T> between(const Frame<T>& below, const Frame<T>& above) {
  return {below.w * above.w + dot(below.v, above.v), below.w * above.v - above.w * below.v - cross(below.v, above.v)};
}

/// R exp(theta), of unit length to round-off. The series end where they are exact for |theta| < 0.2 rad; the turn of a
/// stable time step is far smaller.
template <typename T>
Frame<T> turned(const Frame<T>& frame, const Triple<T>& theta) {
  const Triple<T> half = T(0.5) * theta;
  const T y = dot(half, half);
  const T cosine = T(1.0) + y * (T(-1.0 / 2.0) + y * (T(1.0 / 24.0) + y * (T(-1.0 / 720.0) + y * T(1.0 / 40320.0))));
  const T sine_ratio =
      T(1.0) + y * (T(-1.0 / 6.0) + y * (T(1.0 / 120.0) + y * (T(-1.0 / 5040.0) + y * T(1.0 / 362880.0))));
  const Frame<T> q = frame * Frame<T>{cosine, sine_ratio * half};
  const T unit = T(1.5) - T(0.5) * (q.w * q.w + dot(q.v, q.v));  // one Newton step towards 1 / |q|
  return {unit * q.w, unit * q.v};
}

/// atan(sqrt(u)) / sqrt(u), interpolated at Chebyshev points: to 1e-15 for 0 <= u <= 0.44.
template <typename T>
T arctangentRatio(const T& u) {
  constexpr double kCoefficients[] = {-0.0036577736717552487, 0.014463833564925692,
                                      -0.02909907711172361,   0.04179211842474561,
                                      -0.05094397348372883,   0.05847686444184053,
                                      -0.06661693268157243,   0.07691823138191412,
                                      -0.09090878498865912,   0.11111109953399516,
                                      -0.14285714262818605,   0.1999999999982119,
                                      -0.333333333333331,     1.0};
  T sum(kCoefficients[0]);
  for (int i = 1; i < 14; ++i) sum = sum * u + T(kCoefficients[i]);
  return sum;
}

/// What a bend does to the elements at its ends [N m], each in the frame of its element: `upper` is J(theta) m and
/// `lower` its transpose J(-theta) m.
template <typename T>
struct BendCouples {
  Triple<T> lower, upper;
};

/// With q = (cos(phi/2), s), theta = 2 a s, a = (phi/2) / sin(phi/2) and J m = m - a s x m + b s x (s x m), where
/// b = (1 - a cos(phi/2)) / |s|^2. Losing the digits of b near zero does no harm, since b multiplies |s|^2. To 1e-15
/// for turns of less than 2.3 rad.
template <typename T>
BendCouples<T> bendCouples(const Frame<T>& turn, const T& inverse_voronoi, const Triple<T>& rest_curvature,
                           const Triple<T>& stiffness) {
  const T s2 = dot(turn.v, turn.v);
  const T quarter = T(1.0) / (T(1.0) + turn.w);
  const T a = T(2.0) * quarter * arctangentRatio(s2 * quarter * quarter);
  const T b = (T(1.0) - turn.w * a) / (s2 + T(1e-300));
  const Triple<T> curvature = (T(2.0) * a * inverse_voronoi) * turn.v;
  const Triple<T> m = componentwise(stiffness, curvature - rest_curvature);
  const Triple<T> across = cross(turn.v, m);
  const Triple<T> even = m + b * cross(turn.v, across);
  const Triple<T> odd = a * across;
  return {even + odd, even - odd};
}

/// Shear and stretch plus e3: the chord per rest length in the material frame.
template <typename T>
Triple<T> stretchVector(const Frame<T>& frame, const Triple<T>& chord, const T& inverse_length) {
  return inverse_length * toMaterial(frame, chord);
}

/// Force of an element in its own frame [N].
template <typename T>
Triple<T> materialForce(const Triple<T>& stretch_vector, const Triple<T>& rest_stretch_vector,
                        const Triple<T>& stiffness) {
  return componentwise(stiffness, stretch_vector - rest_stretch_vector);
}

/// Angular velocity of a free body with moments of inertia in the ratio 1:1:2 after the angle dt * w3: the first two
/// components turn about the third, by Cayley's map, which keeps their length.
template <typename T>
Triple<T> precessed(const Triple<T>& w, const T& dt) {
  const T t = T(0.5) * dt * w.z;
  const T scale = T(1.0) / (T(1.0) + t * t);
  const T cosine = (T(1.0) - t * t) * scale;
  const T sine = T(2.0) * t * scale;
  return {cosine * w.x - sine * w.y, sine * w.x + cosine * w.y, w.z};
}

}  // namespace sensory_growth::mechanics::formulas
