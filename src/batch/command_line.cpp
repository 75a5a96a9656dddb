#include "sensory_growth/batch/command_line.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <sstream>
#include <string>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/ros/loaded_scenario.h"
#include "sensory_growth/simulation/units.h"

namespace sensory_growth::batch {
namespace {

constexpr char kName[] = "sensory_growth_batch";

const char kFooter[] =
    "Exit codes: 0 all is well; 1 a step failed, a replay differs, or the disk did not take what was written;\n"
    "2 the input is bad and nothing was begun; 130 interrupted, with what was written complete up to there.";

/// Prints each line with the name of the program before it.
void complain(const std::string& text, const Console& console) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) console.err << kName << ": " << line << '\n';
}

void addFrameOptions(CLI::App& command, FrameOptions& frames) {
  command.add_option("--csv", frames.csv, "folder for tables of centrelines: frame,x,y,z, a file per organ")
      ->type_name("DIR");
  command
      .add_option("--vtk", frames.vtk, "folder for polylines with curvature, growth rate, radius and age (ParaView)")
      ->type_name("DIR");
  command.add_option("--every", frames.every, "steps between two frames of --csv and --vtk")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}))
      ->type_name("N");
}

void addRunOptions(CLI::App& command, int& threads, bool& quiet) {
  command.add_option("--threads", threads, "most threads; 0: one per processor. What comes out does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  command.add_flag("--quiet", quiet, "no progress and no summary");
}

CLI::App* addRun(CLI::App& app, RunOptions& options, std::string& duration) {
  CLI::App* run = app.add_subcommand("run", "Grows the organs of a scenario for its duration");
  CLI::Option_group* beginning = run->add_option_group("Beginning");
  beginning->require_option(1);
  beginning->add_option("scenario", options.scenario, "scenario file")->check(CLI::ExistingFile);
  CLI::Option* from =
      beginning->add_option("--from", options.from, "checkpoint to go on from; it holds its scenario and protocol")
          ->check(CLI::ExistingFile);
  run->add_option("--protocol", options.protocol, "commands added to those of the scenario")
      ->check(CLI::ExistingFile)
      ->excludes(from);
  run->add_option("--duration", duration, "growth time with its unit, such as '8 h' (default: that of the scenario)");
  run->add_option("--bag", options.bag, "bag to record to, as the node does")->type_name("OUT.bag");
  run->add_option("--save-checkpoint", options.checkpoint, "checkpoint of the last state")->type_name("OUT.checkpoint");
  run->add_option("--marker-every", options.marker_every, "steps between markers in the bag; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000))
      ->type_name("N");
  run->add_option("--growth-time-scale", options.growth_time_scale,
                  "growth seconds per second of stamps (default: 60, or as much as a step needs to last 1 s)")
      ->check(CLI::Range(1e-9, 1e12))
      ->type_name("X");
  addFrameOptions(*run, options.frames);
  addRunOptions(*run, options.threads, options.quiet);
  return run;
}

void addRecordedOptions(CLI::App& command, std::string& recorded, std::string& node) {
  command.add_option("recorded", recorded, "bag recorded by the node or by run")->required()->check(CLI::ExistingFile);
  command.add_option("--node", node, "node whose run it is, if the bag holds several")->type_name("NAME");
}

CLI::App* addReplay(CLI::App& app, ReplayOptions& options) {
  CLI::App* replay = app.add_subcommand("replay", "Runs a bag again, commands included, and compares every state");
  addRecordedOptions(*replay, options.recorded, options.node);
  replay->add_option("--bag", options.bag, "bag to record the replay to")->type_name("OUT.bag");
  addFrameOptions(*replay, options.frames);
  addRunOptions(*replay, options.threads, options.quiet);
  return replay;
}

CLI::App* addExport(CLI::App& app, ExportOptions& options) {
  CLI::App* command = app.add_subcommand("export", "Writes the states in a bag to files of other programs");
  addRecordedOptions(*command, options.recorded, options.node);
  addFrameOptions(*command, options.frames);
  command->add_flag("--quiet", options.quiet, "no summary");
  return command;
}

double parseDuration(const std::string& text) {
  try {
    const double duration = simulation::parseQuantity(text, simulation::dimension::time);
    if (duration > 0.0) return duration;
  } catch (const std::invalid_argument& fault) {
    throw BadInput("--duration '" + text + "' " + fault.what());
  }
  throw BadInput("--duration '" + text + "' is not positive");
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Console& console) {
  CLI::App app("Runs sensory_growth with no master, as fast as it can.", kName);
  app.set_version_flag("--version", node::version());
  app.require_subcommand(1);
  app.footer(kFooter);
  RunOptions run_options;
  ReplayOptions replay_options;
  ExportOptions export_options;
  std::string duration;
  const CLI::App* run_command = addRun(app, run_options, duration);
  const CLI::App* replay_command = addReplay(app, replay_options);
  addExport(app, export_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, console.out, console.err) == 0 ? kOk : kBadInput;
  }
  try {
    if (!duration.empty()) run_options.duration = parseDuration(duration);
    if (*run_command) return run(run_options, console);
    if (*replay_command) return replay(replay_options, console);
    return exportFrames(export_options, console);
  } catch (const BadInput& problems) {
    complain(problems.what(), console);
    return kBadInput;
  } catch (const std::exception& fault) {
    complain(fault.what(), console);
    return kFault;
  }
}

}  // namespace sensory_growth::batch
