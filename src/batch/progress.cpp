#include "sensory_growth/batch/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sensory_growth::batch {
namespace {

constexpr double kHour = 3600.0;  // [s]
constexpr std::size_t kBarLength = 20;
constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};

}  // namespace

ProgressStyle progressStyle(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string describeProgress(std::uint64_t step, std::uint64_t steps, double growth_time, double elapsed) {
  const double done = steps > 0 ? std::min(static_cast<double>(step) / static_cast<double>(steps), 1.0) : 1.0;
  const double speed = elapsed > 0.0 ? static_cast<double>(step) / elapsed : 0.0;
  const auto filled = static_cast<std::size_t>(done * kBarLength);
  std::ostringstream text;
  text << '[' << std::string(filled, '#') << std::string(kBarLength - filled, ' ') << "] ";
  text.width(3);
  text << std::floor(100.0 * done) << " %, step " << step << " of " << steps << ", ";
  text.precision(3);
  text << growth_time / kHour << " h of growth";
  if (speed > 0.0) {
    text << ", " << speed << " steps/s, " << std::ceil(static_cast<double>(steps - std::min(step, steps)) / speed)
         << " s left";
  }
  return text.str();
}

Progress::Progress(std::ostream& out, ProgressStyle style, std::uint64_t steps)
    : out_(out), style_(style), steps_(steps), begin_(Clock::now()), shown_(begin_) {}

Progress::~Progress() {
  if (has_bar_) out_ << '\n' << std::flush;
}

void Progress::show(std::uint64_t step, double growth_time) {
  if (style_ == ProgressStyle::none) return;
  const bool is_bar = style_ == ProgressStyle::bar;
  const bool is_last = is_bar && step == steps_;
  const Clock::time_point now = Clock::now();
  if (!is_last && now - shown_ < (is_bar ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval))) return;
  shown_ = now;
  has_bar_ = is_bar;
  const std::string text = describeProgress(step, steps_, growth_time, elapsed());
  if (is_bar) {
    out_ << '\r' << text << "\x1b[K" << std::flush;  // clears what a longer line has left
  } else {
    out_ << text << std::endl;
  }
}

double Progress::elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

}  // namespace sensory_growth::batch
