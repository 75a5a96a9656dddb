#pragma once

/// Where in an organ a cue is sensed, and where it is answered (model.md 7). Fields over the organ are given at its
/// vertices, the apex included, and linear between them.

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/fault.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// How tissue is found in an organ that grows. Distances are rest arc lengths [m]; a label [-], 0 at the base and 1 at
/// the apex, stays with its tissue.
enum class Coordinate { distance_from_apex, distance_from_base, label };

const char* name(Coordinate coordinate);

/// One place at which the whole organ senses.
struct Sensor {
  Coordinate coordinate = Coordinate::distance_from_apex;
  double at = 0.0;  ///< the apex by default; beyond an end of the organ: at that end
};

/// What the sensor reads off a field; size of `field` n + 1.
Eigen::Vector2d reading(const Sensor& sensor, const rod::Rod& rod, const SectionField& field);

/// How strongly tissue answers what reaches it: by samples, linear between them and constant beyond; without samples 1.
struct Receivers {
  Coordinate coordinate = Coordinate::label;
  std::vector<double> at;       ///< rising
  std::vector<double> weights;  ///< [-], as many
};

std::optional<Fault> findFault(const Receivers& receivers);

/// The weight of every bend; size n.
void weigh(const Receivers& receivers, const rod::Rod& rod, std::vector<double>& weights);

/// A signal that spreads along the organ and fades: mu = exp(-|s - s'| / length) / length on one side of where it comes
/// from, half of that on both sides.
struct FadingSpread {
  enum class Direction { basipetal, acropetal, both };
  Direction direction = Direction::basipetal;
  double length = 0.0;  ///< [m]
};

/// mu by samples on a grid of labels, linear between them in both.
struct SampledSpread {
  std::vector<double> labels;  ///< rising from 0 to 1
  Eigen::MatrixXd densities;   ///< [1/m]; rows receive, columns send
};

/// The continuous kernel mu(s, s') [1/m].
using Spread = std::variant<FadingSpread, SampledSpread>;

std::optional<Fault> findFault(const Spread& spread);

/// The integral of mu(s, s') field(s') over the rest arc length, at every vertex: second order in the lengths of
/// elements (FadingSpread: exact for a field that is linear on elements, however short the length). Sizes n + 1;
/// `field` and `spread_field` must differ.
void spreadOut(const Spread& spread, const rod::Rod& rod, const SectionField& field, SectionField& spread_field);

}  // namespace sensory_growth::growth
