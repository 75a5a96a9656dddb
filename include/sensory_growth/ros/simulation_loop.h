#pragma once

/// The thread that owns the simulation: it takes commands at step boundaries, steps at the pace asked for, and shows
/// every state to one listener.

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "sensory_growth/ros/answer.h"
#include "sensory_growth/ros/clock.h"
#include "sensory_growth/ros/command_queue.h"
#include "sensory_growth/ros/pacer.h"
#include "sensory_growth/ros/run.h"
#include "sensory_growth/ros/stimulus_counters.h"
#include "sensory_growth/simulation/simulation.h"

namespace sensory_growth::node {

class SimulationLoop {
 public:
  struct Settings {
    double step = 0.0;  ///< ROS time of a step [s]
    double real_time_factor = 1.0;
    bool start_paused = false;
    bool follows_clock = false;  ///< steps are due when the clock says so; the factor is without meaning
    BackwardJump on_backward_jump = BackwardJump::reset;
  };

  /// Most steps one call of step() may ask for.
  static constexpr std::uint32_t kMostSteps = 1000000;

  /// Shows the first state to the listener. The references must outlive the loop.
  SimulationLoop(simulation::Simulation simulation, const Settings& settings, Clock& clock, StimulusCounters& counters,
                 RunListener& listener);
  ~SimulationLoop();

  /// Starts the thread.
  void start();

  /// Ends the thread at the next step boundary; callers that wait are told. Nothing can be asked afterwards.
  void stop();

  // From any thread but that of the loop. Each answers after its effect was shown to the listener.
  Answer pause();
  Answer resume();
  Answer reset();
  Answer step(std::uint32_t steps);
  Answer setRealTimeFactor(double factor);
  Answer load(simulation::Simulation simulation, const simulation::Checkpoint& checkpoint, bool keep_stimuli);
  Answer apply(const simulation::Command& command);

  /// Hands the state between two steps to `take`, on the thread of the loop.
  Answer save(const std::function<void(simulation::SimulationState)>& take);

  /// Runs `action` on the thread of the loop between two steps and shows the status afterwards. What `action` returns
  /// is why it failed, or nothing.
  Answer atBoundary(const std::function<std::optional<std::string>(const Snapshot&)>& action);

  /// Queues a stimulus for the next step boundary; false if too many wait.
  bool send(const simulation::StimulusCommand& stimulus) { return queue_.push(stimulus); }

  /// The clock that is followed says `now`.
  void hearClock(const ros::Time& now);

  /// Shows the status again soon, because something that it counts has changed.
  void refreshStatus();

  SnapshotPtr snapshot() const { return run_.snapshot(); }
  RunStatus status() const;

 private:
  struct StepRequest {
    std::uint32_t asked = 0;
    std::uint32_t done = 0;
    Reply reply;
  };

  Answer ask(const std::function<void(const Reply&)>& request);
  Answer answer(bool success, const std::string& message);

  void run();
  void proceed();
  void execute(const Command& command);
  void pauseNow(const Reply& reply);
  void resumeNow(const Reply& reply);
  void resetNow();
  void loadNow(const Reply& reply, simulation::Simulation simulation, const simulation::Checkpoint& checkpoint,
               bool keep_stimuli);
  void stepNow(const Reply& reply, std::uint32_t steps);
  simulation::AppliedCommand applyNow(const simulation::Command& command);
  bool wantsStep() { return step_request_ || (mode_ == Mode::running && clock_.isDue()); }
  void jumpBack();
  void beginRunning();
  void advance();
  void abortSteps(const std::string& why);
  void setMode(Mode mode, const std::string& message = "");
  void showStatus();

  const Settings settings_;

  // Of the loop's thread alone, but for the clock.
  Clock& clock_;
  RunListener& listener_;
  Run run_;
  Pacer pacer_;
  Mode mode_;
  std::string message_;
  std::optional<StepRequest> step_request_;

  CommandQueue queue_;
  std::atomic<bool> refresh_waits_{false};
  std::atomic<bool> clock_waits_{false};

  mutable std::mutex status_mutex_;  // guards what follows; nothing else is locked while it is held
  RunStatus status_;

  std::thread thread_;
};

}  // namespace sensory_growth::node
