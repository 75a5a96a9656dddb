#include "sensory_growth/ros/simulation_loop.h"

#include <chrono>
#include <exception>
#include <utility>
#include <vector>

namespace sensory_growth::node {
namespace {

constexpr std::size_t kMostStimuliWaiting = 256;

const std::optional<std::string> kFollows = "~clock_mode is follow: whoever publishes /clock says how fast time passes";

std::string count(std::uint32_t steps) { return std::to_string(steps) + (steps == 1 ? " step" : " steps"); }

}  // namespace

SimulationLoop::SimulationLoop(simulation::Simulation simulation, const Settings& settings, Clock& clock,
                               StimulusCounters& counters, RunListener& listener)
    : settings_(settings),
      clock_(clock),
      listener_(listener),
      run_(
          std::move(simulation), [&clock] { return clock.tick(); }, counters, listener),
      pacer_(settings.step, settings.follows_clock ? 0.0 : settings.real_time_factor),
      mode_(settings.start_paused ? Mode::paused : Mode::running),
      queue_(kMostStimuliWaiting) {}

SimulationLoop::~SimulationLoop() { stop(); }

void SimulationLoop::start() {
  if (mode_ == Mode::running) beginRunning();
  showStatus();
  clock_.flush();
  thread_ = std::thread([this] { run(); });
}

void SimulationLoop::stop() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  step_request_.reset();
}

Answer SimulationLoop::pause() {
  return ask([this](const Reply& reply) { pauseNow(reply); });
}

Answer SimulationLoop::resume() {
  return ask([this](const Reply& reply) { resumeNow(reply); });
}

Answer SimulationLoop::reset() {
  return ask([this](const Reply& reply) {
    resetNow();
    reply->give(answer(true, "back at step 0"));
  });
}

Answer SimulationLoop::step(std::uint32_t steps) {
  return ask([this, steps](const Reply& reply) { stepNow(reply, steps); });
}

Answer SimulationLoop::setRealTimeFactor(double factor) {
  return ask([this, factor](const Reply& reply) {
    const std::optional<std::string> fault = settings_.follows_clock ? kFollows : findFactorFault(factor);
    if (!fault) pacer_.setFactor(factor, std::chrono::steady_clock::now());
    showStatus();
    reply->give(answer(!fault, fault.value_or("applied")));
  });
}

Answer SimulationLoop::load(simulation::Simulation simulation, const simulation::Checkpoint& checkpoint,
                            bool keep_stimuli) {
  // By reference: this waits until the request is done or dropped.
  return ask([&](const Reply& reply) { loadNow(reply, std::move(simulation), checkpoint, keep_stimuli); });
}

Answer SimulationLoop::apply(const simulation::Command& command) {
  return ask([this, command](const Reply& reply) {
    const std::string refusal = applyNow(command).refusal;
    reply->give(answer(refusal.empty(), refusal.empty() ? "applied" : refusal));
  });
}

Answer SimulationLoop::save(const std::function<void(simulation::SimulationState)>& take) {
  return ask([this, take](const Reply& reply) {
    take(run_.state());
    reply->give(answer(true, ""));
  });
}

Answer SimulationLoop::atBoundary(const std::function<std::optional<std::string>(const Snapshot&)>& action) {
  return ask([this, action](const Reply& reply) {
    const std::optional<std::string> failure = action(*run_.snapshot());
    showStatus();
    reply->give(answer(!failure, failure.value_or("")));
  });
}

void SimulationLoop::hearClock(const ros::Time& now) {
  clock_.hear(now);
  if (clock_waits_.exchange(true)) return;
  queue_.push(Control([this] {
    clock_waits_ = false;
    if (clock_.takeBackwardJump()) jumpBack();
  }));
}

void SimulationLoop::refreshStatus() {
  if (refresh_waits_.exchange(true)) return;
  queue_.push(Control([this] {
    refresh_waits_ = false;
    showStatus();
  }));
}

RunStatus SimulationLoop::status() const {
  const std::lock_guard<std::mutex> lock(status_mutex_);
  return status_;
}

Answer SimulationLoop::ask(const std::function<void(const Reply&)>& request) {
  const auto pending = std::make_shared<PendingAnswer>();
  // The queue must hold the only reference to the replier: when it drops the request, that is the answer.
  queue_.push(Control([request, reply = std::make_shared<const Replier>(pending)] { request(reply); }));
  return pending->wait();
}

Answer SimulationLoop::answer(bool success, const std::string& message) {
  clock_.flush();
  const SnapshotPtr snapshot = run_.snapshot();
  return {success, message, snapshot->step_index, snapshot->stamp};
}

void SimulationLoop::run() {
  while (!queue_.isClosed()) {
    try {
      proceed();
    } catch (const std::exception& error) {
      setMode(Mode::fault, error.what());
      abortSteps(std::string("a fault: ") + error.what());
    }
  }
}

/// Does what waits and takes a step if one is due; else waits for either.
void SimulationLoop::proceed() {
  for (const Command& command : queue_.take()) execute(command);
  if (!wantsStep()) return queue_.wait();
  const bool is_paced = !step_request_;
  const auto now = std::chrono::steady_clock::now();
  if (is_paced && pacer_.due() && now < *pacer_.due()) {
    queue_.waitUntil(*pacer_.due());
    return;  // what woke the thread comes first; then it is seen again whether the step is due
  }
  advance();
}

void SimulationLoop::execute(const Command& command) {
  if (const auto* stimulus = std::get_if<simulation::StimulusCommand>(&command)) {
    applyNow(*stimulus);
  } else {
    std::get<Control>(command)();
  }
}

void SimulationLoop::pauseNow(const Reply& reply) {
  abortSteps("pause");
  if (mode_ == Mode::running) setMode(Mode::paused);
  reply->give(answer(true, mode_ == Mode::paused ? "paused" : "was not running: " + message_));
}

void SimulationLoop::resumeNow(const Reply& reply) {
  if (step_request_) return reply->give(answer(false, "a step is under way; pause aborts it"));
  if (mode_ == Mode::finished || mode_ == Mode::fault) {
    return reply->give(answer(false, "reset first: " + message_));
  }
  if (mode_ == Mode::paused) {
    setMode(Mode::running);
    beginRunning();
  }
  reply->give(answer(true, "running"));
}

void SimulationLoop::resetNow() {
  abortSteps("reset");
  clock_.reset();
  run_.reset();
  setMode(mode_ == Mode::running ? Mode::running : Mode::paused);
  pacer_.start(std::chrono::steady_clock::now());
}

void SimulationLoop::jumpBack() {
  if (settings_.on_backward_jump == BackwardJump::reset) resetNow();
}

void SimulationLoop::beginRunning() {
  pacer_.start(std::chrono::steady_clock::now());
  clock_.start();
}

void SimulationLoop::loadNow(const Reply& reply, simulation::Simulation simulation,
                             const simulation::Checkpoint& checkpoint, bool keep_stimuli) {
  abortSteps("load_checkpoint");
  run_.load(std::move(simulation), checkpoint, keep_stimuli);
  if (run_.finished()) {
    setMode(Mode::finished, kFinished);
  } else {
    setMode(mode_ == Mode::running ? Mode::running : Mode::paused);
  }
  if (mode_ == Mode::running) beginRunning();
  reply->give(answer(true, "at step " + std::to_string(checkpoint.state.step_index)));
}

void SimulationLoop::stepNow(const Reply& reply, std::uint32_t steps) {
  const auto refuse = [&](const std::string& why) { reply->give(answer(false, why)); };
  if (steps == 0) return refuse("steps is 0; it must be from 1 to " + std::to_string(kMostSteps));
  if (steps > kMostSteps) {
    return refuse("steps is " + std::to_string(steps) + "; it must be from 1 to " + std::to_string(kMostSteps));
  }
  if (mode_ == Mode::running) return refuse("the simulation is running; pause it first");
  if (mode_ == Mode::fault) return refuse("reset first: " + message_);
  if (step_request_) return refuse("another step is under way");
  step_request_ = StepRequest{steps, 0, reply};
}

simulation::AppliedCommand SimulationLoop::applyNow(const simulation::Command& command) {
  simulation::AppliedCommand applied = run_.apply(command);
  showStatus();
  return applied;
}

void SimulationLoop::advance() {
  const bool is_paced = !step_request_;
  if (is_paced) pacer_.stepBegins(std::chrono::steady_clock::now());
  const simulation::StepReport report = run_.step();
  if (!report.ok) {
    setMode(Mode::fault, report.message);
    abortSteps("a fault: " + report.message);
    return;
  }
  if (is_paced) pacer_.stepEnded(std::chrono::steady_clock::now());
  if (run_.finished() && mode_ != Mode::finished) {
    setMode(Mode::finished, kFinished);
  } else {
    showStatus();
  }
  if (step_request_ && ++step_request_->done == step_request_->asked) {
    const StepRequest request = *std::exchange(step_request_, std::nullopt);
    request.reply->give(answer(true, "took " + count(request.done)));
  }
}

void SimulationLoop::abortSteps(const std::string& why) {
  if (!step_request_) return;
  const StepRequest request = *std::exchange(step_request_, std::nullopt);
  request.reply->give(
      answer(false, "aborted by " + why + " after " + std::to_string(request.done) + " of " + count(request.asked)));
}

void SimulationLoop::setMode(Mode mode, const std::string& message) {
  if (mode_ == Mode::running && mode != Mode::running) {
    pacer_.stop(std::chrono::steady_clock::now());
    clock_.stop();
    clock_.flush();
  }
  mode_ = mode;
  message_ = message;
  showStatus();
}

void SimulationLoop::showStatus() {
  const RunStatus status{mode_, message_, pacer_.achievedFactor(), pacer_.overruns() + clock_.overruns(),
                         pacer_.factor()};
  {
    const std::lock_guard<std::mutex> lock(status_mutex_);
    status_ = status;
  }
  listener_.onStatus(status, *run_.snapshot());
}

}  // namespace sensory_growth::node
