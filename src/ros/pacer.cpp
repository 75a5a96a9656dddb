#include "sensory_growth/ros/pacer.h"

#include <sstream>

namespace sensory_growth::node {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kWindow{1.0};

std::optional<Pacer::Clock::duration> periodOf(double step, double real_time_factor) {
  if (real_time_factor == 0.0) return std::nullopt;
  return std::chrono::duration_cast<Pacer::Clock::duration>(Seconds(step / real_time_factor));
}

}  // namespace

std::optional<std::string> findFactorFault(double real_time_factor) {
  if (real_time_factor == 0.0) return std::nullopt;
  if (real_time_factor >= kLowestRealTimeFactor && real_time_factor <= kHighestRealTimeFactor) return std::nullopt;
  std::ostringstream fault;
  fault << "the real-time factor is " << real_time_factor << "; it must be 0, which is as fast as possible, or from "
        << kLowestRealTimeFactor << " to " << kHighestRealTimeFactor;
  return fault.str();
}

Pacer::Pacer(double step, double real_time_factor)
    : step_(step), factor_(real_time_factor), period_(periodOf(step, real_time_factor)) {}

void Pacer::start(Clock::time_point now) {
  if (period_) due_ = now + *period_;
  window_begin_ = now;
  window_steps_ = 0;
}

void Pacer::setFactor(double real_time_factor, Clock::time_point now) {
  factor_ = real_time_factor;
  period_ = periodOf(step_, factor_);
  achieved_factor_ = 0.0;
  start(now);
}

std::optional<Pacer::Clock::time_point> Pacer::due() const {
  if (!period_) return std::nullopt;
  return due_;
}

void Pacer::stepBegins(Clock::time_point now) {
  if (!period_) return;
  if (now > due_ + *period_) {
    ++overruns_;
    due_ = now;
  }
  due_ += *period_;
}

void Pacer::stepEnded(Clock::time_point now) {
  ++window_steps_;
  if (now - window_begin_ >= kWindow) measure(now);
}

void Pacer::stop(Clock::time_point now) {
  if (window_steps_ > 0) measure(now);
}

void Pacer::measure(Clock::time_point now) {
  achieved_factor_ = static_cast<double>(window_steps_) * step_ / Seconds(now - window_begin_).count();
  window_begin_ = now;
  window_steps_ = 0;
}

}  // namespace sensory_growth::node
