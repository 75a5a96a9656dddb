/// The node as a process: what it refuses to start with, and how it ends.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/String.h>

#include <cstdlib>
#include <filesystem>
#include <future>

#include "ros/bag_contents.h"
#include "ros/diagnostics_listener.h"
#include "ros/message_log.h"
#include "ros/node_under_test.h"
#include "ros/process_fixture.h"
#include "ros/service_call.h"

namespace sensory_growth::node::testing {
namespace {

using namespace std::chrono_literals;

TEST_F(Process, ListsAllParameterErrorsAndExitsNonZero) {
  ros::param::del(name_ + "/growth_time_scale");
  set("marker_rate", -1.0);
  set("start_paused", "yes");
  set("real_time_facto", 1.0);
  expectRefusal({"~growth_time_scale is required", "~marker_rate is -1; it must be from 0.1 to 100",
                 "~start_paused is 'yes'; it must be true or false",
                 "~real_time_facto is not a parameter of this node; did you mean ~real_time_factor?"});
}

TEST_F(Process, ListsScenarioAndParameterErrorsTogether) {
  set("scenario", std::string("/nowhere/at_all.yaml"));
  set("stations", -1);
  expectRefusal({"'/nowhere/at_all.yaml', which cannot be read", "~stations is -1"});
}

TEST_F(Process, ListsWhatIsInTheWayOfFilesWithTheRest) {
  const std::string file = directory_ / "taken.bag";
  std::ofstream(file).put('x');
  set("checkpoint_directory", file + "/checkpoints");
  set("record", true);
  set("recording_file", std::string("taken.bag"));
  set("stations", -1);
  expectRefusal({"~stations is -1", file + "/checkpoints: cannot be created: ", file + " exists already"});
}

TEST_F(Process, RefusesAStepThatIsTooLongForRosTime) {
  set("growth_time_scale", 30.0);
  expectRefusal({"takes 2 s of ROS time", "asks for a scale from 60"});
}

TEST_F(Process, RefusesAnotherOwnerOfTheClock) {
  ros::NodeHandle node;
  ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("/clock", 1);
  expectRefusal({"publishes /clock already"});
}

TEST_F(Process, RefusesWallTimeWhenSimulatedTimeIsInUse) {
  set("clock_mode", "wall");
  expectRefusal({"needs /use_sim_time to be false"});
}

TEST_F(Process, RefusesAClockThatNobodyHeeds) {
  ros::param::set("/use_sim_time", false);
  for (const std::string mode : {"publish", "follow"}) {
    set("clock_mode", mode);
    expectRefusal({"needs /use_sim_time to be true"});
  }
  ros::param::set("/use_sim_time", true);
}

TEST_F(Process, InterruptedWhileRunningLeavesAClosedBag) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string file = "interrupted_" + std::to_string(signal) + ".bag";
    set("record", true);
    set("recording_file", file);
    set("real_time_factor", 50.0);
    ChildProcess child = start();
    {
      NodeUnderTest node(name_);
      node.waitForStatus("some steps", [](const Status& s) { return s.step_index >= 20; });
    }
    child.signal(signal);
    EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();

    const std::filesystem::path path = directory_ / file;
    ASSERT_TRUE(std::filesystem::exists(path)) << child.printed();
    EXPECT_FALSE(std::filesystem::exists(path.string() + ".active"));
    const rosbag::Bag bag(path.string());  // throws unless closed and indexed
    EXPECT_EQ(readTopic<std_msgs::String>(bag, name_ + "/scenario").size(), 1u);
    const auto states = readTopic<OrganState>(bag, name_ + "/organs/shoot/state");
    ASSERT_GE(states.size(), 21u);
    for (std::size_t step = 0; step < states.size(); ++step) EXPECT_EQ(states[step].step_index, step);
  }
}

TEST_F(Process, InterruptedWhileTheBagLagsBehindLeavesItClosed) {
  set("scenario", ros::param::param<std::string>("/long_scenario", ""));
  set("record", true);
  set("recording_file", std::string("lagging.bag"));
  set("recording_compression", std::string("bz2"));  // far slower than the simulation
  set("real_time_factor", 0.0);
  ChildProcess child = start();
  {
    NodeUnderTest node(name_);
    node.waitForStatus("a full queue", [](const Status& s) { return s.step_index >= 30; });
  }
  child.signal(SIGHUP);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
  const rosbag::Bag bag((directory_ / "lagging.bag").string());
  EXPECT_GE(readTopic<OrganState>(bag, name_ + "/organs/shoot/state").size(), 31u);
}

TEST_F(Process, KilledWhileRecordingLosesAFifthOfASecondAtMost) {
  ros::param::set("/use_sim_time", false);
  set("clock_mode", std::string("wall"));
  set("growth_time_scale", 3000.0);  // 50 steps a second
  set("scenario", ros::param::param<std::string>("/long_scenario", ""));
  set("record", true);
  set("recording_file", std::string("killed.bag"));
  ChildProcess child = start();
  MessageLog<OrganState> log(name_ + "/organs/shoot/state");
  log.waitForCount(100);
  child.kill();
  ros::param::set("/use_sim_time", true);
  const std::size_t recovered = recoveredStates((directory_ / "killed.bag.active").string());

  // Stamps say when the node began a step. On a busy machine the last may have been long ago, and the test may see it
  // late; what counts is what the node had done since it began a step. It may have been killed in the last that it
  // published, before that was handed to the recording.
  const std::vector<OrganState> published = log.all();
  const ros::Time last = published.at(published.size() - 2).header.stamp;
  const auto is_old = [&](const OrganState& state) { return state.header.stamp < last - ros::Duration(0.2); };
  ASSERT_TRUE(is_old(published.front()));
  for (std::size_t i = 0; is_old(published[i + 1]); ++i) EXPECT_LT(published[i].step_index, recovered);
}

TEST_F(Process, AFullDiskEndsTheRecordingAndNothingElse) {
  set("scenario", ros::param::param<std::string>("/slow_scenario", ""));
  set("start_paused", true);
  set("record", true);
  set("recording_file", std::string("cut_short.bag"));
  set("recording_compression", std::string("none"));
  ChildProcess child = start(1000000);
  NodeUnderTest node(name_);
  DiagnosticsListener diagnostics;
  node.stepTo(200, 0);
  const std::string why = diagnostics.waitFor("recording", "failed: ");
  EXPECT_NE(why.find("File too large"), std::string::npos) << why;
  EXPECT_EQ(node.waitForStatus("the step", [](const Status& s) { return s.step_index == 200; }).recording, "");

  StartRecording::Request again;
  again.file = "again.bag";
  EXPECT_TRUE(node.call<StartRecording>("start_recording", again).success);
  EXPECT_TRUE(node.call<StopRecording>("stop_recording").success);
  diagnostics.waitFor("recording", "off");

  child.signal(SIGINT);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
  EXPECT_NE(child.printed().find("cut_short.bag.active stopped after"), std::string::npos) << child.printed();
  EXPECT_GT(recoveredStates((directory_ / "cut_short.bag.active").string()), 3u);
}

TEST_F(Process, InterruptedWhileAServiceWaitsAnswersIt) {
  set("scenario", ros::param::param<std::string>("/slow_scenario", ""));  // one that can be stepped for ever
  set("start_paused", true);
  ChildProcess child = start();
  {
    NodeUnderTest node(name_);
    auto waiting = std::async(std::launch::async, [&] {
      Step step;
      step.request.steps = 1000000;
      return callService(name_ + "/step", step) && step.response.success;
    });
    node.waitForStatus("a step", [](const Status& s) { return s.step_index >= 1; });
    child.signal(SIGINT);
    EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
    EXPECT_FALSE(waiting.get());
  }
}

TEST_F(Process, InterruptedWhileItWaitsForAClockItEnds) {
  set("clock_mode", std::string("follow"));
  ChildProcess child = start();
  lookUntil("the node to wait", [&] { return child.printed().find("waiting for somebody") != std::string::npos; });
  child.signal(SIGINT);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
}

TEST_F(Process, InterruptedWhileTheClockStandsStillItEnds) {
  set("clock_mode", std::string("follow"));
  ros::NodeHandle handle;
  ros::Publisher publisher = handle.advertise<rosgraph_msgs::Clock>("/clock", 1, true);
  rosgraph_msgs::Clock clock;
  clock.clock = ros::Time(100.0);
  publisher.publish(clock);
  ChildProcess child = start();
  {
    NodeUnderTest node(name_);
    const Status status = node.waitForStatus("running", [](const Status& s) { return s.mode == Status::RUNNING; });
    EXPECT_EQ(status.step_index, 0u);
  }
  child.signal(SIGTERM);
  EXPECT_EQ(child.waitForExit(5s), 0) << child.printed();
}

TEST_F(Process, ASecondOwnerOfTheClockIsReported) {
  set("start_paused", true);
  ChildProcess child = start();
  NodeUnderTest node(name_);
  DiagnosticsListener diagnostics;
  diagnostics.waitFor("clock", "this node alone");
  {
    ros::NodeHandle handle;
    ros::Publisher clock = handle.advertise<rosgraph_msgs::Clock>("/clock", 1);
    diagnostics.waitFor("clock", "another node publishes /clock too");
  }
  diagnostics.waitFor("clock", "this node alone");
  child.signal(SIGINT);
  EXPECT_EQ(child.waitForExit(5s), 0);
  EXPECT_NE(child.printed().find("another node publishes /clock too"), std::string::npos) << child.printed();
}

TEST_F(Process, EndsByItselfWhenFinished) {
  set("exit_when_finished", true);
  set("record", true);
  set("recording_file", std::string("whole.bag"));
  set("real_time_factor", 0.0);
  ChildProcess child = start();
  EXPECT_EQ(child.waitForExit(60s), 0) << child.printed();
  const rosbag::Bag bag((directory_ / "whole.bag").string());
  EXPECT_EQ(readTopic<OrganState>(bag, name_ + "/organs/shoot/state").size(), 241u);  // 4 h of 1 min, and the start
}

}  // namespace
}  // namespace sensory_growth::node::testing
