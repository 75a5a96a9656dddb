#pragma once

/// Services that always answer: what went wrong is said in the answer.

#include <ros/advertise_service_options.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "sensory_growth/ros/simulation_loop.h"

namespace sensory_growth::node {

template <typename Response>
void fill(const Answer& answer, Response& response) {
  response.success = answer.success;
  response.message = answer.message;
  response.step_index = answer.step_index;
  response.stamp = answer.stamp;
}

/// Calls handler(request, response) from the queue.
template <typename Service, typename Handler>
ros::ServiceServer serve(ros::NodeHandle& node, const char* name, ros::CallbackQueue& queue, const Handler& handler) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  ros::AdvertiseServiceOptions options;
  options.init<Request, Response>(node.resolveName(name), [handler](Request& request, Response& response) {
    handler(request, response);
    return true;  // false would hide the reason from the caller
  });
  options.callback_queue = &queue;
  return node.advertiseService(options);
}

}  // namespace sensory_growth::node
