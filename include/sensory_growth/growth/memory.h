#pragma once

/// What an organ remembers of a signal, against physical time and material labels (model.md 7).
///
/// Labels never change, so tissue that was born later finds its past between the labels of a sample; and samples have
/// their times, so nothing depends on how time was cut into steps.

#include <cstddef>
#include <vector>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/memory_kernel.h"

namespace sensory_growth::growth {

/// What an organ is taken to have sensed before the first sample.
enum class BeforeStart {
  constant,  ///< always the same as then
  zero,
};

/// A signal at one time, and what a kernel makes of it and its past. Sizes as `labels`.
struct MemorySample {
  double time = 0.0;           ///< of growth [s]
  std::vector<double> labels;  ///< rising; one for a single sensor
  SectionField sensed;
  std::vector<SectionField> states;  ///< of the kernel; the first is what is perceived
};

/// Samples in order of time; two of the same time are a jump.
using History = std::vector<MemorySample>;

/// The history of one signal, given at some labels of the organ or by a single sensor.
class Memory {
 public:
  /// Throws std::invalid_argument if the kernel has a fault.
  Memory(MemoryKernel kernel, BeforeStart before_start);

  /// What is perceived at `time` [s] if `sensed` is sensed then, but not kept. `labels` rise and include all those of
  /// earlier samples with the same ends. Between samples the signal is linear; times before the latest sample count as
  /// its time. What jumps just then has not yet done so. Size as `labels`, valid until the next call.
  const SectionField& expect(double time, const std::vector<double>& labels, const SectionField& sensed);

  /// The same with the sample kept, unless it repeats the latest one. What jumps just then has done so; a second sample
  /// at the same time is a jump.
  const SectionField& remember(double time, const std::vector<double>& labels, const SectionField& sensed);

  /// When what is perceived next jumps after `time` [s], as far as is known by now; infinity if it does not. Only a
  /// pure delay passes jumps on as they are.
  double nextJump(double time) const;

  /// Samples that are kept.
  std::size_t size() const { return size_; }

  /// Forgets the samples after the first `size`.
  void takeBack(std::size_t size) { size_ = size; }

  /// What is kept.
  History history() const;

  /// Keeps this and nothing else. Throws std::invalid_argument if it is none of this kernel: sizes, order of times and
  /// labels, numbers beyond all that is sensed.
  void restore(History history);

  /// Forgets what is not needed from now on, if takeBack() is only used for samples kept from now on.
  void forgetTheOld();

 private:
  const MemorySample& sense(double time, const std::vector<double>& labels, const SectionField& sensed, Side side);
  void add(const MemorySample& from, const SectionField& values, const StateVector& weight, MemorySample& to);

  MemoryKernel kernel_;
  BeforeStart before_start_;
  History samples_;  ///< the first size_ are kept; the others lend their heap memory to new ones
  std::size_t size_ = 0;
  std::vector<double> times_;
  MemoryWeights weights_;
  SectionField resampled_;
};

}  // namespace sensory_growth::growth
