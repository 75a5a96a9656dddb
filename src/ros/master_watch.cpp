#include "sensory_growth/ros/master_watch.h"

#include <XmlRpcClient.h>
#include <XmlRpcValue.h>
#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <map>
#include <optional>
#include <vector>

namespace sensory_growth::node {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue requestOf(const std::vector<XmlRpcValue>& arguments) {
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  for (const XmlRpcValue& argument : arguments) request[request.size()] = argument;
  return request;
}

/// What the master answers, or nothing if it is out of reach or refuses.
std::optional<XmlRpcValue> askMaster(const std::string& method, const std::vector<XmlRpcValue>& arguments = {}) {
  XmlRpcValue response, answer;
  if (!ros::master::execute(method, requestOf(arguments), response, answer, false)) return std::nullopt;
  return answer;
}

/// Where others ask this node for topics.
const std::string& nodeAddress() { return ros::XMLRPCManager::instance()->getServerURI(); }

/// Where others call services of this node.
std::string serviceAddress() {
  return "rosrpc://" + ros::network::getHost() + ":" + std::to_string(ros::ConnectionManager::instance()->getTCPPort());
}

/// What this node answers to tools and masters, or nothing if it is shutting down.
std::optional<XmlRpcValue> askNode(const std::string& method, const std::vector<XmlRpcValue>& arguments = {}) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(nodeAddress(), host, port)) return std::nullopt;
  XmlRpcValue response;
  XmlRpc::XmlRpcClient node(host.c_str(), static_cast<int>(port), "/");
  if (!node.execute(method.c_str(), requestOf(arguments), response) || node.isFault()) return std::nullopt;
  return response[2];  // after a code and a message
}

/// Topics with their types: those that "getPublications" or "getSubscriptions" of this node lists.
std::map<std::string, std::string> topicsOf(const std::string& method) {
  std::map<std::string, std::string> types;
  std::optional<XmlRpcValue> pairs = askNode(method);
  for (int i = 0; pairs && i < pairs->size(); ++i) {
    types[(*pairs)[i][0]] = static_cast<std::string&>((*pairs)[i][1]);
  }
  return types;
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

void publishAgain(const std::set<std::string>& listed) {
  for (const auto& [topic, type] : topicsOf("getPublications")) {
    if (!listed.count(topic)) askMaster("registerPublisher", {topic, type, nodeAddress()});
  }
}

void subscribeAgain(const std::set<std::string>& listed) {
  for (const auto& [topic, type] : topicsOf("getSubscriptions")) {
    if (listed.count(topic)) continue;
    const auto publishers = askMaster("registerSubscriber", {topic, type, nodeAddress()});
    if (publishers) askNode("publisherUpdate", {topic, *publishers});  // as a master tells
  }
}

void serveAgain(const std::set<std::string>& services, const std::set<std::string>& listed) {
  for (const std::string& service : services) {
    if (!listed.count(service)) askMaster("registerService", {service, serviceAddress(), nodeAddress()});
  }
}

}  // namespace

MasterWatch::State MasterWatch::check() {
  std::optional<XmlRpcValue> listed = askMaster("getSystemState");
  if (!listed) return State::unreachable;
  const std::set<std::string> services = ownNames((*listed)[2]);
  services_.insert(services.begin(), services.end());
  publishAgain(ownNames((*listed)[0]));
  subscribeAgain(ownNames((*listed)[1]));
  serveAgain(services_, services);  // last, so that whoever finds a service finds everything
  // Topics come with organs, perhaps before this was called; services are offered once, at the start.
  const bool was_forgotten = services.empty() && !services_.empty();
  if (!was_forgotten) return State::known;
  ++restarts_;
  return State::registered_again;
}

}  // namespace sensory_growth::node
