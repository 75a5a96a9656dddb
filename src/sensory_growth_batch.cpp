#include <iostream>

#include "sensory_growth/batch/command_line.h"
#include "sensory_growth/ros/signals.h"

int main(int argc, char** argv) {
  const sensory_growth::node::Signals signals;  // before the first thread
  const auto interrupted = [&signals] { return signals.wait(std::chrono::milliseconds(0)); };
  return sensory_growth::batch::runCommandLine(argc, argv, {std::cout, std::cerr, interrupted});
}
