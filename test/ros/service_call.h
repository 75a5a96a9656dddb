#pragma once

/// Calling a service from a test.

#include <ros/ros.h>

#include <string>

namespace sensory_growth::node::testing {

/// Over a persistent connection: on one that the server closes after its answer, roscpp's client now and then takes the
/// end of the connection for a failure of the call (ros_comm issue 1976; under load, 3 of 20 000 calls).
template <typename Service>
bool callService(const std::string& name, Service& service) {
  constexpr bool kPersistent = true;
  return ros::NodeHandle().serviceClient<Service>(name, kPersistent).call(service);
}

}  // namespace sensory_growth::node::testing
