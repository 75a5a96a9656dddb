#include "sensory_growth/batch/batch_run.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "sensory_growth/batch/bad_input.h"
#include "sensory_growth/ros/clock.h"

namespace sensory_growth::batch {
namespace {

simulation::Simulation build(simulation::Scenario scenario, const BatchRun::Origin& origin, int threads) {
  try {
    return origin ? simulation::Simulation(std::move(scenario), origin->state, threads)
                  : simulation::Simulation(std::move(scenario), threads);
  } catch (const std::invalid_argument& fault) {
    throw BadInput(fault.what());
  }
}

}  // namespace

BatchRun::Reporter::Reporter(const node::Parameters& parameters, const node::Sources& sources,
                             const node::StimulusCounters& counters, Watch watch)
    : node::Reporter(
          parameters, sources, counters,
          [node = sources.node](const std::string& name) { return name.front() == '/' ? name : node + "/" + name; }),
      watch_(std::move(watch)) {}

void BatchRun::Reporter::publish(const Topic&, const node::Message& message) { watch_(message); }

BatchRun::BatchRun(const node::Parameters& parameters, const node::LoadedScenario& loaded, Watch watch,
                   std::uint32_t epoch, const Origin& origin)
    : threads_(parameters.threads),
      reporter_(parameters, loaded.sources, counters_, std::move(watch)),
      run_(
          build(loaded.scenario, origin, threads_),
          [this, step = loaded.scenario.stepping.step / parameters.growth_time_scale] {
            return node::stampOf(++ticks_, step);
          },
          counters_, reporter_, epoch, origin) {
  if (parameters.record) {
    if (const auto refusal = reporter_.startRecording(parameters.recording_file, *run_.snapshot())) {
      throw BadInput(*refusal);
    }
  }
  showStatus();
}

std::optional<std::string> BatchRun::step() {
  const simulation::StepReport report = run_.step();
  if (!report.ok) fault_ = report.message;
  showStatus();
  return fault_;
}

void BatchRun::apply(const simulation::Command& command) {
  run_.apply(command);
  showStatus();
}

void BatchRun::reset() {
  run_.reset();
  fault_.reset();
  showStatus();
}

void BatchRun::load(simulation::Scenario scenario, const simulation::Checkpoint& checkpoint) {
  run_.load(build(std::move(scenario), checkpoint, threads_), checkpoint, false);
  fault_.reset();
  showStatus();
}

std::optional<node::RecordingSummary> BatchRun::finish() {
  if (const auto recording = reporter_.takeRecording()) return recording->finish();
  return reporter_.failure;
}

void BatchRun::showStatus() {
  node::RunStatus status{node::Mode::running, "", 0.0, 0};
  if (run_.finished()) status = {node::Mode::finished, node::kFinished, 0.0, 0};
  if (fault_) status = {node::Mode::fault, *fault_, 0.0, 0};
  reporter_.onStatus(status, *run_.snapshot());
}

std::filesystem::path inFolder(const std::string& file) {
  const std::filesystem::path path = std::filesystem::absolute(file);
  std::error_code failure;
  std::filesystem::create_directories(path.parent_path(), failure);
  if (failure) throw BadInput(path.parent_path().string() + ": cannot be created: " + failure.message());
  return path;
}

void recordTo(const std::string& bag, node::Parameters& parameters) {
  if (bag.empty()) return;
  const std::filesystem::path path = inFolder(bag);
  try {
    node::recordingPath(path.parent_path(), path.filename());
  } catch (const std::invalid_argument& refusal) {
    throw BadInput(refusal.what());
  }
  parameters.record = true;
  parameters.recording_directory = path.parent_path();
  parameters.recording_file = path.filename();
}

std::uint64_t stepsIn(double duration, double step) {
  return static_cast<std::uint64_t>(std::ceil(duration / step * (1.0 - 1e-12)));
}

}  // namespace sensory_growth::batch
