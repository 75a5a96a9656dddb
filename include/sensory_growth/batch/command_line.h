#pragma once

#include "sensory_growth/batch/commands.h"

namespace sensory_growth::batch {

/// Everything from the arguments to the exit code.
int runCommandLine(int argc, const char* const* argv, const Console& console);

}  // namespace sensory_growth::batch
