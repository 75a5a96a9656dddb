#include "sensory_growth/ros/markers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ros/marker_lint.h"
#include "ros/snapshots.h"
#include "sensory_growth/ros/marker_colors.h"

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
    for (const MarkerField field : {MarkerField::curvature, MarkerField::growth_rate, MarkerField::stress,
                                    MarkerField::stretch, MarkerField::age, MarkerField::none}) {
      EXPECT_THAT(testing::lint(buildMarkers(*lit(), settingsOf(shape, field))), IsEmpty());
    }
  }
}

TEST(Markers, LintFindsWhatRvizRefuses) {
  const auto faults_after = [](const auto& spoil) {
    MarkerArray array = buildMarkers(*lit(), settingsOf(MarkerShape::line));
    spoil(array);
    return testing::lint(array);
  };
  Marker delete_all;
  delete_all.header.frame_id = "world";
  delete_all.header.stamp = ros::Time(1);
  delete_all.action = Marker::DELETEALL;
  const auto line = [](MarkerArray& array) -> Marker& { return array.markers[0]; };
  const auto tip = [](MarkerArray& array) -> Marker& { return array.markers[1]; };
  const auto label = [](MarkerArray& array) -> Marker& { return array.markers.back(); };
  EXPECT_THAT(faults_after([&](auto& a) { line(a).colors.pop_back(); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { line(a).colors[1].g = NAN; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { line(a).points[1].x = NAN; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { line(a).points.resize(1), line(a).colors.resize(1); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { line(a).points.resize(16385), line(a).colors.clear(); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).scale.y = 0.0; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).color.a = 0.0F; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).pose.orientation.w *= 2.0; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).lifetime = ros::Duration(1.0); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).header.frame_id = "/world"; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { tip(a).header.stamp = ros::Time(); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { label(a).text = " "; }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { a.markers.push_back(tip(a)); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { a.markers.push_back(delete_all); }), SizeIs(1));
  EXPECT_THAT(faults_after([&](auto& a) { a.markers.insert(a.markers.begin(), delete_all); }), IsEmpty());
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

/// Two straight organs, one of which grows.
std::shared_ptr<Snapshot> pair() {
  auto snapshot = lit();
  snapshot->organs.push_back(testing::straightOrgan("grass"));
  snapshot->organs[1].growth_rates.assign(4, 0.0);
  return snapshot;
}

TEST(MarkerColors, AreOfOneScaleForAllOrgans) {
  const MarkerSettings settings = settingsOf(MarkerShape::line, MarkerField::growth_rate);
  const MarkerArray array = buildMarkers(*pair(), settings);
  EXPECT_EQ(find(array, "grass/body").colors.back(), viridis(0.0));
  // The fastest grows by 4e-6 1/s, which is 1.44 %/h.
  const double limit = 0.02 / 3600.0;
  EXPECT_EQ(find(array, "stem/body").colors.back(), viridis(4e-6 / limit));
  EXPECT_EQ(find(array, "legend", 2).text, "2 %/h");
  EXPECT_EQ(find(array, "legend", 3).text, "growth rate");
}

TEST(MarkerColors, FollowAFixedLimitAndSaturate) {
  MarkerSettings settings = settingsOf(MarkerShape::line, MarkerField::growth_rate);
  settings.color_limit = 2e-6;
  const MarkerArray array = buildMarkers(*pair(), settings);
  EXPECT_EQ(find(array, "stem/body").colors.back(), viridis(1.0));
  EXPECT_EQ(find(array, "legend", 2).text, "0.72 %/h");
}

TEST(MarkerColors, ShowStressAndAge) {
  auto snapshot = lit();
  rod::Rod& rod = snapshot->organs[0].rod;
  rod.bends[2].curvature = {0.0, 30.0, 0.0};
  rod.elements[1].age = rod.elements[2].age = 7200.0;
  // Navier: E R kappa.
  EXPECT_NEAR(fieldAt(snapshot->organs[0], 2, MarkerField::stress), 1e7 * 1e-3 * 30.0, 1e-6);
  EXPECT_NEAR(fieldAt(snapshot->organs[0], 1, MarkerField::stress), 0.0, 1e-6);
  EXPECT_EQ(fieldAt(snapshot->organs[0], 2, MarkerField::age), 7200.0);
  const auto legend = [&](MarkerField field) {
    return find(buildMarkers(*snapshot, settingsOf(MarkerShape::tube, field)), "legend", 2).text;
  };
  EXPECT_EQ(legend(MarkerField::stress), "500 kPa");
  EXPECT_EQ(legend(MarkerField::age), "2 h");
}

TEST(MarkerColors, AStraightOrganIsNotColouredByRounding) {
  auto snapshot = lit();
  snapshot->organs[0].rod.bends[1].curvature = {1e-15, 0.0, 0.0};
  const MarkerArray array = buildMarkers(*snapshot, settingsOf(MarkerShape::line));
  EXPECT_EQ(find(array, "legend", 2).text, "1 1/m");
  for (const auto& color : find(array, "stem/body").colors) EXPECT_NEAR(color.g, viridis(0.0).g, 1e-6);
}

TEST(MarkerColors, LegendRangesOverTheMapAndStandsBesideTheOrgans) {
  const MarkerArray array = buildMarkers(*lit(), settingsOf(MarkerShape::tube));
  const Marker& column = find(array, "legend");
  EXPECT_EQ(column.colors.front(), viridis(0.0));
  EXPECT_EQ(column.colors.back(), viridis(1.0));
  for (const auto& point : column.points) EXPECT_LT(point.x, 0.98);  // the organ stands at 1
  const MarkerArray plain = buildMarkers(*lit(), settingsOf(MarkerShape::tube, MarkerField::none));
  for (const Marker& marker : plain.markers) EXPECT_NE(marker.ns, "legend");
}

TEST(MarkerColors, RoundUpTo125) {
  for (const auto& [x, up] : {std::pair{1.0, 1.0}, {1.01, 2.0}, {2.0, 2.0}, {0.03, 0.05}, {7.0, 10.0}, {500.0, 500.0}})
    EXPECT_NEAR(roundUp(x), up, 1e-12 * up) << x;
}

TEST(Markers, AGlowShowsWhichTissueIsASource) {
  auto snapshot = lit();
  growth::PointSource& source = snapshot->organs[0].source.emplace();
  source.position = {1.0, 2.0, 3.03};
  source.strength = -1.0;
  const MarkerArray array = buildMarkers(*snapshot, settingsOf(MarkerShape::tube));
  const Marker& glow = find(array, "stem/source");
  EXPECT_EQ(glow.pose.position.z, 3.03);
  EXPECT_LT(glow.color.a, 0.5F);
  EXPECT_GT(glow.color.b, glow.color.r);  // blue repels
  EXPECT_THAT(testing::lint(array), IsEmpty());
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
