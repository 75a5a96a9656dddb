#pragma once

/// How what is perceived depends on what was sensed before: perceived(t) = integral of K(tau) sensed(t - tau) over
/// tau >= 0 in physical time (model.md 7).

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "sensory_growth/growth/fault.h"

namespace sensory_growth::growth {

/// What was sensed a while ago; at once if the time is zero.
struct Delay {
  double time = 0.0;  ///< [s], >= 0
};

/// What was sensed a while ago drives a linear system of order n, with T the time constant,
///   y + c1 T y' + c2 T^2 y'' + ... + cn T^n y(n) = sensed(t - delay),
/// and y is perceived; what stays the same for long is perceived as it is. Order 1 forgets exponentially; order 2 with
/// c = {2, 1} is critically damped.
struct LinearOde {
  double delay = 0.0;                ///< [s], >= 0
  double time_constant = 0.0;        ///< T [s], >= kShortestTimeConstant
  std::vector<double> coefficients;  ///< c1 to cn [-], of a system that comes to rest
};

/// K by samples, linear between them and zero outside.
struct SampledKernel {
  std::vector<double> times;      ///< tau [s], >= 0, rising
  std::vector<double> densities;  ///< K [1/s], as many
};

using MemoryKernel = std::variant<Delay, LinearOde, SampledKernel>;

/// K = exp(-tau / T) / T.
LinearOde exponentialKernel(double time_constant);

/// Growth times are sums of many parts of steps: what lies closer than this, relative to them, is one time.
constexpr double kSameTime = 1e-12;

/// Highest order of a LinearOde, and its shortest time constant [s]: over x time constants at once, round-off grows
/// x-fold.
constexpr int kHighestOrder = 8;
constexpr double kShortestTimeConstant = 1e-3;

std::optional<Fault> findFault(const MemoryKernel& kernel);

/// How far back the kernel needs samples [s].
double lookBack(const MemoryKernel& kernel);

/// The delay of the kernel [s]; infinity if it has none. Steps must resolve it (model.md 11.2).
double delay(const MemoryKernel& kernel);

/// One value for each state of a kernel: y, T y', ... of a LinearOde; of other kernels just what is perceived.
using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kHighestOrder, 1>;
using StateMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kHighestOrder, kHighestOrder>;

int stateCount(const MemoryKernel& kernel);

/// The states of a kernel at the latest of some times, for a signal that is linear between its samples at them:
/// sum of samples[k] * sample k + states * states at the latest but one.
struct MemoryWeights {
  std::vector<StateVector> samples;
  StateMatrix states;
};

/// From which side what jumps just now is perceived.
enum class Side { before, after };

/// Weights for samples at `times` [s] in order, at least one; at equal times the signal jumps. `before_start` is the
/// factor on the first sample that makes the signal before it: 1 or 0. Work space is reused.
void weigh(const MemoryKernel& kernel, const std::vector<double>& times, double before_start, Side side,
           MemoryWeights& weights);

}  // namespace sensory_growth::growth
