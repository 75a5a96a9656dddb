#include "sensory_growth/batch/replay.h"

#include <algorithm>
#include <ostream>
#include <utility>
#include <variant>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/batch/commands.h"
#include "sensory_growth/batch/frame_files.h"
#include "sensory_growth/batch/progress.h"
#include "sensory_growth/batch/summary.h"
#include "sensory_growth/ros/conversions.h"

namespace sensory_growth::batch {
namespace {

/// Recording may begin or end while a state is current.
bool isPartOf(const std::vector<std::uint64_t>& recorded, const std::vector<std::uint64_t>& replayed) {
  return std::search(replayed.begin(), replayed.end(), recorded.begin(), recorded.end()) != replayed.end();
}

template <typename Value>
const Value* find(const std::map<std::uint64_t, Value>& steps, std::uint64_t step) {
  const auto found = steps.find(step);
  return found == steps.end() ? nullptr : &found->second;
}

/// Those of the recording, but for what the command line says of this run.
node::Parameters parametersOf(const ReplayOptions& options, const RecordedRun& recorded) {
  node::Parameters parameters = recorded.parameters;
  parameters.threads = options.threads;
  parameters.real_time_factor = 0.0;
  parameters.record = false;
  parameters.recording_split_size = 0.0;  // into one bag
  recordTo(options.bag, parameters);
  return parameters;
}

}  // namespace

std::uint64_t stepsOf(const RecordedRun& recorded) {
  std::uint64_t steps = 0;
  for (const auto& [number, epoch] : recorded.epochs) steps += epoch.lastStep() - epoch.beginning();
  return steps;
}

Replay::Replay(const RecordedRun& recorded, const node::Parameters& parameters, const node::LoadedScenario& loaded,
               BatchRun::Watch watch)
    : recorded_(recorded),
      parameters_(parameters),
      watch_(std::move(watch)),
      run_(
          parameters, loaded, [this](const node::Message& message) { listen(message); }, recorded.epochs.begin()->first,
          recorded.epochs.begin()->second.origin) {}

ReplayReport Replay::run(const Go& go) {
  ReplayReport report;
  std::uint64_t taken = 0;
  for (const auto& [number, epoch] : recorded_.epochs) {
    if (run_.snapshot()->epoch < number) begin(epoch);
    for (std::uint64_t step = epoch.beginning(); step <= epoch.lastStep(); ++step) {
      std::optional<std::string> fault;
      if (step > epoch.beginning()) {
        commands_.clear();
        checksums_.clear();
        fault = run_.step();
        ++taken;
      }
      const bool is_compared = step >= epoch.firstStep();
      report.compared += is_compared ? 1 : 0;
      const auto what = fault ? "the step fails: " + *fault : follow(epoch, step);
      if (what) {
        report.difference = {number, step, *what};
        return report;
      }
      if (!go(taken, *run_.snapshot())) {
        report.interrupted = true;
        return report;
      }
    }
  }
  return report;
}

void Replay::begin(const RecordedEpoch& epoch) {
  commands_.clear();
  checksums_.clear();
  if (!epoch.origin) return run_.reset();
  std::vector<std::string> problems;
  node::LoadedScenario loaded =
      node::parseScenario(parameters_, recorded_.sources.node, "a checkpoint", *epoch.origin, problems);
  if (!problems.empty()) throw BadInput(problems);
  run_.load(std::move(loaded.scenario), *epoch.origin);
}

void Replay::listen(const node::Message& message) {
  if (const auto* command = std::get_if<boost::shared_ptr<const AppliedCommand>>(&message)) {
    commands_.push_back(**command);
  } else if (const auto* status = std::get_if<boost::shared_ptr<const Status>>(&message)) {
    const std::uint64_t checksum = (*status)->checksum;
    if (checksums_.empty() || checksums_.back() != checksum) checksums_.push_back(checksum);
  }
  watch_(message);
}

/// Gives the commands of the step that come neither from the protocol nor from a timed stimulus, and compares the whole
/// of it.
std::optional<std::string> Replay::follow(const RecordedEpoch& epoch, std::uint64_t step) {
  const std::vector<AppliedCommand> none;
  const auto* given = find(epoch.commands, step);
  const std::vector<AppliedCommand>& recorded = given ? *given : none;
  while (commands_.size() < recorded.size()) {  // each adds one
    const auto command = node::toCommand(recorded[commands_.size()]);
    if (!command) return "command " + std::to_string(commands_.size() + 1) + " is of no known kind or operation";
    run_.apply(*command);
  }
  if (auto what = compareCommands(recorded)) return what;
  if (step < epoch.firstStep()) return std::nullopt;
  const auto* checksums = find(epoch.checksums, step);
  if (!checksums) return "the bag holds no status of it";
  if (!isPartOf(*checksums, checksums_)) return "the state is another";
  return std::nullopt;
}

std::optional<std::string> Replay::compareCommands(const std::vector<AppliedCommand>& recorded) const {
  if (recorded.size() != commands_.size()) {
    return "the bag holds " + std::to_string(recorded.size()) + " commands instead of " +
           std::to_string(commands_.size());
  }
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    AppliedCommand replayed = commands_[i];
    replayed.header = recorded[i].header;  // of the clock of the recording
    if (replayed != recorded[i]) return "command " + std::to_string(i + 1) + " ('" + recorded[i].id + "') is another";
  }
  return std::nullopt;
}

ExitCode replay(const ReplayOptions& options, const Console& console) {
  const rosbag::Bag bag = openBag(options.recorded);
  const RecordedRun recorded = readRun(bag, nodeOf(bag, options.node));
  if (!options.quiet && recorded.version != node::version()) {
    console.err << options.recorded << " was recorded by version " << recorded.version << ", this is "
                << node::version() << "; they may differ in the last bits\n";
  }
  const node::Parameters parameters = parametersOf(options, recorded);
  std::vector<std::string> problems;
  node::LoadedScenario loaded = node::parseScenario(parameters, recorded.sources, problems);
  if (!problems.empty()) throw BadInput(problems);

  const std::uint32_t last_epoch = recorded.epochs.rbegin()->first;
  FrameFiles frames(options.frames, loaded.sources.organs, last_epoch);
  Replay replay(recorded, parameters, loaded, [&frames](const node::Message& m) { frames.take(m); });

  ReplayReport report;
  Summary summary;
  {
    Progress progress(console.err, progressStyle(options.quiet), stepsOf(recorded));
    report = replay.run([&](std::uint64_t steps, const node::Snapshot& snapshot) {
      summary.steps = steps;
      progress.show(steps, snapshot.growth_time);
      return !console.interrupted();
    });
    summary.wall_time = progress.elapsed();
  }
  frames.close();
  summary.recording = replay.finish();
  summary.snapshot = replay.snapshot();
  summary.interrupted = report.interrupted;
  if (report.difference) {
    const Difference& first = *report.difference;
    console.err << options.recorded << " differs first at step " << first.step << " of epoch " << first.epoch << ": "
                << first.what << '\n';
  } else if (!options.quiet) {
    console.out << options.recorded << ": all " << report.compared << " states compared are equal; "
                << describe(summary) << '\n';
  }
  return conclude(summary, report.difference.has_value(), console);
}

}  // namespace sensory_growth::batch
