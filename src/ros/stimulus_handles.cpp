#include "sensory_growth/ros/stimulus_handles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensory_growth/ros/conversions.h"
#include "sensory_growth/ros/handle_shapes.h"
#include "sensory_growth/ros/names.h"

namespace sensory_growth::node {
namespace {

using simulation::StimulusCommand;
using simulation::StimulusKind;
using simulation::StimulusOperation;
using std::chrono::steady_clock;
using Feedback = visualization_msgs::InteractiveMarkerFeedback;

/// rviz says several times a second that it still drags; one that is silent for so long is gone [wall time].
constexpr std::chrono::seconds kGone{10};

constexpr std::chrono::milliseconds kHeartbeat{500};  // of wall time

StimulusCommand commandOf(const growth::PointSource& lamp) {
  return {StimulusKind::point_source, StimulusOperation::change, lamp.id, lamp.position, lamp.strength};
}

StimulusCommand commandOf(const growth::LightDirection& light) {
  return {StimulusKind::light_direction, StimulusOperation::change, light.id, light.towards, light.strength};
}

template <typename Visit>
void forEach(const growth::Environment& environment, const Visit& visit) {
  for (const growth::PointSource& lamp : environment.point_sources) visit(commandOf(lamp));
  for (const growth::LightDirection& light : environment.light_directions) visit(commandOf(light));
}

bool contains(const growth::Environment& environment, StimulusKind kind, const std::string& id) {
  bool found = false;
  forEach(environment,
          [&](const StimulusCommand& stimulus) { found = found || (stimulus.kind == kind && stimulus.id == id); });
  return found;
}

/// Beside the tips, out of the way of what grows.
geometry_msgs::Pose besideTips(const Snapshot& snapshot, const MarkerSettings& settings) {
  return toPose({meanTip(snapshot) + settings.scene_size * rod::Vector3::UnitX(), rod::Quaternion::Identity()});
}

}  // namespace

StimulusHandles::StimulusHandles(const std::string& topic, MarkerSettingsPtr settings, Latest latest, Receive receive)
    : settings_(std::move(settings)),
      latest_(std::move(latest)),
      receive_(std::move(receive)),
      server_(topic),
      heartbeat_(kHeartbeat) {
  makeMenus();
  new_pose_ = besideTips(*latest_(), *settings_);
  drawNewHandle();
  show(settings_);
}

void StimulusHandles::makeMenus() {
  const auto change_strength = [this](const std::function<double(double)>& change) {
    return [this, change](const auto& feedback) { setStrength(*feedback, change); };
  };
  const auto strength = menu_.insert("Strength");
  menu_.insert(strength, "Double", change_strength([](double s) { return 2.0 * s; }));
  menu_.insert(strength, "Halve", change_strength([](double s) { return 0.5 * s; }));
  for (const char* preset : {"0.2", "1", "5"}) {
    const double size = std::stod(preset);
    menu_.insert(strength, preset, change_strength([size](double s) { return std::copysign(size, s); }));
  }
  menu_.insert("Attract", change_strength([](double s) { return std::abs(s); }));
  menu_.insert("Repel", change_strength([](double s) { return -std::abs(s); }));
  menu_.insert("Remove", [this](const auto& feedback) { remove(*feedback); });

  new_menu_.insert("Add lamp here", [this](const auto& feedback) {
    add(StimulusKind::point_source, handleVector(StimulusKind::point_source, feedback->pose), *feedback);
  });
  new_menu_.insert("Add light", [this](const auto& feedback) {
    add(StimulusKind::light_direction, rod::Vector3::UnitZ(), *feedback);  // from above, to be turned
  });
}

void StimulusHandles::draw(const std::string& name, const Handle& handle) {
  server_.insert(makeHandle(handle.stimulus, handle.shown, *settings_),
                 [this](const auto& feedback) { onFeedback(*feedback); });
  menu_.apply(server_, name);
}

void StimulusHandles::drawNewHandle() {
  server_.insert(makeNewHandle(new_pose_, *settings_),
                 [this](const auto& feedback) { onNewHandleFeedback(*feedback); });
  new_menu_.apply(server_, names::kNewHandle);
}

void StimulusHandles::show(MarkerSettingsPtr settings) {
  const SnapshotPtr snapshot = latest_();
  eraseGone(*snapshot);
  if (settings != settings_) {
    settings_ = std::move(settings);
    drawNewHandle();
    for (const auto& [name, handle] : handles_) draw(name, handle);
  }
  const rod::Vector3 target = meanTip(*snapshot);
  forEach(snapshot->environment, [&](const StimulusCommand& stimulus) {
    Handle& handle = handles_[handleName(stimulus)];
    if (handle.asked_at != snapshot) follow(stimulus, target, handle);
  });
  // rviz shows nothing before it has heard an update, and those that the server sends of itself stop with ROS time.
  if (heartbeat_.due()) server_.setPose(names::kNewHandle, new_pose_);
  server_.applyChanges();
}

void StimulusHandles::follow(const StimulusCommand& in_force, const rod::Vector3& target, Handle& handle) {
  if (isHeld(handle)) {
    handle.stimulus.strength = in_force.strength;
    return;
  }
  const std::string name = handleName(in_force);
  const bool is_new = handle.stimulus.id.empty();
  handle.stimulus = in_force;
  const geometry_msgs::Pose before = std::exchange(handle.shown, handlePose(in_force, target, *settings_));
  if (is_new) {
    draw(name, handle);
  } else if (handle.shown != before) {
    server_.setPose(name, handle.shown);
  }
}

void StimulusHandles::eraseGone(const Snapshot& snapshot) {
  for (auto entry = handles_.begin(); entry != handles_.end();) {
    const StimulusCommand& stimulus = entry->second.stimulus;
    if (contains(snapshot.environment, stimulus.kind, stimulus.id)) {
      ++entry;
    } else {
      server_.erase(entry->first);
      entry = handles_.erase(entry);
    }
  }
}

bool StimulusHandles::isHeld(const Handle& handle) {
  return handle.is_held && steady_clock::now() < handle.heard_of + kGone;
}

void StimulusHandles::onFeedback(const Feedback& feedback) {
  const auto entry = handles_.find(feedback.marker_name);
  if (entry == handles_.end()) return;
  Handle& handle = entry->second;
  handle.heard_of = steady_clock::now();
  if (feedback.event_type == Feedback::MOUSE_DOWN) handle.is_held = true;
  if (feedback.event_type == Feedback::MOUSE_UP) handle.is_held = false;
  if (feedback.event_type == Feedback::POSE_UPDATE) move(handle, feedback);
}

void StimulusHandles::onNewHandleFeedback(const Feedback& feedback) {
  if (feedback.event_type != Feedback::POSE_UPDATE) return;
  const StimulusCommand lamp{StimulusKind::point_source, StimulusOperation::add, names::kNewHandle,
                             handleVector(StimulusKind::point_source, feedback.pose), 1.0};
  if (findFault(lamp)) {
    receive_(lamp, feedback.header);  // to be refused
    server_.setPose(names::kNewHandle, new_pose_);
  } else {
    new_pose_ = feedback.pose;
  }
}

void StimulusHandles::move(Handle& handle, const Feedback& feedback) {
  StimulusCommand moved = handle.stimulus;
  moved.vector = handleVector(moved.kind, feedback.pose);
  receive_(moved, feedback.header);
  // The server has taken the pose already, and would show it to all.
  if (findFault(moved)) {
    server_.setPose(feedback.marker_name, handle.shown);
    return;
  }
  handle.shown = feedback.pose;
  handle.asked_at = latest_();
  if (feedback.header.frame_id.empty() || feedback.header.frame_id == settings_->frame) handle.stimulus = moved;
}

/// As it was asked to be, or as it is in force since: it may have changed without having been shown.
StimulusCommand StimulusHandles::current(const Handle& handle) const {
  StimulusCommand stimulus = handle.stimulus;
  const SnapshotPtr snapshot = latest_();
  if (handle.asked_at == snapshot) return stimulus;
  forEach(snapshot->environment, [&stimulus](const StimulusCommand& in_force) {
    if (in_force.kind == stimulus.kind && in_force.id == stimulus.id) stimulus = in_force;
  });
  return stimulus;
}

void StimulusHandles::setStrength(const Feedback& feedback, const std::function<double(double)>& change) {
  const auto entry = handles_.find(feedback.marker_name);
  if (entry == handles_.end()) return;
  Handle& handle = entry->second;
  StimulusCommand changed = current(handle);
  changed.strength = change(changed.strength);
  receive_(changed, {});
  if (findFault(changed)) return;
  handle.stimulus = changed;
  handle.asked_at = latest_();
}

void StimulusHandles::remove(const Feedback& feedback) {
  const auto entry = handles_.find(feedback.marker_name);
  if (entry == handles_.end()) return;
  StimulusCommand removed = entry->second.stimulus;
  removed.operation = StimulusOperation::remove;
  receive_(removed, {});
}

void StimulusHandles::add(StimulusKind kind, const rod::Vector3& vector, const Feedback& feedback) {
  const std_msgs::Header header = kind == StimulusKind::point_source ? feedback.header : std_msgs::Header();
  receive_({kind, StimulusOperation::add, freeId(kind), vector, 1.0}, header);
}

std::string StimulusHandles::freeId(StimulusKind kind) {
  const SnapshotPtr snapshot = latest_();
  const char* begin = kind == StimulusKind::point_source ? names::kNewLamp : names::kNewLight;
  std::string id;
  do {
    id = begin + std::to_string(++last_number_);
  } while (contains(snapshot->environment, kind, id));
  return id;
}

}  // namespace sensory_growth::node
