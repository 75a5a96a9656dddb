#include "sensory_growth/ros/diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

const std::string kOrgan = "organ ";  // begins the names of the entries of organs

const char* describe(Mode mode) {
  switch (mode) {
    case Mode::paused:
      return "paused";
    case Mode::running:
      return "running";
    case Mode::finished:
      return "finished";
    case Mode::fault:
      return "fault";
  }
  return "?";
}

}  // namespace

void reportRelaxation(const OrganSnapshot& organ, DiagnosticStatusWrapper& status) {
  constexpr double kCoarseBend = 0.5;  // [rad], model.md 15
  const simulation::OrganReport& report = organ.report;
  const mechanics::RelaxationReport& relaxation = report.relaxation;
  if (!report.ok()) {
    status.summary(DiagnosticStatus::ERROR, simulation::describe(report));
  } else if (report.retries > 0 || report.branch_switches > 0) {
    status.summary(DiagnosticStatus::WARN, "in equilibrium, after help");
  } else if (relaxation.largest_bend > kCoarseBend) {
    status.summary(DiagnosticStatus::WARN, "coarsely resolved: use shorter elements");
  } else if (report.largest_differential_growth > 1.0) {
    status.summary(DiagnosticStatus::WARN, "differential growth above 1: one side would have to shrink");
  } else {
    status.summary(DiagnosticStatus::OK, "in equilibrium");
  }
  status.add("reason", mechanics::name(relaxation.reason));
  status.add("iterations", relaxation.iterations);
  status.add("iterations of the step", report.iterations);
  status.add("residual", relaxation.residual);
  status.add("kinetic energy [J]", relaxation.kinetic_energy);
  if (relaxation.lowest_eigenvalue) status.add("lowest eigenvalue [N m]", *relaxation.lowest_eigenvalue);
  status.add("branch switches", report.branch_switches);
  status.add("largest turn between elements [rad]", relaxation.largest_bend);
  status.add("largest differential growth", report.largest_differential_growth);
  status.add("parts of the step", report.substeps);
  status.add("parts cut again", report.retries);
  status.add("elements", organ.rod.size());
  status.add("rest length [m]", organ.rod.restLength());
}

void reportLoop(const RunStatus& loop, const Snapshot& snapshot, DiagnosticStatusWrapper& status) {
  const bool is_fault = loop.mode == Mode::fault;
  const std::string mode = describe(loop.mode);
  status.summary(is_fault ? DiagnosticStatus::ERROR : DiagnosticStatus::OK,
                 loop.message.empty() ? mode : mode + ": " + loop.message);
  status.add("step", snapshot.step_index);
  status.add("epoch", snapshot.epoch);
  status.add("growth time [s]", snapshot.growth_time);
  status.add("achieved real time factor", loop.achieved_real_time_factor);
  status.add("overruns", loop.overruns);
}

void reportStimuli(const StimulusCounters& counters, std::uint64_t refused_before, DiagnosticStatusWrapper& status) {
  const std::uint64_t refused = counters.refused();
  if (refused > refused_before) {
    status.summaryf(DiagnosticStatus::WARN, "%lu refused lately", static_cast<unsigned long>(refused - refused_before));
  } else {
    status.summary(DiagnosticStatus::OK, "none refused lately");
  }
  for (const StimulusFate fate : kStimulusFates) status.add(name(fate), counters.of(fate));
}

void reportRecording(const std::string& path, const std::string& failure, DiagnosticStatusWrapper& status) {
  if (!failure.empty()) return status.summary(DiagnosticStatus::WARN, "failed: " + failure);
  status.summary(DiagnosticStatus::OK, path.empty() ? "off" : "writing " + path);
}

void reportMaster(MasterWatch::State state, DiagnosticStatusWrapper& status) {
  switch (state) {
    case MasterWatch::State::known:
      return status.summary(DiagnosticStatus::OK, "registered");
    case MasterWatch::State::unreachable:
      return status.summary(DiagnosticStatus::WARN, "the master is out of reach; nobody new can find this node");
    case MasterWatch::State::registered_again:
      return status.summary(DiagnosticStatus::WARN, "the master was started anew; this node has registered again");
  }
}

void reportClock(ClockMode mode, const std::vector<std::string>& others, DiagnosticStatusWrapper& status) {
  for (const std::string& other : others) status.add("publisher", other);
  if (mode == ClockMode::publish) {
    if (others.empty()) return status.summary(DiagnosticStatus::OK, "this node alone publishes /clock");
    return status.summary(DiagnosticStatus::ERROR, "another node publishes /clock too");
  }
  if (others.empty()) return status.summary(DiagnosticStatus::WARN, "nobody publishes /clock, so time stands still");
  if (others.size() == 1) return status.summary(DiagnosticStatus::OK, "following the /clock of " + others.front());
  status.summary(DiagnosticStatus::ERROR, "several nodes publish /clock");
}

Diagnostics::Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Sources sources)
    : sources_(std::move(sources)),
      snapshot_(sources_.snapshot()),
      clock_warnings_(std::chrono::seconds(10)),
      updater_(node, private_node) {
  updater_.setHardwareID("none");
  updater_.add("simulation",
               [this](DiagnosticStatusWrapper& status) { reportLoop(sources_.loop(), *snapshot_, status); });
  updater_.add("stimuli", [this](DiagnosticStatusWrapper& status) {
    reportStimuli(*sources_.counters, refused_before_, status);
    refused_before_ = sources_.counters->refused();
  });
  updater_.add("recording", [this](DiagnosticStatusWrapper& status) {
    reportRecording(sources_.recording(), sources_.recording_failure(), status);
  });
  updater_.add("master", [this](DiagnosticStatusWrapper& status) {
    const MasterWatch::State state = master_.check();
    reportMaster(state, status);
    status.add("times registered again", master_.restarts());
    if (state == MasterWatch::State::registered_again) ROS_WARN_STREAM_NAMED(names::kLogRos, status.message);
  });
  followOrgans();
  if (sources_.clock_mode == ClockMode::wall) return;
  updater_.add("clock", [this](DiagnosticStatusWrapper& status) {
    reportClock(sources_.clock_mode, otherClockPublishers(), status);
    if (status.level == DiagnosticStatus::ERROR && clock_warnings_.due()) {
      ROS_WARN_STREAM_NAMED(names::kLogRos, status.message << "; time jumps to and fro");
    }
  });
}

void Diagnostics::update() {
  snapshot_ = sources_.snapshot();
  followOrgans();
  updater_.force_update();
}

/// An entry for each organ there is.
void Diagnostics::followOrgans() {
  std::set<std::string> present;
  for (const OrganSnapshot& organ : snapshot_->organs) present.insert(organ.id);
  for (const std::string& organ : organs_) {
    if (!present.count(organ)) updater_.removeByName(kOrgan + organ);
  }
  for (const std::string& organ : present) {
    if (organs_.count(organ)) continue;
    updater_.add(kOrgan + organ, [this, organ](DiagnosticStatusWrapper& status) {
      const auto is_meant = [&organ](const OrganSnapshot& other) { return other.id == organ; };
      reportRelaxation(*std::find_if(snapshot_->organs.begin(), snapshot_->organs.end(), is_meant), status);
    });
  }
  organs_ = std::move(present);
}

}  // namespace sensory_growth::node
