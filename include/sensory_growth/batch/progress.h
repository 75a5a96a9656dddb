#pragma once

/// How far a run is, for people who wait for it.

#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>

namespace sensory_growth::batch {

enum class ProgressStyle {
  none,
  lines,  ///< a line now and then, for logs
  bar,    ///< one line that is written over, for terminals
};

/// The style that suits the standard error of this process.
ProgressStyle progressStyle(bool quiet);

/// "[#####               ]  25 %, step 120 of 480, 2 h of growth, 960 steps/s, 1 s left"
std::string describeProgress(std::uint64_t step, std::uint64_t steps, double growth_time, double elapsed);

class Progress {
 public:
  /// `out` must outlive it; `steps` is how many there will be.
  Progress(std::ostream& out, ProgressStyle style, std::uint64_t steps);

  /// Ends the line of the bar.
  ~Progress();

  /// Shows it if it is long enough since it was shown; `growth_time` in seconds.
  void show(std::uint64_t step, double growth_time);

  /// Wall time since the beginning [s].
  double elapsed() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  const ProgressStyle style_;
  const std::uint64_t steps_;
  const Clock::time_point begin_;
  Clock::time_point shown_;
  bool has_bar_ = false;
};

}  // namespace sensory_growth::batch
