#include <algorithm>
#include <ostream>
#include <utility>
#include <variant>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/batch/batch_run.h"
#include "sensory_growth/batch/commands.h"
#include "sensory_growth/batch/frame_files.h"
#include "sensory_growth/batch/progress.h"
#include "sensory_growth/batch/summary.h"
#include "sensory_growth/simulation/scenario_yaml.h"

namespace sensory_growth::batch {
namespace {

constexpr char kNode[] = "/sensory_growth";  // as sim.launch calls it

node::Parameters parametersOf(const RunOptions& options) {
  node::Parameters parameters;
  parameters.scenario = options.scenario;
  parameters.protocol = options.protocol;
  parameters.threads = options.threads;
  parameters.growth_time_scale = options.growth_time_scale.value_or(defaultScale(options.scenario));
  parameters.real_time_factor = 0.0;
  parameters.exit_when_finished = true;
  parameters.recording_marker_every = options.marker_every;
  recordTo(options.bag, parameters);
  return parameters;
}

node::LoadedScenario load(const RunOptions& options, const node::Parameters& parameters) {
  std::vector<std::string> problems;
  node::LoadedScenario loaded = node::loadScenario(parameters, kNode, problems);
  if (!problems.empty()) throw BadInput(problems);
  loaded.scenario.duration = options.duration.value_or(loaded.scenario.duration);
  if (loaded.scenario.duration <= 0.0) {
    throw BadInput(options.scenario + ": the scenario has no duration, so it would never end; give --duration");
  }
  return loaded;
}

}  // namespace

double defaultScale(const std::string& scenario) {
  constexpr double kOfSimLaunch = 60.0;
  try {
    return std::max(kOfSimLaunch, simulation::loadScenario(scenario).stepping.step);
  } catch (const simulation::ScenarioError&) {
    return kOfSimLaunch;  // what is wrong is said when the scenario is loaded to be run
  }
}

ExitCode run(const RunOptions& options, const Console& console) {
  const node::Parameters parameters = parametersOf(options);
  node::LoadedScenario loaded = load(options, parameters);
  const std::string name = loaded.scenario.name;
  const std::uint64_t steps = stepsIn(loaded.scenario.duration, loaded.scenario.stepping.step);
  FrameFiles frames(options.frames, loaded.sources.organs);
  BatchRun batch(parameters, std::move(loaded), [&frames](const node::Message& message) { frames.take(message); });

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
  summary.recording = batch.finish();
  summary.snapshot = batch.snapshot();
  summary.steps = summary.snapshot->step_index;
  if (!options.quiet) console.out << name << ": " << describe(summary) << '\n';
  return conclude(summary, fault.has_value(), console);
}

}  // namespace sensory_growth::batch
