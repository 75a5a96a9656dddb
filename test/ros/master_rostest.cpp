/// The ROS master ends and begins again; the node goes on and can be found again. Seen with the tools of ROS, because
/// this test, like any node, knows one master only.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ros/process_fixture.h"

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

  /// The same, whatever the order of its lines.
  std::set<std::string> lines(const std::vector<std::string>& command) {
    std::istringstream printed(tool(command));
    std::set<std::string> lines;
    for (std::string line; std::getline(printed, line);) lines.insert(line);
    return lines;
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
  lookUntil("the service", [&] { return steps("1"); });
  const std::set<std::string> services = lines({"rosservice", "list"});
  const std::set<std::string> topics = lines({"rostopic", "list", "-v"});
  first.kill();

  ChildProcess second = startMaster();
  lookUntil("the service again", [&] { return steps("2"); });
  // Everything as before, types included; whoever comes late gets what is latched, and is heard.
  EXPECT_EQ(lines({"rosservice", "list"}), services);
  EXPECT_EQ(lines({"rostopic", "list", "-v"}), topics);
  EXPECT_NE(tool({"rostopic", "echo", "-n", "1", "/orphan/status"}).find("step_index: 2\n"), std::string::npos);
  tool({"rostopic", "pub", "-1", "/orphan/point_source", "sensory_growth/PointSource",
        "{operation: 1, id: lamp, position: {x: 0.1, z: 0.1}, strength: 1}"});
  EXPECT_NE(tool({"rostopic", "echo", "-n", "1", "/orphan/stimuli"}).find("id: \"lamp\"\n"), std::string::npos);

  node.signal(SIGINT);
  EXPECT_EQ(node.waitForExit(5s), 0) << node.printed();
  EXPECT_NE(node.printed().find("the master was started anew"), std::string::npos) << node.printed();
}

TEST_F(Master, ANodeWithoutAMasterEnds) {
  ChildProcess master = startMaster();
  ChildProcess node = startNode();
  lookUntil("the service", [this] { return tool({"rosservice", "list"}).find("/orphan/step\n") != std::string::npos; });
  master.kill();
  node.signal(SIGTERM);
  EXPECT_EQ(node.waitForExit(5s), 0) << node.printed();
}

}  // namespace
}  // namespace sensory_growth::node::testing
