#pragma once

/// Stimuli by hand: in rviz lamps can be dragged and lights turned, and menus add, remove and change them.

#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>

#include <chrono>
#include <functional>
#include <map>
#include <string>

#include "sensory_growth/ros/markers.h"
#include "sensory_growth/ros/snapshot.h"
#include "sensory_growth/ros/wall_throttle.h"
#include "sensory_growth/simulation/stimuli.h"

namespace sensory_growth::node {

/// A handle is where its stimulus is, whoever moved it; only while somebody drags it, it is where the mouse is. All
/// callbacks come from the global queue, which one thread serves; show() is called from it, too.
class StimulusHandles {
 public:
  using Latest = std::function<SnapshotPtr()>;

  /// Takes a command whose vector is in the frame of the header, and refuses it if it makes no sense.
  using Receive = std::function<void(const simulation::StimulusCommand&, const std_msgs::Header&)>;

  /// `topic` is the resolved namespace of the server's topics.
  StimulusHandles(const std::string& topic, MarkerSettingsPtr settings, Latest latest, Receive receive);

  /// Makes the handles those of the stimuli in force, and shows what changed.
  void show(MarkerSettingsPtr settings);

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;

  struct Handle {
    simulation::StimulusCommand stimulus;  // as in force, or as asked for last
    geometry_msgs::Pose shown;
    SnapshotPtr asked_at;  // until there is a newer state, what was asked for is on its way
    bool is_held = false;
    std::chrono::steady_clock::time_point heard_of;
  };

  void makeMenus();
  void draw(const std::string& name, const Handle& handle);
  void drawNewHandle();
  void follow(const simulation::StimulusCommand& in_force, const rod::Vector3& target, Handle& handle);
  void eraseGone(const Snapshot& snapshot);
  static bool isHeld(const Handle& handle);

  void onFeedback(const Feedback& feedback);
  void onNewHandleFeedback(const Feedback& feedback);
  void move(Handle& handle, const Feedback& feedback);
  simulation::StimulusCommand current(const Handle& handle) const;
  void setStrength(const Feedback& feedback, const std::function<double(double)>& change);
  void remove(const Feedback& feedback);
  void add(simulation::StimulusKind kind, const rod::Vector3& vector, const Feedback& feedback);
  std::string freeId(simulation::StimulusKind kind);  // never given before

  MarkerSettingsPtr settings_;
  const Latest latest_;
  const Receive receive_;
  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_, new_menu_;
  std::map<std::string, Handle> handles_;  // by name
  geometry_msgs::Pose new_pose_;           // of the handle that adds
  WallThrottle heartbeat_;
  int last_number_ = 0;  // of a stimulus that was added
};

}  // namespace sensory_growth::node
