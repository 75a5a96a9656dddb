#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace sensory_growth::node::testing {

/// A program started by the test, with what it prints in a file.
class ChildProcess {
 public:
  /// It cannot make files larger than `largest_file` [byte].
  ChildProcess(const std::vector<std::string>& command, std::string output, rlim_t largest_file = RLIM_INFINITY)
      : output_(std::move(output)) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    const int file = open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(file, STDOUT_FILENO);
      dup2(file, STDERR_FILENO);
      const rlimit limit{largest_file, largest_file};
      if (largest_file != RLIM_INFINITY) setrlimit(RLIMIT_FSIZE, &limit);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    close(file);
  }

  ~ChildProcess() {
    kill();
    unlink(output_.c_str());
  }

  pid_t pid() const { return pid_; }

  void signal(int number) const {
    if (pid_ > 0) ::kill(pid_, number);  // -1 is everybody
  }

  /// Ends it as the system does that runs out of memory, unless it has ended.
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

  /// Exit code; -1 and a failed test if it does not end in time, or by a signal.
  int waitForExit(std::chrono::milliseconds patience) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) {
        ADD_FAILURE() << "still running after " << patience.count() << " ms\n" << printed();
        return -1;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));  // between two looks; nothing notifies
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string printed() const {
    std::ifstream file(output_);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

 private:
  const std::string output_;
  pid_t pid_ = -1;
};

}  // namespace sensory_growth::node::testing
