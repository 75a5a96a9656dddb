#pragma once

/// Organs as point sources for each other (model.md 14).

#include <cstddef>
#include <optional>
#include <vector>

#include "sensory_growth/growth/environment.h"
#include "sensory_growth/simulation/organ.h"

namespace sensory_growth::simulation {

/// The organ as the others sense it, at rest; nothing if they do not.
std::optional<growth::PointSource> sourceOf(const Organ& organ);

/// Where the organs are that others sense, and how they move. An organ does not sense itself.
///
/// All organs of a step sense the others where they stand when it begins, moving on as they did in the step before, so
/// that organs may advance in any order and a step is second order in time.
class OrganSources {
 public:
  OrganSources() = default;

  /// Of organs at rest.
  explicit OrganSources(const std::vector<Organ>& organs);

  /// Takes note of organs that came or went. A new one is at rest, the others move on as they did.
  void recount(const std::vector<Organ>& organs);

  /// Takes the places and strengths of organs that have not grown, but may stand under other loads.
  void locate(const std::vector<Organ>& organs);

  /// Takes the places of organs that have grown for dt [s] since the last call, and how fast they moved. One that
  /// snapped to another equilibrium moves no further that way.
  void follow(const std::vector<Organ>& organs, double dt);

  /// How fast the places move, in the order of the ids [m/s].
  std::vector<rod::Vector3> velocities() const;

  /// Goes on with such velocities, at the places of the organs. Throws std::invalid_argument if they are not finite or
  /// not as many as there are places.
  void restore(const std::vector<Organ>& organs, const std::vector<rod::Vector3>& velocities);

  /// What the organ senses: the surroundings, which all sense, and the other organs. Valid until the next call of a
  /// member or a change of `surroundings`. Organs may ask from several threads, each for itself.
  const growth::Environment& seenBy(std::size_t organ, const growth::Environment& surroundings);

 private:
  struct Source {
    std::size_t organ;
    growth::PointSource point;

    void locate(const std::vector<Organ>& organs);
  };

  std::vector<Source> sources_;            // in order of the ids, so that sums do not depend on that of the organs
  std::vector<growth::Environment> seen_;  // by each organ; empty if there is no source
};

}  // namespace sensory_growth::simulation
