#pragma once

#include <XmlRpcValue.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace sensory_growth::node {

/// Notices that the ROS master was started anew and has forgotten this node, and registers again whatever the master
/// knew of it. roscpp registers only once; without this nobody would find the node any more.
///
/// What the master kept for others is gone all the same: parameters, /use_sim_time among them.
class MasterWatch {
 public:
  enum class State { known, unreachable, registered_again };

  /// Asks the master; may block as long as the network does. From one thread.
  State check();

  /// How often the node was registered again.
  std::uint64_t restarts() const { return restarts_; }

 private:
  struct Registrations {
    std::set<std::string> published, subscribed, services;
  };

  static Registrations registrationsIn(XmlRpc::XmlRpcValue& system_state);
  void learn(Registrations registrations);
  void registerAgain();

  Registrations known_;
  std::map<std::string, std::string> types_;  // of all topics
  std::string node_address_;                  // where others ask for topics
  std::string service_address_;               // where others call services
  std::uint64_t restarts_ = 0;
};

}  // namespace sensory_growth::node
