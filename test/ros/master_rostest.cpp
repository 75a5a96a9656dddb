/// The ROS master ends and begins again; the node goes on and can be found again. Seen with the tools of ROS, because
/// this test, like any node, knows one master only, that of rostest.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <ros/xmlrpc_manager.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <future>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ros/process_fixture.h"
#include "sensory_growth/SpawnOrgan.h"
#include "support/spawned_organ.h"

namespace sensory_growth::node::testing {
namespace {

using namespace std::chrono_literals;

sockaddr_in localAddress(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

int freePort() {
  const int socket_number = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = localAddress(0);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(socket_number, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(socket_number, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(socket_number);
  return ntohs(address.sin_port);
}

bool answers(int port) {
  const int socket_number = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = localAddress(port);
  const bool connected = connect(socket_number, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(socket_number);
  return connected;
}

class Master : public Process {
 protected:
  Master() : port_(freePort()) {
    setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + std::to_string(port_)).c_str(), 1);  // of what is started here
  }

  ChildProcess startMaster() {
    ChildProcess master({"/usr/bin/env", "rosmaster", "--core", "-p", std::to_string(port_)}, output("master"));
    lookUntil("the master", [this] { return answers(port_); });
    return master;
  }

  ChildProcess startNode() {
    return ChildProcess({NODE_EXECUTABLE, "__name:=orphan", "_scenario:=" + scenarioFile(), "_growth_time_scale:=60",
                         "_clock_mode:=wall", "_start_paused:=true"},
                        output("node"));
  }

  /// What a tool prints.
  std::string tool(std::vector<std::string> command) {
    command.insert(command.begin(), "/usr/bin/env");
    ChildProcess child(command, output("tool"));
    child.waitForExit(kPatience);
    return child.printed();
  }

  /// Whether `name list` of the tools has that line.
  bool has(const std::string& name, const std::string& line) { return lines({name, "list"}).count(line) > 0; }

  /// The same, whatever the order of its lines.
  std::set<std::string> lines(const std::vector<std::string>& command) {
    std::istringstream printed(tool(command));
    std::set<std::string> lines;
    for (std::string line; std::getline(printed, line);) lines.insert(line);
    return lines;
  }

  /// Lets this test call a service of the node whatever becomes of the node's master: tells the master of this test.
  template <typename Service>
  ros::ServiceClient clientOf(const std::string& service) {
    std::string address = tool({"rosservice", "uri", service});
    address.erase(address.find_last_not_of('\n') + 1);
    XmlRpc::XmlRpcValue request, response, answer;
    request[0] = "/orphan";
    request[1] = service;
    request[2] = address;
    request[3] = ros::XMLRPCManager::instance()->getServerURI();
    EXPECT_TRUE(ros::master::execute("registerService", request, response, answer, false));
    return ros::NodeHandle().serviceClient<Service>(service, true);  // persistent: see service_call.h
  }

  static SpawnOrgan spawn(const std::string& organ) {
    SpawnOrgan service;
    service.request.organ = support::organText(organ);
    return service;
  }

  std::string output(const std::string& name) const { return directory_ / (name + ".txt"); }

  const int port_;
};

TEST_F(Master, ANodeOutlivesTheMasterAndIsFoundAgain) {
  const auto steps = [this](const std::string& wanted) {
    const std::string printed = tool({"rosservice", "call", "/orphan/step", "1"});
    return printed.find("step_index: " + wanted + "\n") != std::string::npos;
  };
  ChildProcess first = startMaster();
  ChildProcess node = startNode();
  lookUntil("the service", [&] { return lines({"rosservice", "list"}).count("/orphan/step") > 0; });
  EXPECT_TRUE(steps("1"));
  const std::set<std::string> services = lines({"rosservice", "list"});
  const std::set<std::string> topics = lines({"rostopic", "list", "-v"});
  first.kill();

  ChildProcess second = startMaster();
  lookUntil("the services again", [&] { return lines({"rosservice", "list"}) == services; });
  // Everything as before, types included; whoever comes late gets what is latched, and is heard.
  EXPECT_TRUE(steps("2"));
  EXPECT_EQ(lines({"rostopic", "list", "-v"}), topics);
  EXPECT_NE(tool({"rostopic", "echo", "-n", "1", "/orphan/status"}).find("step_index: 2\n"), std::string::npos);
  tool({"rostopic", "pub", "-1", "/orphan/point_source", "sensory_growth/PointSource",
        "{operation: 1, id: lamp, position: {x: 0.1, z: 0.1}, strength: 1}"});
  EXPECT_NE(tool({"rostopic", "echo", "-n", "1", "/orphan/stimuli"}).find("id: \"lamp\"\n"), std::string::npos);

  node.signal(SIGINT);
  EXPECT_EQ(node.waitForExit(5s), 0) << node.printed();
  EXPECT_NE(node.printed().find("the master was started anew"), std::string::npos) << node.printed();
}

TEST_F(Master, WhatCameWhileTheMasterWasAwayIsFound) {
  ChildProcess first = startMaster();
  ChildProcess node = startNode();
  lookUntil("the service", [this] { return has("rosservice", "/orphan/spawn_organ"); });
  ros::ServiceClient spawn_organ = clientOf<SpawnOrgan>("/orphan/spawn_organ");
  lookUntil("a check of the master", [&] {
    return tool({"rostopic", "echo", "-n", "1", "/diagnostics"}).find("message: \"registered\"") != std::string::npos;
  });
  std::set<std::string> topics = lines({"rostopic", "list"});
  const std::set<std::string> services = lines({"rosservice", "list"});
  first.kill();
  SpawnOrgan away = spawn("away"), early = spawn("early");
  ASSERT_TRUE(spawn_organ.call(away) && away.response.success) << away.response.message;

  // One topic is registered with the new master before the node knows that it is new.
  ChildProcess second = startMaster();
  ASSERT_TRUE(spawn_organ.call(early) && early.response.success) << early.response.message;
  lookUntil("the services again", [&] { return lines({"rosservice", "list"}) == services; });
  for (const char* organ : {"away", "early"}) topics.insert(std::string("/orphan/organs/") + organ + "/state");
  EXPECT_EQ(lines({"rostopic", "list"}), topics);
  EXPECT_EQ(tool({"rostopic", "type", "/orphan/organs/away/state"}), "sensory_growth/OrganState\n");
}

TEST_F(Master, WithoutAMasterANodeIsControlledAndEnds) {
  ChildProcess master = startMaster();
  ChildProcess node = startNode();
  lookUntil("the service", [this] { return has("rosservice", "/orphan/step"); });
  ros::ServiceClient spawn_organ = clientOf<SpawnOrgan>("/orphan/spawn_organ");
  ros::ServiceClient step = clientOf<Step>("/orphan/step");
  master.kill();
  auto answers = std::async(std::launch::async, [&] {
    SpawnOrgan late = spawn("late");
    Step one;
    one.request.steps = 1;
    return spawn_organ.call(late) && late.response.success && step.call(one) && one.response.success;
  });
  const bool are_in_time = answers.wait_for(5s) == std::future_status::ready;
  EXPECT_TRUE(are_in_time);
  if (are_in_time) {
    EXPECT_TRUE(answers.get());
  }
  node.signal(SIGINT);
  EXPECT_EQ(node.waitForExit(5s), 0) << node.printed();
  node.kill();  // if it still runs, nobody will answer
}

TEST_F(Master, ANodeWithoutAMasterEnds) {
  ChildProcess master = startMaster();
  ChildProcess node = startNode();
  lookUntil("the service", [this] { return has("rosservice", "/orphan/step"); });
  master.kill();
  node.signal(SIGTERM);
  EXPECT_EQ(node.waitForExit(5s), 0) << node.printed();
}

}  // namespace
}  // namespace sensory_growth::node::testing
