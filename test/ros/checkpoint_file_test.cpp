#include "sensory_growth/ros/checkpoint_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sensory_growth/ros/confined_file.h"
#include "sensory_growth/simulation/scenario_yaml.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class CheckpointFile : public ::testing::Test {
 protected:
  CheckpointFile()
      : directory_(std::filesystem::temp_directory_path() / ("checkpoint_file_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(directory_);
  }
  ~CheckpointFile() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& file) const { return directory_ / file; }

  static std::string refusalToRead(const std::string& path) {
    try {
      readCheckpoint(path);
    } catch (const std::runtime_error& refusal) {
      return refusal.what();
    }
    return "none";
  }

  std::string refusalToWrite(const std::string& path) const {
    try {
      writeCheckpoint(path, checkpoint_);
    } catch (const std::runtime_error& refusal) {
      return refusal.what();
    }
    return "none";
  }

  const std::filesystem::path directory_;
  const simulation::Checkpoint checkpoint_{
      "0.1.0", "a scenario", "a protocol",
      simulation::Simulation(simulation::loadScenario("data/ros/shoot.yaml")).state()};
};

TEST_F(CheckpointFile, HoldsWhatWasWrittenAndNothingIsLeftBeside) {
  writeCheckpoint(path("a.checkpoint"), checkpoint_);
  EXPECT_EQ(simulation::encode(readCheckpoint(path("a.checkpoint"))), simulation::encode(checkpoint_));
  const std::filesystem::directory_iterator files(directory_);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST_F(CheckpointFile, ReplacesNone) {
  std::ofstream(path("a.checkpoint")) << "precious";
  EXPECT_EQ(refusalToWrite(path("a.checkpoint")), path("a.checkpoint") + " exists already");
  std::filesystem::create_symlink(path("nowhere"), path("b.checkpoint"));
  EXPECT_EQ(refusalToWrite(path("b.checkpoint")), path("b.checkpoint") + " exists already");
  EXPECT_THAT(refusalToWrite(path("absent/a.checkpoint")), HasSubstr("cannot be written: No such file or directory"));
}

TEST_F(CheckpointFile, TakesThePlaceOfOneThatWasNotFinished) {
  std::ofstream(path("a.checkpoint.active")) << std::string(1000000, 'x');
  writeCheckpoint(path("a.checkpoint"), checkpoint_);
  EXPECT_EQ(simulation::encode(readCheckpoint(path("a.checkpoint"))), simulation::encode(checkpoint_));
  EXPECT_FALSE(std::filesystem::exists(path("a.checkpoint.active")));
}

TEST_F(CheckpointFile, IsReadFromRegularFilesOnly) {
  EXPECT_EQ(refusalToRead(path("a.checkpoint")), path("a.checkpoint") + " does not exist");
  writeCheckpoint(path("a.checkpoint"), checkpoint_);
  std::filesystem::create_symlink(path("a.checkpoint"), path("link.checkpoint"));
  ASSERT_EQ(mkfifo(path("pipe.checkpoint").c_str(), 0600), 0);
  for (const std::string file : {"link.checkpoint", "pipe.checkpoint", ""}) {
    EXPECT_THAT(refusalToRead(path(file)), HasSubstr("is no regular file")) << file;
  }
  std::ofstream(path("text.checkpoint")) << "text";
  EXPECT_EQ(refusalToRead(path("text.checkpoint")), path("text.checkpoint") + " is no checkpoint");
  std::ofstream(path("empty.checkpoint"));
  EXPECT_THAT(refusalToRead(path("empty.checkpoint")), HasSubstr("is no checkpoint"));
}

TEST_F(CheckpointFile, OfManyGigabytesIsNotEvenOpened) {
  std::ofstream(path("huge.checkpoint")).put('x');
  std::filesystem::resize_file(path("huge.checkpoint"), std::uintmax_t{1} << 40);  // with a hole
  EXPECT_THAT(refusalToRead(path("huge.checkpoint")), HasSubstr("a checkpoint has at most"));
}

TEST(ConfinedPath, StaysInItsDirectory) {
  const auto refusal = [](const std::string& directory, const std::string& file) -> std::string {
    try {
      return confinedPath({"checkpoint_directory", directory, ".checkpoint"}, file);
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
  };
  EXPECT_EQ(refusal("/somewhere", "a.checkpoint"), "/somewhere/a.checkpoint");
  EXPECT_THAT(refusal("", "a.checkpoint"), StartsWith("~checkpoint_directory is not set"));
  for (const char* file : {"../a.checkpoint", "/tmp/a.checkpoint", "a/b.checkpoint", ".a.checkpoint", "",
                           "-a.checkpoint", "sp ace.checkpoint"}) {
    EXPECT_THAT(refusal("/somewhere", file), HasSubstr("without a directory")) << file;
  }
  EXPECT_EQ(refusal("/somewhere", "a.bag"), "file is 'a.bag'; it must end in .checkpoint");
}

}  // namespace
}  // namespace sensory_growth::node
