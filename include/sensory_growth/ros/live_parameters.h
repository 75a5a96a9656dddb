#pragma once

/// Parameters that change while the node runs, by the protocol of dynamic_reconfigure: dynparam and rqt_reconfigure
/// speak it. Its own server would keep a second list of the parameters and their limits, and take no notice of what is
/// not in it.

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <functional>
#include <mutex>

#include "sensory_growth/ros/parameters.h"

namespace sensory_growth::node {

/// Names and values of the parameters that may change.
dynamic_reconfigure::Config toConfig(const Parameters& parameters);

/// The same with their types and limits; `parameters` are those at the start.
dynamic_reconfigure::ConfigDescription describeLive(const Parameters& parameters);

/// A request as the parameter server would keep it.
XmlRpc::XmlRpcValue toTree(const dynamic_reconfigure::Config& config);

class LiveParameters {
 public:
  /// Takes changed parameters into use; returns when they are.
  using Use = std::function<void(const Parameters& before, const Parameters& now)>;

  /// Serves from the queue. The functions are called on its thread.
  LiveParameters(const Parameters& parameters, ros::NodeHandle private_node, ros::CallbackQueue& queue, Use use);

  /// Takes all changes into use, or none if there is a problem with one of them, which is logged. Returns the problems.
  /// On the thread of the queue.
  std::vector<std::string> change(const XmlRpc::XmlRpcValue& changes);

  /// Those in effect. From any thread.
  Parameters now() const;

 private:
  const Use use_;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer service_;

  mutable std::mutex mutex_;  // guards what follows; nothing else is locked while it is held
  Parameters parameters_;
};

}  // namespace sensory_growth::node
