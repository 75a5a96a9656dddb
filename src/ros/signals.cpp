#include "sensory_growth/ros/signals.h"

#include <ctime>

namespace sensory_growth::node {

Signals::Signals() {
  sigemptyset(&set_);
  sigaddset(&set_, SIGINT);
  sigaddset(&set_, SIGTERM);
  sigaddset(&set_, SIGHUP);       // the terminal is gone
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is like a full disk
  pthread_sigmask(SIG_BLOCK, &set_, nullptr);
}

bool Signals::wait(std::chrono::milliseconds patience) const {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(patience);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(patience - seconds);
  const timespec timeout{static_cast<std::time_t>(seconds.count()), static_cast<long>(rest.count())};
  return sigtimedwait(&set_, nullptr, &timeout) > 0;
}

}  // namespace sensory_growth::node
