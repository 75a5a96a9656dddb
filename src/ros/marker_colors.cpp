#include "sensory_growth/ros/marker_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "sensory_growth/mechanics/fibre_stress.h"

namespace sensory_growth::node {
namespace {

constexpr double kNothing = 1e-6;  // in units of a field: below it there is only rounding

}  // namespace

FieldName describe(MarkerField field) {
  switch (field) {
    case MarkerField::curvature:
      return {"curvature", "1/m", 1.0};
    case MarkerField::growth_rate:
      return {"growth rate", "%/h", 0.01 / 3600.0};
    case MarkerField::stress:
      return {"stress", "kPa", 1e3};
    case MarkerField::stretch:
      return {"stretch", "%", 0.01};
    case MarkerField::age:
      return {"age", "h", 3600.0};
    case MarkerField::none:
      break;
  }
  return {"", "", 1.0};
}

double fieldAt(const OrganSnapshot& organ, std::size_t vertex, MarkerField field) {
  const rod::Rod& rod = organ.rod;
  const std::size_t above = std::min(vertex, rod.size() - 1);
  const std::size_t below = vertex == 0 ? 0 : vertex - 1;
  const auto mean = [&](const auto& of_element) { return 0.5 * (of_element(below) + of_element(above)); };
  switch (field) {
    case MarkerField::curvature:
      return rod.bends[above].curvature.head<2>().norm();
    case MarkerField::growth_rate:
      return mean([&](std::size_t e) { return organ.growth_rates[e]; });
    case MarkerField::stress:
      return mechanics::fibreStress(rod, above);
    case MarkerField::stretch:
      return mean([&](std::size_t e) { return std::abs(rod.elements[e].strain.z()); });
    case MarkerField::age:
      return mean([&](std::size_t e) { return rod.elements[e].age; });
    case MarkerField::none:
      break;
  }
  return 0.0;
}

double colorLimit(const Snapshot& snapshot, MarkerField field, double fixed) {
  if (fixed > 0.0) return fixed;
  const double unit = describe(field).unit_in_si;
  double largest = 0.0;
  for (const OrganSnapshot& organ : snapshot.organs) {
    for (std::size_t v = 0; v <= organ.rod.size(); ++v) largest = std::max(largest, fieldAt(organ, v, field));
  }
  return largest > kNothing * unit ? unit * roundUp(largest / unit) : unit;
}

std::string inUnit(double value, MarkerField field) {
  const FieldName name = describe(field);
  std::ostringstream text;
  text.precision(3);
  text << value / name.unit_in_si << ' ' << name.unit;
  return text.str();
}

double roundUp(double x) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (x <= factor * decade * (1.0 + 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

std_msgs::ColorRGBA viridis(double x) {
  // Nine evenly spaced colours of matplotlib's viridis (van der Walt and Smith 2015).
  static constexpr std::array<std::array<double, 3>, 9> kColors = {{{0.267, 0.005, 0.329},
                                                                    {0.279, 0.175, 0.483},
                                                                    {0.230, 0.322, 0.546},
                                                                    {0.173, 0.449, 0.558},
                                                                    {0.128, 0.567, 0.551},
                                                                    {0.158, 0.684, 0.502},
                                                                    {0.369, 0.789, 0.383},
                                                                    {0.678, 0.864, 0.190},
                                                                    {0.993, 0.906, 0.144}}};
  const double position = std::clamp(x, 0.0, 1.0) * (kColors.size() - 1);
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(position), kColors.size() - 2);
  const double f = position - static_cast<double>(i);
  const auto channel = [&](std::size_t c) {
    return static_cast<float>((1.0 - f) * kColors[i][c] + f * kColors[i + 1][c]);
  };
  std_msgs::ColorRGBA color;
  color.r = channel(0);
  color.g = channel(1);
  color.b = channel(2);
  color.a = 1.0F;
  return color;
}

}  // namespace sensory_growth::node
