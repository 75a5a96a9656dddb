/// playback.launch shows a recorded run: every state in order, under the clock of the player, without a simulation.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <visualization_msgs/MarkerArray.h>

#include <condition_variable>
#include <mutex>
#include <vector>

#include "ros/bag_contents.h"
#include "ros/child_process.h"
#include "ros/marker_lint.h"
#include "ros/player.h"

namespace sensory_growth::node::testing {
namespace {

constexpr std::chrono::seconds kLaunchPatience{45};
constexpr char kStates[] = "/sensory_growth/organs/shoot/state";

/// A run of half an hour of growth, made without a master.
void record(const std::string& bag) {
  ChildProcess batch({BATCH_EXECUTABLE, "run", scenarioFile(), "--duration", "30 min", "--bag", bag, "--quiet"},
                     bag + ".txt");
  ASSERT_EQ(batch.waitForExit(kLaunchPatience), 0) << batch.printed();
}

class Viewer {
 public:
  Viewer()
      : states_topic_(node_.subscribe(kStates, 1000, &Viewer::takeState, this)),
        markers_topic_(node_.subscribe("/sensory_growth/markers", 1000, &Viewer::takeMarkers, this)),
        clock_topic_(node_.subscribe("/clock", 10000, &Viewer::takeClock, this)) {}

  bool isConnected() const {
    return states_topic_.getNumPublishers() == 1 && markers_topic_.getNumPublishers() == 1 &&
           clock_topic_.getNumPublishers() == 1;
  }

  std::vector<OrganState> waitForStates(std::size_t count) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLaunchPatience, [&] { return states_.size() >= count; }))
        << states_.size() << " of " << count << " states";
    return states_;
  }

  void waitForClock(const ros::Time& stamp) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLaunchPatience, [&] { return clock_ >= stamp; })) << clock_;
  }

  void waitForMarkers() {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLaunchPatience, [&] { return scene_.shows("shoot/body"); }));
  }

 private:
  void takeState(const OrganState& state) {
    const std::lock_guard<std::mutex> lock(mutex_);
    states_.push_back(state);
    changed_.notify_all();
  }

  void takeMarkers(const visualization_msgs::MarkerArray& array) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::string& fault : lint(array)) ADD_FAILURE() << fault;
    scene_.take(array);
    changed_.notify_all();
  }

  void takeClock(const rosgraph_msgs::Clock& clock) {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_GE(clock.clock, clock_) << "time went back";
    clock_ = clock.clock;
    changed_.notify_all();
  }

  ros::NodeHandle node_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::vector<OrganState> states_;
  MarkerScene scene_;
  ros::Time clock_;

  ros::Subscriber states_topic_, markers_topic_, clock_topic_;  // last, so that callbacks end before what they touch
};

TEST(Playback, ShowsEveryStateInOrder) {
  const TemporaryBag bag;
  record(bag.path());
  std::vector<OrganState> recorded;
  {
    const rosbag::Bag contents(bag.path());
    recorded = readTopic<OrganState>(contents, kStates);
  }
  ASSERT_EQ(recorded.size(), 31u);

  Viewer viewer;
  ChildProcess launch({"/usr/bin/env", "roslaunch", "sensory_growth", "playback.launch", "bag:=" + bag.path(),
                       "rate:=30", "paused:=true", "headless:=true", "linger:=true"},
                      bag.path() + ".txt");
  startPlaying("/player", kLaunchPatience, [&] { return viewer.isConnected(); });
  ASSERT_FALSE(HasFailure()) << launch.printed();
  const std::vector<OrganState> shown = viewer.waitForStates(recorded.size());
  ASSERT_EQ(shown.size(), recorded.size());
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    EXPECT_EQ(shown[i].step_index, i);
    EXPECT_EQ(shown[i].header.stamp, recorded[i].header.stamp);
    EXPECT_EQ(shown[i].positions, recorded[i].positions);
  }
  viewer.waitForClock(recorded.back().header.stamp);
  viewer.waitForMarkers();
  launch.signal(SIGINT);
  EXPECT_EQ(launch.waitForExit(kLaunchPatience), 0) << launch.printed();
}

}  // namespace
}  // namespace sensory_growth::node::testing
