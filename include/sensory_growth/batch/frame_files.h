#pragma once

/// Centrelines in files that other programs read. A frame is one state; its number is its step index.

#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sensory_growth/OrganState.h"
#include "sensory_growth/batch/options.h"
#include "sensory_growth/ros/reporter.h"

namespace sensory_growth::batch {

/// What is known at the n + 1 vertices of an organ. The value of an element counts for both its vertices.
struct VertexFields {
  std::vector<double> curvature;    ///< size of the bending part [1/m]; the apex has that of the last bend
  std::vector<double> growth_rate;  ///< [1/s]
  std::vector<double> radius;       ///< [m]
  std::vector<double> age;          ///< [s]
};

VertexFields vertexFields(const OrganState& state);

/// A legacy VTK file with one polyline and the fields of its vertices.
std::string toVtk(const OrganState& state);

/// Tables "frame,x,y,z" ([m], a line per vertex, a file per organ), and VTK files (one per organ and frame) with a
/// series file that gives ParaView their growth times. Numbers are as short as lets them be read back exactly.
class FrameFiles {
 public:
  /// Creates the folders, and no file before the first frame. Throws BadInput if that fails or an organ has files
  /// there already. Other organs may come later.
  /// States of other epochs than `epoch` are left out.
  FrameFiles(const FrameOptions& options, const std::vector<std::string>& organs, std::uint32_t epoch = 0);

  /// Writes the state if its step is one of those wanted. Throws std::runtime_error if the disk does not take it or if
  /// an organ that came later has files there already.
  void write(const OrganState& state);

  /// The same if the message is a state.
  void take(const node::Message& message);

  /// Completes the files. Throws std::runtime_error if the disk does not take it.
  void close();

 private:
  struct Frame {
    std::string file;
    double growth_time = 0.0;
  };

  void refuseFilesOf(const std::string& organ) const;
  void writeTable(const OrganState& state);
  void writeVtk(const OrganState& state);
  std::string tablePath(const std::string& organ) const;
  std::string seriesPath(const std::string& organ) const;

  const FrameOptions options_;
  const std::uint32_t epoch_;
  std::set<std::string> organs_;                      // that have no files of others
  std::map<std::string, std::ofstream> tables_;       // by organ, from its first frame on
  std::map<std::string, std::vector<Frame>> series_;  // by organ
};

}  // namespace sensory_growth::batch
