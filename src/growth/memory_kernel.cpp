#include "sensory_growth/growth/memory_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/MatrixFunctions>

namespace sensory_growth::growth {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int order(const LinearOde& ode) { return static_cast<int>(ode.coefficients.size()); }

/// d/d(t/T) of the states is this matrix times them, plus the signal over cn in the last row.
StateMatrix companion(const LinearOde& ode) {
  const int n = order(ode);
  const double highest = ode.coefficients.back();
  StateMatrix matrix = StateMatrix::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    matrix(i, i + 1) = 1.0;
    matrix(n - 1, i + 1) = -ode.coefficients[i] / highest;
  }
  matrix(n - 1, 0) = -1.0 / highest;
  return matrix;
}

/// What a while makes of the states, exactly, if the signal is linear from its start to its end.
struct Propagator {
  StateMatrix states;
  StateVector start, end;  ///< of the signal then
};

/// The exponential of the system together with its signal u and the rise of u: (z, u, r)' = (A z + b u, r, 0).
Propagator propagator(const LinearOde& ode, double duration) {
  using Augmented = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kHighestOrder + 2, kHighestOrder + 2>;
  const int n = order(ode);
  const double x = duration / ode.time_constant;
  Augmented system = Augmented::Zero(n + 2, n + 2);
  system.topLeftCorner(n, n) = x * companion(ode);
  system(n - 1, n) = x / ode.coefficients.back();
  system(n, n + 1) = 1.0;
  const Augmented exponential = system.exp();
  const StateVector end = exponential.col(n + 1).head(n);
  return {exponential.topLeftCorner(n, n), exponential.col(n).head(n) - end, end};
}

/// A signal known at some times.
struct Timeline {
  const std::vector<double>& times;
  double before_start;

  /// The sample at or before a time; -1 before the first.
  std::ptrdiff_t sampleBefore(double time) const {
    return std::upper_bound(times.begin(), times.end(), time) - times.begin() - 1;
  }

  /// Adds `weight` times the signal at `time`, which lies between the sample `older` and the next.
  void addReading(std::ptrdiff_t older, double time, const StateVector& weight,
                  std::vector<StateVector>& samples) const {
    if (older < 0) {
      samples.front() += before_start * weight;
    } else if (older + 1 == static_cast<std::ptrdiff_t>(times.size())) {
      samples.back() += weight;
    } else {
      const double x = (time - times[older]) / (times[older + 1] - times[older]);
      samples[older] += (1.0 - x) * weight;
      samples[older + 1] += x * weight;
    }
  }

  /// Calls piece(begin, end, older) for what lies between `from` and `to`, in order of time. On a piece the signal is
  /// linear, from the sample `older` to the next.
  template <typename Piece>
  void forEachPiece(double from, double to, const Piece& piece) const {
    const auto last = static_cast<std::ptrdiff_t>(times.size()) - 1;
    for (std::ptrdiff_t older = sampleBefore(from); older < last && from < to; ++older) {
      const double end = std::min(to, times[older + 1]);
      if (from < end) piece(from, end, older);
      from = std::max(from, end);
    }
  }
};

StateVector scalar(double value) { return StateVector::Constant(1, value); }

struct Weigh {
  const Timeline& line;
  Side side;
  MemoryWeights& weights;

  void operator()(const Delay& kernel) const {
    const double now = line.times.back();
    const double nudge = (side == Side::after ? kSameTime : -kSameTime) * std::abs(now);
    const double then = kernel.time > 0.0 ? now - kernel.time + nudge : now;
    line.addReading(line.sampleBefore(then), then, scalar(1.0), weights.samples);
  }

  void operator()(const LinearOde& ode) const {
    const std::size_t count = line.times.size();
    if (count == 1) {  // at rest under what was sensed before the start
      weights.samples.front()[0] = line.before_start;
      return;
    }
    weights.states.setIdentity();
    line.forEachPiece(line.times[count - 2] - ode.delay, line.times[count - 1] - ode.delay,
                      [&](double begin, double end, std::ptrdiff_t older) {
                        const Propagator step = propagator(ode, end - begin);
                        for (StateVector& sample : weights.samples) sample = step.states * sample;
                        weights.states = step.states * weights.states;
                        line.addReading(older, begin, step.start, weights.samples);
                        line.addReading(older, end, step.end, weights.samples);
                      });
  }

  /// Kernel and signal are linear on a piece; Gauss with two points integrates their product exactly.
  void operator()(const SampledKernel& kernel) const {
    const double now = line.times.back();
    for (std::size_t i = kernel.times.size() - 1; i-- > 0;) {
      const double late = now - kernel.times[i];
      const double early = now - kernel.times[i + 1];
      line.forEachPiece(early, late, [&](double begin, double end, std::ptrdiff_t older) {
        for (const double node : {-1.0, 1.0}) {
          const double time = 0.5 * (begin + end + node * (end - begin) / std::sqrt(3.0));
          const double x = (late - time) / (late - early);
          const double density = (1.0 - x) * kernel.densities[i] + x * kernel.densities[i + 1];
          line.addReading(older, time, scalar(0.5 * (end - begin) * density), weights.samples);
        }
      });
    }
  }
};

struct FindKernelFault {
  using MaybeFault = std::optional<Fault>;

  MaybeFault operator()(const Delay& kernel) const { return badDelay(kernel.time); }

  MaybeFault operator()(const LinearOde& ode) const {
    if (const MaybeFault fault = badDelay(ode.delay)) return fault;
    if (!(ode.time_constant >= kShortestTimeConstant) || !std::isfinite(ode.time_constant)) {
      return Fault{"time_constant", "must be >= 1 ms"};
    }
    if (ode.coefficients.empty() || ode.coefficients.size() > kHighestOrder) {
      return Fault{"coefficients", "must be 1 to " + std::to_string(kHighestOrder)};
    }
    const auto is_positive = [](double c) { return c > 0.0 && std::isfinite(c); };
    const bool rests = std::all_of(ode.coefficients.begin(), ode.coefficients.end(), is_positive) &&
                       Eigen::MatrixXd(companion(ode)).eigenvalues().real().maxCoeff() < 0.0;
    if (!rests) return Fault{"coefficients", "describe a system that does not come to rest"};
    return std::nullopt;
  }

  MaybeFault operator()(const SampledKernel& kernel) const {
    if (kernel.times.size() < 2) return Fault{"times", "must be two at least"};
    if (kernel.densities.size() != kernel.times.size()) return Fault{"densities", "must be as many as times"};
    if (!(kernel.times.front() >= 0.0)) return Fault{"times", "must be >= 0 s"};
    if (!rises(kernel.times)) return Fault{"times", "must rise"};
    const auto is_finite = [](double k) { return std::isfinite(k); };
    if (!std::all_of(kernel.densities.begin(), kernel.densities.end(), is_finite)) {
      return Fault{"densities", "must be finite"};
    }
    return std::nullopt;
  }

  static MaybeFault badDelay(double time) {
    if (time >= 0.0 && std::isfinite(time)) return std::nullopt;
    return Fault{"delay", "must be >= 0 s"};
  }

  static bool rises(const std::vector<double>& times) {
    const auto does_not = [](double a, double b) { return !(b > a) || !std::isfinite(b); };
    return std::adjacent_find(times.begin(), times.end(), does_not) == times.end();
  }
};

}  // namespace

LinearOde exponentialKernel(double time_constant) { return {0.0, time_constant, {1.0}}; }

std::optional<Fault> findFault(const MemoryKernel& kernel) { return std::visit(FindKernelFault{}, kernel); }

double lookBack(const MemoryKernel& kernel) {
  if (const auto* sampled = std::get_if<SampledKernel>(&kernel)) return sampled->times.back();
  const double time = delay(kernel);
  return std::isfinite(time) ? time : 0.0;
}

double delay(const MemoryKernel& kernel) {
  double time = 0.0;
  if (const auto* pure = std::get_if<Delay>(&kernel)) time = pure->time;
  if (const auto* ode = std::get_if<LinearOde>(&kernel)) time = ode->delay;
  return time > 0.0 ? time : kInfinity;
}

int stateCount(const MemoryKernel& kernel) {
  const auto* ode = std::get_if<LinearOde>(&kernel);
  return ode ? order(*ode) : 1;
}

void weigh(const MemoryKernel& kernel, const std::vector<double>& times, double before_start, Side side,
           MemoryWeights& weights) {
  const int states = stateCount(kernel);
  weights.samples.assign(times.size(), StateVector::Zero(states));
  weights.states = StateMatrix::Zero(states, states);
  const Timeline line{times, before_start};
  std::visit(Weigh{line, side, weights}, kernel);
}

}  // namespace sensory_growth::growth
