/// Through the life of a simulation, rviz is sent nothing it would refuse, and shows what there is.

#include <gtest/gtest.h>

#include "ros/marker_lint.h"
#include "ros/node_under_test.h"

namespace sensory_growth::node::testing {
namespace {

class MarkerViewer {
 public:
  explicit MarkerViewer(NodeUnderTest& node)
      : subscriber_(node.handle().subscribe("markers", 100, &MarkerViewer::take, this)) {}

  void waitUntilShown(const std::string& ns) {
    waitUntil(ns + " is shown", [&] { return scene_.shows(ns); });
  }

  void waitUntilGone(const std::string& ns) {
    waitUntil(ns + " is gone", [&] { return !scene_.shows(ns); });
  }

  /// Until everything has been drawn afresh so many times.
  void waitForFreshStart(int times) {
    waitUntil("fresh start", [&] { return fresh_starts_ >= times; });
  }

  int freshStarts() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return fresh_starts_;
  }

 private:
  void take(const visualization_msgs::MarkerArray& array) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::string& fault : lint(array)) ADD_FAILURE() << fault;
    scene_.take(array);
    fresh_starts_ += !array.markers.empty() && array.markers[0].action == visualization_msgs::Marker::DELETEALL;
    changed_.notify_all();
  }

  template <typename Predicate>
  void waitUntil(const std::string& what, const Predicate& holds) {
    std::unique_lock<std::mutex> lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kPatience, holds)) << "waited in vain until " << what;
  }

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  MarkerScene scene_;
  int fresh_starts_ = 0;
  ros::Subscriber subscriber_;  // last, so that callbacks end before what they touch
};

TEST(Markers, PleaseRvizThroughAWholeLife) {
  NodeUnderTest node;
  ros::Publisher lamps = node.handle().advertise<PointSource>("point_source", 10);
  ros::Publisher lights = node.handle().advertise<LightDirection>("light_direction", 10);
  MarkerViewer viewer(node);
  viewer.waitUntilShown("shoot/body");
  viewer.waitUntilShown("shoot/tip");
  viewer.waitUntilShown("legend");

  node.send(lamps, lamp(PointSource::ADD, "lamp", {0.1, 0.0, 0.05}));
  viewer.waitUntilShown("point_source/lamp");
  node.send(lights, light(LightDirection::ADD, "sun", {1.0, 0.0, 0.0}, -0.5));
  viewer.waitUntilShown("light_direction/sun");
  node.stepTo(30, 0);
  node.send(lamps, lamp(PointSource::REMOVE, "lamp", rod::Vector3::Zero()));
  viewer.waitUntilGone("point_source/lamp");

  int fresh = viewer.freshStarts();
  ASSERT_TRUE(node.command("reset").success);
  viewer.waitForFreshStart(++fresh);
  viewer.waitUntilGone("light_direction/sun");

  // No step is short enough for a shoot that grows a thousandfold in a second; the last good state stays to be seen.
  ASSERT_TRUE(node.setParameter("shoot", "growth.rate", 1e3).success);
  EXPECT_FALSE(node.step(1).success);
  node.waitForStatus("a fault", [](const Status& status) { return status.mode == Status::FAULT; });
  node.send(lamps, lamp(PointSource::ADD, "late", {0.1, 0.0, 0.05}));
  viewer.waitUntilShown("point_source/late");
  viewer.waitUntilShown("shoot/body");
  ASSERT_TRUE(node.command("reset").success);
  viewer.waitForFreshStart(++fresh);
  viewer.waitUntilGone("point_source/late");
}

}  // namespace
}  // namespace sensory_growth::node::testing
