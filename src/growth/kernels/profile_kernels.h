#pragma once

/// The innermost loops of elongation, one set per instruction set.

#include <cstddef>

namespace sensory_growth::growth::kernels {

/// log(1 + exp(offset + slope * s)), scaled.
struct Softplus {
  double offset = 0.0;
  double slope = 0.0;
  double scale = 1.0;
};

/// All work on arrays of n numbers.
struct ProfileKernels {
  /// Replaces each s by f(s).
  void (*softplus)(const Softplus& f, double* s, std::size_t n);

  /// grown = initial * exp(time * rate).
  void (*grow)(const double* initial, const double* rate, double time, double* grown, std::size_t n);

  /// Replaces each x by log(x).
  void (*logarithm)(double* x, std::size_t n);
};

/// Those of the instruction set in use.
const ProfileKernels& profileKernels();

const ProfileKernels& profileKernelsBaseline();
const ProfileKernels& profileKernelsAvx2();
const ProfileKernels& profileKernelsAvx512();

}  // namespace sensory_growth::growth::kernels
