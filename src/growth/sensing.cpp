#include "sensory_growth/growth/sensing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sensory_growth/growth/differential_growth.h"

namespace sensory_growth::growth {
namespace {

/// The interval of rising grid points, at least two, in which x lies, and how far: 0 or 1 beyond the ends.
struct Interval {
  std::size_t lower;
  double fraction;
};

Interval locate(const std::vector<double>& grid, double x) {
  const auto above = std::upper_bound(grid.begin() + 1, grid.end() - 1, x);
  const auto lower = static_cast<std::size_t>(above - grid.begin()) - 1;
  return {lower, std::clamp((x - grid[lower]) / (grid[lower + 1] - grid[lower]), 0.0, 1.0)};
}

double interpolate(const std::vector<double>& grid, const std::vector<double>& values, double x) {
  if (grid.size() == 1) return values.front();
  const Interval in = locate(grid, x);
  return (1.0 - in.fraction) * values[in.lower] + in.fraction * values[in.lower + 1];
}

Eigen::Vector2d readBetween(const rod::Rod& rod, const SectionField& field, double s) {
  std::size_t e = 0;
  while (e + 1 < rod.size() && s > rod.elements[e].rest_length) s -= rod.elements[e++].rest_length;
  const double x = std::clamp(s / rod.elements[e].rest_length, 0.0, 1.0);
  return (1.0 - x) * field[e] + x * field[e + 1];
}

Eigen::Vector2d readAtLabel(const rod::Rod& rod, const SectionField& field, double label) {
  const auto below = [](const rod::Vertex& vertex, double l) { return vertex.label < l; };
  const auto above = std::lower_bound(rod.vertices.begin() + 1, rod.vertices.end() - 1, label, below);
  const auto e = static_cast<std::size_t>(above - rod.vertices.begin()) - 1;
  const double lower = rod.vertices[e].label;
  const double x = (label - lower) / (above->label - lower);
  return (1.0 - x) * field[e] + x * field[e + 1];
}

bool rises(const std::vector<double>& grid) {
  const auto does_not = [](double a, double b) { return !(b > a); };
  return std::adjacent_find(grid.begin(), grid.end(), does_not) == grid.end();
}

bool areFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

struct FindSpreadFault {
  std::optional<Fault> operator()(const FadingSpread& spread) const {
    if (spread.length > 0.0 && std::isfinite(spread.length)) return std::nullopt;
    return Fault{"length", "must be > 0 m"};
  }

  std::optional<Fault> operator()(const SampledSpread& spread) const {
    const std::vector<double>& labels = spread.labels;
    if (labels.size() < 2 || !rises(labels) || labels.front() != 0.0 || labels.back() != 1.0) {
      return Fault{"labels", "must rise from 0 to 1"};
    }
    const auto count = static_cast<Eigen::Index>(labels.size());
    if (spread.densities.rows() != count || spread.densities.cols() != count) {
      return Fault{"densities", "must have as many rows and columns as there are labels"};
    }
    if (!spread.densities.allFinite()) return Fault{"densities", "must be finite"};
    return std::nullopt;
  }
};

struct SpreadOut {
  const rod::Rod& rod;
  const SectionField& field;
  SectionField& sum;

  /// Sweeps from end to end: what has arrived at a vertex fades on the way to the next, while the element adds its own.
  void operator()(const FadingSpread& spread) const {
    const bool both = spread.direction == FadingSpread::Direction::both;
    const double share = both ? 0.5 : 1.0;
    if (both || spread.direction == FadingSpread::Direction::basipetal) {
      Eigen::Vector2d arriving = Eigen::Vector2d::Zero();
      for (std::size_t e = rod.size(); e-- > 0;) {
        arriving = passed(arriving, field[e + 1], field[e], rod.elements[e].rest_length / spread.length);
        sum[e] += share * arriving;
      }
    }
    if (both || spread.direction == FadingSpread::Direction::acropetal) {
      Eigen::Vector2d arriving = Eigen::Vector2d::Zero();
      for (std::size_t e = 0; e < rod.size(); ++e) {
        arriving = passed(arriving, field[e], field[e + 1], rod.elements[e].rest_length / spread.length);
        sum[e + 1] += share * arriving;
      }
    }
  }

  /// The integral of exp(-u) times a field that is linear from `far` at u = x to `near` at 0, and what came from
  /// beyond.
  static Eigen::Vector2d passed(const Eigen::Vector2d& arriving, const Eigen::Vector2d& far,
                                const Eigen::Vector2d& near, double x) {
    const double fading = std::exp(-x);
    const double share_of_far = phi1(x) - fading;
    const double share_of_near = -std::expm1(-x) - share_of_far;
    return fading * arriving + share_of_far * far + share_of_near * near;
  }

  /// Linear interpolation is a sum of hats, so the field is gathered on the grid, passed on there, and read off it.
  void operator()(const SampledSpread& spread) const {
    using Gathered = Eigen::Matrix<double, Eigen::Dynamic, 2>;
    Gathered sent = Gathered::Zero(spread.densities.cols(), 2);
    for (std::size_t v = 0; v < field.size(); ++v) {
      const Interval in = locate(spread.labels, rod.vertices[v].label);
      const Eigen::RowVector2d portion = rod.vertexLength(v) * field[v].transpose();
      const auto lower = static_cast<Eigen::Index>(in.lower);
      sent.row(lower) += (1.0 - in.fraction) * portion;
      sent.row(lower + 1) += in.fraction * portion;
    }
    const Gathered received = spread.densities * sent;
    for (std::size_t v = 0; v < field.size(); ++v) {
      const Interval in = locate(spread.labels, rod.vertices[v].label);
      const auto lower = static_cast<Eigen::Index>(in.lower);
      sum[v] = ((1.0 - in.fraction) * received.row(lower) + in.fraction * received.row(lower + 1)).transpose();
    }
  }
};

}  // namespace

const char* name(Coordinate coordinate) {
  switch (coordinate) {
    case Coordinate::distance_from_apex:
      return "distance_from_apex";
    case Coordinate::distance_from_base:
      return "distance_from_base";
    case Coordinate::label:
      return "label";
  }
  return "?";
}

Eigen::Vector2d reading(const Sensor& sensor, const rod::Rod& rod, const SectionField& field) {
  switch (sensor.coordinate) {
    case Coordinate::distance_from_apex:
      // Exactly the last value at the apex, whatever round-off does to the length.
      return sensor.at == 0.0 ? field.back() : readBetween(rod, field, std::max(rod.restLength() - sensor.at, 0.0));
    case Coordinate::distance_from_base:
      return readBetween(rod, field, sensor.at);
    case Coordinate::label:
      return readAtLabel(rod, field, sensor.at);
  }
  return field.back();
}

std::optional<Fault> findFault(const Receivers& receivers) {
  const char* at = receivers.coordinate == Coordinate::label ? "labels" : "distances";
  if (!areFinite(receivers.at) || !rises(receivers.at)) return Fault{at, "must rise"};
  if (receivers.weights.size() != receivers.at.size()) return Fault{"weights", std::string("must be as many as ") + at};
  if (!areFinite(receivers.weights)) return Fault{"weights", "must be finite"};
  return std::nullopt;
}

std::optional<Fault> findFault(const Spread& spread) { return std::visit(FindSpreadFault{}, spread); }

void weigh(const Receivers& receivers, const rod::Rod& rod, std::vector<double>& weights) {
  weights.assign(rod.size(), 1.0);
  if (receivers.at.empty()) return;
  const double length = rod.restLength();
  double s = 0.0;
  for (std::size_t j = 0; j < rod.size(); ++j) {
    const double x = receivers.coordinate == Coordinate::label                ? rod.vertices[j].label
                     : receivers.coordinate == Coordinate::distance_from_base ? s
                                                                              : length - s;
    weights[j] = interpolate(receivers.at, receivers.weights, x);
    s += rod.elements[j].rest_length;
  }
}

void spreadOut(const Spread& spread, const rod::Rod& rod, const SectionField& field, SectionField& spread_field) {
  spread_field.assign(field.size(), Eigen::Vector2d::Zero());
  std::visit(SpreadOut{rod, field, spread_field}, spread);
}

}  // namespace sensory_growth::growth
