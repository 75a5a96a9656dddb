#include "sensory_growth/batch/summary.h"

#include <iomanip>
#include <ostream>
#include <sstream>

namespace sensory_growth::batch {

std::string describe(const Summary& summary) {
  constexpr double kHour = 3600.0;
  std::ostringstream text;
  text << std::setprecision(3) << (summary.interrupted ? "interrupted after " : "") << summary.steps << " steps, "
       << summary.snapshot->growth_time / kHour << " h of growth in " << summary.wall_time << " s";
  if (summary.wall_time > 0.0) text << " (" << static_cast<double>(summary.steps) / summary.wall_time << " steps/s)";
  text << ", checksum " << std::hex << std::setw(16) << std::setfill('0') << summary.snapshot->checksum << std::dec;
  if (summary.recording) text << ", " << summary.recording->path << ": " << summary.recording->messages << " messages";
  return text.str();
}

ExitCode conclude(const Summary& summary, bool has_failed, const Console& console) {
  const bool has_lost_bag = summary.recording && !summary.recording->error.empty();
  if (has_lost_bag) {
    console.err << "recording of " << summary.recording->path << " stopped after " << summary.recording->messages
                << " messages: " << summary.recording->error << '\n';
  }
  if (has_failed || has_lost_bag) return kFault;
  return summary.interrupted ? kInterrupted : kOk;
}

}  // namespace sensory_growth::batch
