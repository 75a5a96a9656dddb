#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace sensory_growth::node {

/// Notices that the ROS master does not know of something that this node offers or asks for, and registers it again:
/// all of it once the master was started anew, a topic that was opened while the master was away. roscpp registers only
/// once; without this nobody would find the node any more.
///
/// What the master kept for others is gone all the same: parameters, /use_sim_time among them.
class MasterWatch {
 public:
  enum class State { known, unreachable, registered_again };

  /// Asks the master; may block as long as the network does. From one thread.
  State check();

  /// How often a master had forgotten this node.
  std::uint64_t restarts() const { return restarts_; }

 private:
  std::set<std::string> services_;  // that the master has ever listed; none is withdrawn before the end
  std::uint64_t restarts_ = 0;
};

}  // namespace sensory_growth::node
