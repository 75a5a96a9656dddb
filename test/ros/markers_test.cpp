#include "sensory_growth/ros/markers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ros/marker_lint.h"
#include "ros/snapshots.h"

namespace sensory_growth::node {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

std::shared_ptr<Snapshot> lit() {
  auto snapshot = testing::snapshotOf("stem");
  snapshot->environment.point_sources.push_back({"lamp", {1.1, 2.0, 3.0}, 1.0});
  snapshot->environment.light_directions.push_back({"sun", {0.0, 0.0, 1.0}, 1.0});
  return snapshot;
}

MarkerSettings settingsOf(MarkerShape shape, MarkerField field = MarkerField::curvature) {
  Parameters parameters;
  parameters.marker_style = shape;
  parameters.marker_color = field;
  return makeMarkerSettings(parameters, *lit());
}

const Marker& find(const MarkerArray& array, const std::string& ns, int id = 0) {
  static const Marker kNone;
  const auto found = std::find_if(array.markers.begin(), array.markers.end(),
                                  [&](const Marker& marker) { return marker.ns == ns && marker.id == id; });
  if (found != array.markers.end()) return *found;
  ADD_FAILURE() << "no marker " << ns << " " << id;
  return kNone;
}

TEST(Markers, PleaseRviz) {
  for (const MarkerShape shape : {MarkerShape::tube, MarkerShape::line}) {
    for (const MarkerField field :
         {MarkerField::curvature, MarkerField::growth_rate, MarkerField::stretch, MarkerField::none}) {
      EXPECT_THAT(testing::lint(buildMarkers(*lit(), settingsOf(shape, field))), IsEmpty());
    }
  }
}

TEST(Markers, LintFindsWhatRvizRefuses) {
  MarkerArray array = buildMarkers(*lit(), settingsOf(MarkerShape::line));
  array.markers[0].colors.pop_back();
  array.markers[1].scale.y = 0.0;
  array.markers.push_back(array.markers[1]);
  EXPECT_THAT(testing::lint(array), SizeIs(4));  // colours, scale, the same once more, and twice in one array
}

TEST(Markers, TubeIsAClosedSurfaceThatFacesOutwards) {
  const MarkerArray array = buildMarkers(*lit(), settingsOf(MarkerShape::tube));
  const Marker& tube = find(array, "stem/body");
  // The divergence theorem gives the volume of what the triangles enclose; inwards it would be negative.
  double volume = 0.0;
  const auto at = [&](std::size_t i) {
    return rod::Vector3(tube.points[i].x - 1.0, tube.points[i].y - 2.0, tube.points[i].z - 3.0);
  };
  for (std::size_t i = 0; i < tube.points.size(); i += 3) volume += at(i).dot(at(i + 1).cross(at(i + 2))) / 6.0;
  const double decagon = 5.0 * std::sin(M_PI / 5.0) * 1e-6;  // ten sides in a circle of 1 mm
  EXPECT_NEAR(volume, decagon * 0.04, 1e-12);
}

TEST(Markers, RadiusScaleThickensTheOrgan) {
  MarkerSettings settings = settingsOf(MarkerShape::line);
  settings.radius_scale = 3.0;
  EXPECT_NEAR(find(buildMarkers(*lit(), settings), "stem/body").scale.x, 6e-3, 1e-15);
}

TEST(Markers, StayBoundedForManyElements) {
  auto snapshot = lit();
  const rod::Section section = snapshot->organs[0].rod.elements[0].section;
  snapshot->organs[0].rod = rod::straightRod({}, 1.0, 20000, section);
  snapshot->organs[0].growth_rates.assign(20000, 0.0);
  const MarkerArray lines = buildMarkers(*snapshot, settingsOf(MarkerShape::line));
  EXPECT_LE(find(lines, "stem/body").points.size(), 200u);
  EXPECT_NEAR(find(lines, "stem/body").points.back().z, 1.0, 1e-12);
  EXPECT_THAT(testing::lint(lines), IsEmpty());
}

TEST(Markers, LampAndLightAreWhereTheyShine) {
  const MarkerArray array = buildMarkers(*lit(), settingsOf(MarkerShape::tube));
  const Marker& lamp = find(array, "point_source/lamp");
  EXPECT_EQ(lamp.pose.position.x, 1.1);
  EXPECT_EQ(find(array, "point_source/lamp", 1).text, "lamp");
  const Marker& arrow = find(array, "light_direction/sun");
  ASSERT_THAT(arrow.points, SizeIs(2));
  EXPECT_GT(arrow.points[0].z, arrow.points[1].z);  // light from above travels down
  EXPECT_GT(arrow.points[1].z, 3.04);               // and stops before the tip
}

/// The organ of lit(), which stands on (1, 2, 3) and is 0.04 m long, with everything that can hold it.
std::shared_ptr<Snapshot> held() {
  auto snapshot = lit();
  mechanics::Surroundings& surroundings = snapshot->organs[0].surroundings;
  surroundings.walls = {{{0.0, 0.0, 2.99}, {0.0, 0.0, 1.0}, 5.0}, {{1.01, 9.0, 9.0}, {-1.0, 0.0, 0.0}}};
  surroundings.springs = {{0.5, {1.02, 2.0, 3.02}, 7.0}};
  surroundings.held_apex = mechanics::HeldApex{{1.0, 2.0, 3.04}, {}};
  return snapshot;
}

TEST(Markers, WallsSpringsAndHeldApexAreWhereTheyHold) {
  const MarkerArray array = buildMarkers(*held(), settingsOf(MarkerShape::tube));
  EXPECT_THAT(testing::lint(array), IsEmpty());

  const Marker& floor = find(array, "stem/wall", 0);
  EXPECT_NEAR(floor.pose.position.x, 1.0, 1e-12);  // below the base, wherever the point of the plane is
  EXPECT_NEAR(floor.pose.position.z + 0.5 * floor.scale.z, 2.99, 1e-12);
  EXPECT_GT(floor.scale.x, 0.08);  // the organ may lie down either way
  EXPECT_LT(floor.color.a, 0.5F);
  const Marker& side = find(array, "stem/wall", 1);
  EXPECT_NEAR(side.pose.position.x - 0.5 * side.scale.z, 1.01, 1e-12);
  EXPECT_NEAR(std::abs(side.pose.orientation.y), std::sqrt(0.5), 1e-12);  // a quarter turn about y

  const Marker& tie = find(array, "stem/spring");
  ASSERT_THAT(tie.points, SizeIs(2));
  EXPECT_NEAR(tie.points[0].z, 3.02, 1e-12);
  EXPECT_NEAR(tie.points[1].x, 1.02, 1e-12);
  EXPECT_NEAR(find(array, "stem/held_apex").pose.position.z, 3.04, 1e-12);
}

TEST(MarkerStream, DeletesWhatIsGoneAndStartsAfreshAfterAReset) {
  MarkerStream stream;
  const MarkerSettings settings = settingsOf(MarkerShape::tube);
  auto snapshot = lit();
  const MarkerArray first = stream.next(*snapshot, settings);
  EXPECT_EQ(first.markers.front().action, Marker::DELETEALL);
  EXPECT_THAT(testing::lint(first), IsEmpty());

  snapshot->environment.point_sources.clear();
  const MarkerArray second = stream.next(*snapshot, settings);
  EXPECT_EQ(find(second, "point_source/lamp", 0).action, Marker::DELETE);
  EXPECT_EQ(find(second, "point_source/lamp", 1).action, Marker::DELETE);
  EXPECT_EQ(find(second, "light_direction/sun").action, Marker::ADD);
  EXPECT_THAT(testing::lint(second), IsEmpty());

  const MarkerArray third = stream.next(*snapshot, settings);
  for (const Marker& marker : third.markers) EXPECT_EQ(marker.action, Marker::ADD) << marker.ns;

  snapshot->epoch = 1;
  EXPECT_EQ(stream.next(*snapshot, settings).markers.front().action, Marker::DELETEALL);
}

TEST(Viridis, GrowsLighter) {
  const auto luminance = [](double x) {
    const auto c = viridis(x);
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
  };
  for (int i = 0; i < 20; ++i) EXPECT_LT(luminance(i / 20.0), luminance((i + 1) / 20.0)) << i;
  EXPECT_EQ(luminance(-1.0), luminance(0.0));
  EXPECT_EQ(luminance(2.0), luminance(1.0));
}

}  // namespace
}  // namespace sensory_growth::node
