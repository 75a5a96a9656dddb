#include "sensory_growth/simulation/organ_sources.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sensory_growth::simulation {
namespace {

/// Position of the tissue with that label, linear between vertices.
rod::Vector3 placeOf(const rod::Rod& rod, double label) {
  const auto before = [](const rod::Vertex& vertex, double value) { return vertex.label < value; };
  const auto first = rod.vertices.begin(), last = rod.vertices.end() - 1;
  const auto above = std::lower_bound(first, last, label, before);
  if (above == first) return above->position;
  const auto below = above - 1;
  const double weight = (label - below->label) / (above->label - below->label);
  return below->position + std::min(weight, 1.0) * (above->position - below->position);
}

}  // namespace

std::optional<growth::PointSource> sourceOf(const Organ& organ) {
  const OrganScenario& scenario = organ.scenario();
  std::optional<growth::PointSource> source;
  if (scenario.source) {
    source.emplace();
    source->id = scenario.id;
    source->position = placeOf(organ.rod(), scenario.source->label);
    source->strength = scenario.source->strength;
  }
  return source;
}

void OrganSources::Source::locate(const std::vector<Organ>& organs) {
  const OrganScenario& scenario = organs[organ].scenario();
  point.position = placeOf(organs[organ].rod(), scenario.source->label);
  point.strength = scenario.source->strength;
}

OrganSources::OrganSources(const std::vector<Organ>& organs) {
  for (std::size_t i = 0; i < organs.size(); ++i) {
    if (organs[i].scenario().source) sources_.push_back({i, {organs[i].scenario().id, {}, 1.0, {}}});
  }
  std::sort(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) { return a.point.id < b.point.id; });
  if (!sources_.empty()) seen_.resize(organs.size());
  locate(organs);
}

void OrganSources::recount(const std::vector<Organ>& organs) {
  OrganSources now(organs);
  for (Source& source : now.sources_) {
    const auto is_same = [&source](const Source& before) { return before.point.id == source.point.id; };
    const auto before = std::find_if(sources_.begin(), sources_.end(), is_same);
    if (before != sources_.end()) source.point.velocity = before->point.velocity;
  }
  *this = std::move(now);
}

void OrganSources::locate(const std::vector<Organ>& organs) {
  for (Source& source : sources_) source.locate(organs);
}

void OrganSources::follow(const std::vector<Organ>& organs, double dt) {
  for (Source& source : sources_) {
    const rod::Vector3 before = source.point.position;
    source.locate(organs);
    const bool has_snapped = organs[source.organ].report().branch_switches > 0;
    source.point.velocity = has_snapped ? rod::Vector3::Zero() : rod::Vector3((source.point.position - before) / dt);
  }
}

std::vector<rod::Vector3> OrganSources::velocities() const {
  std::vector<rod::Vector3> velocities;
  for (const Source& source : sources_) velocities.push_back(source.point.velocity);
  return velocities;
}

void OrganSources::restore(const std::vector<Organ>& organs, const std::vector<rod::Vector3>& velocities) {
  const bool is_finite =
      std::all_of(velocities.begin(), velocities.end(), [](const rod::Vector3& v) { return v.allFinite(); });
  if (velocities.size() != sources_.size() || !is_finite) {
    throw std::invalid_argument("the velocities of the organs that others sense are not those of such organs");
  }
  locate(organs);
  for (std::size_t i = 0; i < sources_.size(); ++i) sources_[i].point.velocity = velocities[i];
}

const growth::Environment& OrganSources::seenBy(std::size_t organ, const growth::Environment& surroundings) {
  if (seen_.empty()) return surroundings;
  growth::Environment& seen = seen_[organ];
  const auto is_other = [organ](const Source& source) { return source.organ != organ; };
  const auto others = static_cast<std::size_t>(std::count_if(sources_.begin(), sources_.end(), is_other));
  // Assigned one by one into what was there before, which takes no memory in a steady step.
  const std::size_t lamps = surroundings.point_sources.size();
  seen.time = surroundings.time;
  seen.down = surroundings.down;
  seen.light_directions = surroundings.light_directions;
  seen.point_sources.resize(lamps + others);
  auto next =
      std::copy(surroundings.point_sources.begin(), surroundings.point_sources.end(), seen.point_sources.begin());
  for (const Source& source : sources_) {
    if (is_other(source)) *next++ = source.point;
  }
  return seen;
}

}  // namespace sensory_growth::simulation
