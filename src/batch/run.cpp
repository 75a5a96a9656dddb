#include <algorithm>
#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <variant>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/batch/batch_run.h"
#include "sensory_growth/batch/commands.h"
#include "sensory_growth/batch/frame_files.h"
#include "sensory_growth/batch/progress.h"
#include "sensory_growth/batch/summary.h"
#include "sensory_growth/ros/checkpoint_file.h"
#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::batch {
namespace {

constexpr char kNode[] = "/sensory_growth";  // as sim.launch calls it

template <typename Read>
double scaleOf(const Read& read) {
  constexpr double kOfSimLaunch = 60.0;
  try {
    return std::max(kOfSimLaunch, read().stepping.step);
  } catch (const simulation::ScenarioError&) {
    return kOfSimLaunch;  // what is wrong is said when the scenario is loaded to be run
  }
}

BatchRun::Origin originOf(const RunOptions& options) {
  if (options.from.empty()) return std::nullopt;
  try {
    return node::readCheckpoint(options.from);
  } catch (const std::runtime_error& refusal) {
    throw BadInput(refusal.what());
  }
}

/// Path of a checkpoint that does not exist yet, in a folder that does; empty if none is wanted.
std::string checkpointPath(const RunOptions& options) {
  if (options.checkpoint.empty()) return "";
  const std::filesystem::path path = inFolder(options.checkpoint);
  if (path.extension() != node::kCheckpointExtension) {
    throw BadInput("--save-checkpoint is '" + options.checkpoint + "'; it must end in " + node::kCheckpointExtension);
  }
  if (std::filesystem::exists(path)) throw BadInput(path.string() + " exists already");
  return path;
}

double scaleOf(const RunOptions& options, const BatchRun::Origin& origin) {
  if (options.growth_time_scale) return *options.growth_time_scale;
  if (!origin) return defaultScale(options.scenario);
  return scaleOf([&] { return simulation::parseScenario(origin->scenario, options.from); });
}

node::Parameters parametersOf(const RunOptions& options, const BatchRun::Origin& origin) {
  node::Parameters parameters;
  parameters.scenario = origin ? options.from : options.scenario;
  parameters.protocol = options.protocol;
  parameters.threads = options.threads;
  parameters.growth_time_scale = scaleOf(options, origin);
  parameters.real_time_factor = 0.0;
  parameters.exit_when_finished = true;
  parameters.recording_marker_every = options.marker_every;
  recordTo(options.bag, parameters);
  return parameters;
}

node::LoadedScenario load(const RunOptions& options, const node::Parameters& parameters,
                          const BatchRun::Origin& origin) {
  std::vector<std::string> problems;
  node::LoadedScenario loaded = origin ? node::parseScenario(parameters, kNode, options.from, *origin, problems)
                                       : node::loadScenario(parameters, kNode, problems);
  if (!problems.empty()) throw BadInput(problems);
  loaded.scenario.duration = options.duration.value_or(loaded.scenario.duration);
  if (loaded.scenario.duration <= 0.0) {
    throw BadInput(parameters.scenario + ": the scenario has no duration, so it would never end; give --duration");
  }
  return loaded;
}

}  // namespace

double defaultScale(const std::string& scenario) {
  return scaleOf([&] { return simulation::loadScenario(scenario); });
}

ExitCode run(const RunOptions& options, const Console& console) {
  const BatchRun::Origin origin = originOf(options);
  const std::string checkpoint = checkpointPath(options);
  const node::Parameters parameters = parametersOf(options, origin);
  node::LoadedScenario loaded = load(options, parameters, origin);
  const std::string name = loaded.scenario.name;
  const std::uint64_t steps = stepsIn(loaded.scenario.duration, loaded.scenario.stepping.step);
  FrameFiles frames(options.frames, loaded.sources.organs);
  BatchRun batch(
      parameters, loaded, [&frames](const node::Message& message) { frames.take(message); }, 0, origin);
  const std::uint64_t first_step = batch.snapshot()->step_index;

  Summary summary;
  std::optional<std::string> fault;
  {
    Progress progress(console.err, progressStyle(options.quiet), steps);
    while (!batch.finished() && !fault && !summary.interrupted) {
      fault = batch.step();
      progress.show(batch.snapshot()->step_index, batch.snapshot()->growth_time);
      summary.interrupted = console.interrupted();
    }
    summary.wall_time = progress.elapsed();
  }
  if (fault) console.err << name << ": " << *fault << '\n';
  frames.close();
  if (!checkpoint.empty()) node::writeCheckpoint(checkpoint, batch.checkpoint());
  summary.recording = batch.finish();
  summary.snapshot = batch.snapshot();
  summary.steps = summary.snapshot->step_index - first_step;
  if (!options.quiet) console.out << name << ": " << describe(summary) << '\n';
  return conclude(summary, fault.has_value(), console);
}

}  // namespace sensory_growth::batch
