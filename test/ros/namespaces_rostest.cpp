/// Several nodes on one ROS system keep out of each other's way.

#include <gtest/gtest.h>
#include <ros/master.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <set>

#include "ros/message_log.h"
#include "ros/node_under_test.h"
#include "ros/service_call.h"

namespace sensory_growth::node::testing {
namespace {

TEST(Namespaces, EachNodeHearsAndMovesAlone) {
  NodeUnderTest a("/a/sensory_growth"), b("/b/sensory_growth");
  ros::Publisher lamps = a.handle().advertise<PointSource>("point_source", 10);
  EXPECT_TRUE(a.send(lamps, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.1})).accepted);
  a.stepTo(5, 0);
  EXPECT_EQ(b.stepTo(2, 0).step_index, 2u);
  EXPECT_EQ(b.appliedCount(), 0u);
}

TEST(Namespaces, StampsOfTheWallClockIncrease) {
  NodeUnderTest a("/a/sensory_growth");
  ros::Time last;
  for (int i = 0; i < 20; ++i) {
    const Step::Response response = a.step(1);
    ASSERT_TRUE(response.success);
    EXPECT_GT(response.stamp, last);
    last = response.stamp;
  }
}

TEST(Namespaces, RemappedTopicsWork) {
  NodeUnderTest b("/b/sensory_growth");
  ros::NodeHandle absolute;
  ros::Publisher lamps = absolute.advertise<PointSource>("/lamps_of_b", 10);  // see namespaces.test
  EXPECT_EQ(b.send(lamps, lamp(PointSource::ADD, "remapped", {0.1, 0.0, 0.1})).id, "remapped");
}

TEST(Namespaces, EveryTopicCanBeRemappedAndServicesToo) {
  const std::string c = "/c/sensory_growth";
  Step step;
  step.request.steps = 3;
  ASSERT_TRUE(ros::service::waitForService("/elsewhere/step", ros::Duration(kPatience.count())));
  ASSERT_TRUE(callService("/elsewhere/step", step) && step.response.success) << step.response.message;

  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  ASSERT_TRUE(ros::master::execute("getSystemState", request, response, state, false));
  std::set<std::string> topics;
  for (int kind = 0; kind < 2; ++kind) {  // publishers, subscribers
    for (int i = 0; i < state[kind].size(); ++i) {
      for (int k = 0; k < state[kind][i][1].size(); ++k) {
        if (static_cast<std::string&>(state[kind][i][1][k]) == c) topics.insert(state[kind][i][0]);
      }
    }
  }
  topics.erase("/rosout");
  EXPECT_EQ(topics.size(), 21u);
  for (const std::string& topic : topics) EXPECT_EQ(topic.rfind("/elsewhere/", 0), 0u) << topic;

  // Whoever comes late gets all that is latched, wherever it is.
  MessageLog<OrganState> states("/elsewhere/state");
  MessageLog<Status> statuses("/elsewhere/status");
  MessageLog<Stimuli> stimuli("/elsewhere/stimuli");
  MessageLog<std_msgs::String> scenario("/elsewhere/scenario"), parameters("/elsewhere/parameters");
  MessageLog<tf2_msgs::TFMessage> fixed("/elsewhere/tf_static");
  MessageLog<visualization_msgs::MarkerArray> markers("/elsewhere/markers");
  states.waitFor("step 3", [](const OrganState& message) { return message.step_index == 3; });
  statuses.waitFor("step 3", [](const Status& message) { return message.step_index == 3; });
  stimuli.waitForCount(1);
  scenario.waitForCount(1);
  parameters.waitForCount(1);
  fixed.waitForCount(1);
  markers.waitForCount(1);
}

TEST(Namespaces, OnlySharedTopicsHaveSeveralPublishers) {
  NodeUnderTest a("/a/sensory_growth"), b("/b/sensory_growth");
  const std::set<std::string> shared = {"/rosout", "/tf", "/tf_static", "/diagnostics"};
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  ASSERT_TRUE(ros::master::execute("getSystemState", request, response, state, false));
  XmlRpc::XmlRpcValue& publishers = state[0];
  for (int i = 0; i < publishers.size(); ++i) {
    const std::string topic = publishers[i][0];
    if (shared.count(topic)) continue;
    EXPECT_LE(publishers[i][1].size(), 1) << topic;
    EXPECT_NE(topic, "/clock");
  }
}

}  // namespace
}  // namespace sensory_growth::node::testing
