#pragma once

/// What sensory_growth_batch does. Each takes what the command line asks for and returns the exit code.

#include <functional>
#include <ostream>

#include "sensory_growth/batch/options.h"

namespace sensory_growth::batch {

enum ExitCode {
  kOk = 0,
  kFault = 1,          ///< a step failed, a replay differs, or the disk did not take what was written
  kBadInput = 2,       ///< nothing was begun
  kInterrupted = 130,  ///< by a signal; what was written is complete up to there
};

/// Where to say what, and when to stop.
struct Console {
  std::ostream& out;                  ///< summaries
  std::ostream& err;                  ///< progress and complaints
  std::function<bool()> interrupted;  ///< asked after every step
};

/// The growth time scale that sim.launch has, or as much more as a step needs to last no longer than a second.
double defaultScale(const std::string& scenario);

// They throw BadInput, and std::runtime_error if the disk does not take what is written.
ExitCode run(const RunOptions& options, const Console& console);
ExitCode replay(const ReplayOptions& options, const Console& console);
ExitCode exportFrames(const ExportOptions& options, const Console& console);

}  // namespace sensory_growth::batch
