#pragma once

/// Stands in for the lanes of the library's kernels: one element at a time, and every operation and every number that
/// is fetched or put back is counted.

#include <cmath>
#include <cstddef>
#include <set>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "kernels/packets.h"

namespace sensory_growth::mechanics::kernels {
namespace {

struct Tally {
  std::size_t flops = 0;  ///< additions, multiplications, divisions, roots, comparisons of two numbers
  std::set<const double*> fetched, put;
};

Tally tally;

struct Lanes {
  static constexpr std::size_t size = 1;

  double value = 0.0;

  Lanes() = default;
  explicit Lanes(double x) : value(x) {}

  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return counted(a.value + b.value); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return counted(a.value - b.value); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return counted(a.value * b.value); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return counted(a.value / b.value); }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.value); }
  friend bool operator<(const Lanes& a, const Lanes& b) { return counted(a.value - b.value).value < 0.0; }
  friend bool operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend Lanes sqrt(const Lanes& a) { return counted(std::sqrt(a.value)); }
  friend Lanes atan2(const Lanes& y, const Lanes& x) { return counted(std::atan2(y.value, x.value)); }
  friend Lanes select(bool condition, const Lanes& yes, const Lanes& no) { return condition ? yes : no; }

 private:
  static Lanes counted(double x) {
    ++tally.flops;
    return Lanes(x);
  }
};

}  // namespace
}  // namespace sensory_growth::mechanics::kernels

namespace Eigen {

template <>
struct NumTraits<sensory_growth::mechanics::kernels::Lanes> : GenericNumTraits<double> {
  using Real = sensory_growth::mechanics::kernels::Lanes;
  using NonInteger = Real;
  using Nested = Real;
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};

}  // namespace Eigen

namespace sensory_growth::mechanics::kernels {
namespace {

using Vector = Eigen::Matrix<Lanes, 3, 1>;
using Matrix = Eigen::Matrix<Lanes, 3, 3>;

inline Lanes load(const double* from) {
  tally.fetched.insert(from);
  return Lanes(*from);
}

inline void store(const Lanes& value, double* to) {
  tally.put.insert(to);
  *to = value.value;
}

}  // namespace
}  // namespace sensory_growth::mechanics::kernels
