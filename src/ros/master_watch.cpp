#include "sensory_growth/ros/master_watch.h"

#include <XmlRpcClient.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>

#include <optional>
#include <utility>
#include <vector>

namespace sensory_growth::node {
namespace {

using XmlRpc::XmlRpcValue;

/// What the master answers, or nothing if it is out of reach or refuses.
std::optional<XmlRpcValue> askMaster(const std::string& method, const std::vector<XmlRpcValue>& arguments = {}) {
  XmlRpcValue request, response, answer;
  request[0] = ros::this_node::getName();
  for (const XmlRpcValue& argument : arguments) request[request.size()] = argument;
  if (!ros::master::execute(method, request, response, answer, false)) return std::nullopt;
  return answer;
}

std::string textOf(std::optional<XmlRpcValue> answer) {
  return answer ? static_cast<std::string&>(*answer) : std::string();
}

/// Names in a list of pairs of a name and the nodes that it belongs to, as far as this node is among them.
std::set<std::string> ownNames(XmlRpcValue& pairs) {
  std::set<std::string> names;
  for (int i = 0; i < pairs.size(); ++i) {
    XmlRpcValue& nodes = pairs[i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      if (static_cast<std::string&>(nodes[k]) == ros::this_node::getName()) names.insert(pairs[i][0]);
    }
  }
  return names;
}

/// Tells this node, as a master does, who publishes what it subscribes to.
void tellOfPublishers(const std::string& node_address, const std::string& topic, const XmlRpcValue& publishers) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(node_address, host, port)) return;
  XmlRpcValue request, response;
  request[0] = "/master";
  request[1] = topic;
  request[2] = publishers;
  XmlRpc::XmlRpcClient(host.c_str(), static_cast<int>(port), "/").execute("publisherUpdate", request, response);
}

}  // namespace

MasterWatch::State MasterWatch::check() {
  std::optional<XmlRpcValue> system_state = askMaster("getSystemState");
  if (!system_state) return State::unreachable;
  Registrations registrations = registrationsIn(*system_state);
  if (registrations.published.empty() && !known_.published.empty()) {  // a node publishes /rosout at least
    registerAgain();
    ++restarts_;
    return State::registered_again;
  }
  learn(std::move(registrations));
  return State::known;
}

MasterWatch::Registrations MasterWatch::registrationsIn(XmlRpcValue& system_state) {
  return {ownNames(system_state[0]), ownNames(system_state[1]), ownNames(system_state[2])};
}

void MasterWatch::learn(Registrations registrations) {
  if (registrations.published != known_.published || registrations.subscribed != known_.subscribed) {
    std::optional<XmlRpcValue> types = askMaster("getTopicTypes");
    for (int i = 0; types && i < types->size(); ++i) types_[(*types)[i][0]] = static_cast<std::string&>((*types)[i][1]);
  }
  if (node_address_.empty()) node_address_ = textOf(askMaster("lookupNode", {ros::this_node::getName()}));
  if (service_address_.empty() && !registrations.services.empty()) {
    service_address_ = textOf(askMaster("lookupService", {*registrations.services.begin()}));
  }
  known_ = std::move(registrations);
}

void MasterWatch::registerAgain() {
  for (const std::string& topic : known_.published) {
    askMaster("registerPublisher", {topic, types_[topic], node_address_});
  }
  for (const std::string& service : known_.services) {
    askMaster("registerService", {service, service_address_, node_address_});
  }
  for (const std::string& topic : known_.subscribed) {
    const auto publishers = askMaster("registerSubscriber", {topic, types_[topic], node_address_});
    if (publishers) tellOfPublishers(node_address_, topic, *publishers);
  }
}

}  // namespace sensory_growth::node
