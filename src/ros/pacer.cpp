#include "sensory_growth/ros/pacer.h"

namespace sensory_growth::node {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kWindow{1.0};

std::optional<Pacer::Clock::duration> periodOf(double step, double real_time_factor) {
  if (real_time_factor == 0.0) return std::nullopt;
  return std::chrono::duration_cast<Pacer::Clock::duration>(Seconds(step / real_time_factor));
}

}  // namespace

Pacer::Pacer(double step, double real_time_factor) : step_(step), period_(periodOf(step, real_time_factor)) {}

void Pacer::start(Clock::time_point now) {
  if (period_) due_ = now + *period_;
  window_begin_ = now;
  window_steps_ = 0;
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
