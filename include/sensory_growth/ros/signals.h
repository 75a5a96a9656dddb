#pragma once

#include <chrono>
#include <csignal>

namespace sensory_growth::node {

/// Turns SIGINT and SIGTERM into something the main thread can wait for, so that nothing runs in a signal handler.
/// Create it before the first thread: threads inherit what it blocks.
class Signals {
 public:
  Signals();

  /// True as soon as one of the signals came, false if none does within `patience`.
  bool wait(std::chrono::milliseconds patience) const;

 private:
  sigset_t set_;
};

}  // namespace sensory_growth::node
