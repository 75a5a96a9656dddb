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

TEST(MarkerStream, DeletesWhatIsGoneAndStartsAfreshAfterAReset) {
  MarkerStream stream(settingsOf(MarkerShape::tube));
  auto snapshot = lit();
  const MarkerArray first = stream.next(*snapshot);
  EXPECT_EQ(first.markers.front().action, Marker::DELETEALL);
  EXPECT_THAT(testing::lint(first), IsEmpty());

  snapshot->environment.point_sources.clear();
  const MarkerArray second = stream.next(*snapshot);
  EXPECT_EQ(find(second, "point_source/lamp", 0).action, Marker::DELETE);
  EXPECT_EQ(find(second, "point_source/lamp", 1).action, Marker::DELETE);
  EXPECT_EQ(find(second, "light_direction/sun").action, Marker::ADD);
  EXPECT_THAT(testing::lint(second), IsEmpty());

  const MarkerArray third = stream.next(*snapshot);
  for (const Marker& marker : third.markers) EXPECT_EQ(marker.action, Marker::ADD) << marker.ns;

  snapshot->epoch = 1;
  EXPECT_EQ(stream.next(*snapshot).markers.front().action, Marker::DELETEALL);
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
