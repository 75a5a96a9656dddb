#pragma once

/// sensory_growth_batch as a process of its own.

#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

#include "ros/child_process.h"

namespace sensory_growth::node::testing {

constexpr std::chrono::seconds kBatchPatience{60};

struct BatchOutcome {
  int code = -1;
  std::string printed;
};

inline BatchOutcome batch(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BATCH_EXECUTABLE);
  ChildProcess child(arguments, "batch_" + std::to_string(getpid()) + ".txt");
  BatchOutcome outcome;
  outcome.code = child.waitForExit(kBatchPatience);
  outcome.printed = child.printed();
  return outcome;
}

}  // namespace sensory_growth::node::testing
