#include <ostream>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/batch/commands.h"
#include "sensory_growth/batch/recorded_run.h"

namespace sensory_growth::batch {

ExitCode exportFrames(const ExportOptions& options, const Console& console) {
  if (options.frames.csv.empty() && options.frames.vtk.empty()) {
    throw BadInput("nothing to export to; give --csv or --vtk, or both");
  }
  const rosbag::Bag bag = openBag(options.recorded);
  const std::uint64_t states = writeFrames(bag, nodeOf(bag, options.node), options.frames);
  if (!options.quiet) console.out << options.recorded << ": " << states << " states read\n";
  return kOk;
}

}  // namespace sensory_growth::batch
