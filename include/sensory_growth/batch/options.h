#pragma once

/// What the command line asks for.

#include <cstdint>
#include <optional>
#include <string>

namespace sensory_growth::batch {

/// Files that hold centrelines; an empty folder name means none.
struct FrameOptions {
  std::string csv;          ///< folder
  std::string vtk;          ///< folder
  std::uint64_t every = 1;  ///< steps between two frames; >= 1
};

struct RunOptions {
  std::string scenario;                     ///< path; empty: that of the checkpoint
  std::string from;                         ///< path of the checkpoint to go on from; empty: from step 0
  std::string protocol;                     ///< path; empty: none
  std::optional<double> duration;           ///< growth time [s]; nothing: that of the scenario
  std::optional<double> growth_time_scale;  ///< growth seconds per second of stamps [-]; nothing: defaultScale()
  std::string bag;                          ///< path; empty: none
  std::string checkpoint;                   ///< path for the last state; empty: none
  int marker_every = 1;                     ///< steps between markers in the bag; 0: none
  FrameOptions frames;
  int threads = 0;  ///< 0: one per processor
  bool quiet = false;
};

struct ReplayOptions {
  std::string recorded;  ///< path of the bag
  std::string node;      ///< name of the one that recorded; empty: the only one
  std::string bag;       ///< path; empty: none
  FrameOptions frames;
  int threads = 0;
  bool quiet = false;
};

struct ExportOptions {
  std::string recorded;
  std::string node;
  FrameOptions frames;
  bool quiet = false;
};

}  // namespace sensory_growth::batch
