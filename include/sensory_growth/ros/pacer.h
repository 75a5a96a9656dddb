#pragma once

/// When the next step is due, and how well that was kept. Counts the steady clock; knows neither ROS nor threads.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace sensory_growth::node {

/// Limits of a real-time factor other than 0.
inline constexpr double kLowestRealTimeFactor = 1e-6;
inline constexpr double kHighestRealTimeFactor = 1e12;

/// Why no pacer takes this factor, or nothing.
std::optional<std::string> findFactorFault(double real_time_factor);

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `step` is the ROS time of a step [s]; `real_time_factor` is ROS seconds per wall second, 0: as fast as possible.
  Pacer(double step, double real_time_factor);

  /// Running begins: the first step is due one period from `now`.
  void start(Clock::time_point now);

  /// From `now` on steps follow each other at this factor, the first one period from `now`. What was achieved so far
  /// says nothing about it and is forgotten.
  void setFactor(double real_time_factor, Clock::time_point now);

  double factor() const { return factor_; }

  /// When the next step is due; nothing means at once.
  std::optional<Clock::time_point> due() const;

  /// A step begins. One that begins more than a period late counts as an overrun, and the lost time is not made up.
  void stepBegins(Clock::time_point now);

  /// A step has ended.
  void stepEnded(Clock::time_point now);

  /// Running ends; a run of less than a second is measured as far as it went.
  void stop(Clock::time_point now);

  std::uint64_t overruns() const { return overruns_; }

  /// ROS seconds per wall second over the last second of running; 0 until it is known.
  double achievedFactor() const { return achieved_factor_; }

 private:
  void measure(Clock::time_point now);

  const double step_;
  double factor_;
  std::optional<Clock::duration> period_;
  Clock::time_point due_{};
  Clock::time_point window_begin_{};
  std::uint64_t window_steps_ = 0;
  std::uint64_t overruns_ = 0;
  double achieved_factor_ = 0.0;
};

}  // namespace sensory_growth::node
