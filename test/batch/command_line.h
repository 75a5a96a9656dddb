#pragma once

/// sensory_growth_batch as a test calls it, in a folder of its own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "sensory_growth/batch/command_line.h"

namespace sensory_growth::batch::testing {

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// `stop_after` is how often it may be asked whether to stop; below zero: for ever.
inline Outcome call(std::vector<std::string> arguments, int stop_after = -1) {
  arguments.insert(arguments.begin(), "sensory_growth_batch");
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out, err;
  const auto interrupted = [&stop_after] { return stop_after >= 0 && stop_after-- == 0; };
  Outcome outcome;
  outcome.code = runCommandLine(static_cast<int>(argv.size()), argv.data(), {out, err, interrupted});
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

inline std::string textOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A folder that goes with the test.
class InFolder : public ::testing::Test {
 protected:
  InFolder() : folder_(std::filesystem::temp_directory_path() / ("batch_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(folder_);
  }
  ~InFolder() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& file) const { return folder_ / file; }

  std::string write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
    return path(file);
  }

  const std::filesystem::path folder_;
};

constexpr char kShoot[] = "data/ros/shoot.yaml";  // steps of 1 min, 4 h

}  // namespace sensory_growth::batch::testing
