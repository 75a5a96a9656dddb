#pragma once

/// Arithmetic on several neighbouring elements at once. `Lanes` is a batch as wide as the instructions this file is
/// compiled for; formulas read as they would for one element. Files that include it are compiled once per instruction
/// set, so all that they define has internal linkage or depends on the type of the batch.

#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <xsimd/xsimd.hpp>

#include "kernels/packets.h"

namespace Eigen {

template <class Arch>
struct NumTraits<xsimd::batch<double, Arch>> : GenericNumTraits<double> {
  using Real = xsimd::batch<double, Arch>;
  using NonInteger = Real;
  using Nested = Real;
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};

}  // namespace Eigen

namespace sensory_growth::mechanics::kernels {
namespace {

using Lanes = xsimd::batch<double>;

static_assert(kPacket % Lanes::size == 0);

using Vector = Eigen::Matrix<Lanes, 3, 1>;
using Matrix = Eigen::Matrix<Lanes, 3, 3>;

inline Lanes load(const double* from) { return Lanes::load_unaligned(from); }

inline Vector load(const Packet (&packets)[3], std::size_t lane) {
  return {load(packets[0].lane + lane), load(packets[1].lane + lane), load(packets[2].lane + lane)};
}

inline void store(const Lanes& value, double* to) { value.store_unaligned(to); }

inline double largest(const Lanes& values) {
  alignas(64) double lane[Lanes::size];
  store(values, lane);
  double most = lane[0];
  for (const double value : lane) most = value > most ? value : most;
  return most;
}

}  // namespace
}  // namespace sensory_growth::mechanics::kernels
