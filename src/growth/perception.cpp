#include "sensory_growth/growth/perception.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensory_growth::growth {
namespace {

constexpr std::size_t index(Cue cue) { return static_cast<std::size_t>(cue); }

/// The only label of a sensor: whatever the tissue at its place, it remains the same sensor.
const std::vector<double> kSensorLabel{0.0};

/// Frame of the cross-section at the base: of a hinge, which turns freely, extrapolated like that of the apex.
rod::Quaternion baseFrame(const rod::Rod& rod) {
  if (rod.base_support != rod::BaseSupport::hinged) return rod.bendFrame(0);
  const rod::Element& first = rod.elements.front();
  if (rod.size() == 1) return first.frame;
  return (first.frame * rod::exp(-0.5 * first.rest_length * rod.bends[1].curvature)).normalized();
}

/// Whether the sample has the labels of the sensor, or of the organ when it had no more vertices than now.
bool isOf(const MemorySample& sample, const Route& route, const rod::Rod& rod) {
  const std::vector<double>& labels = sample.labels;
  if (route.sensor) return labels == kSensorLabel;
  return labels.size() >= 2 && labels.size() <= rod.vertices.size() && labels.front() == rod.vertices.front().label &&
         labels.back() == rod.vertices.back().label;
}

/// The cues of the bends with those of both ends of the organ, which the bends next to them will need when elements
/// divide: of the apex, and of a base whose bend has no stiffness and senses nothing for itself.
void senseAtVertices(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
                     const CueFields& bends, CueFields& vertices) {
  const CueField field(senses, environment, time);
  const rod::Pose apex = rod.apex();
  const SectionCues at_apex = field.at({apex.position, apex.frame, 0.0});
  const SectionCues at_base = field.at({rod.vertices.front().position, baseFrame(rod), rod.restLength()});
  for (std::size_t cue = 0; cue < kCues; ++cue) {
    vertices[cue] = bends[cue];
    vertices[cue].front() = at_base[cue];
    vertices[cue].push_back(at_apex[cue]);
  }
}

}  // namespace

Perception::Perception(const std::vector<Route>& routes) {
  const auto require = [](const std::string& part, const std::optional<Fault>& fault) {
    if (fault) throw std::invalid_argument(part + ": " + fault->field + " " + fault->reason);
  };
  for (const Route& route : routes) {
    if (route.sensor && route.spread) throw std::invalid_argument("spread: needs bends that sense for themselves");
    if (route.spread) require("spread", findFault(*route.spread));
    require("receivers", findFault(route.receivers));
    for (const Cue cue : route.cues) pathways_.push_back({cue, route, Memory(route.memory, route.before_start)});
  }
}

void Perception::remember(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
                          CueFields& perceived) {
  perceive(senses, environment, time, rod, Tense::past, perceived);
}

void Perception::expect(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
                        CueFields& perceived) {
  perceive(senses, environment, time, rod, Tense::future, perceived);
}

void Perception::perceive(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
                          Tense tense, CueFields& perceived) {
  sense(senses, environment, time, rod, perceived);
  if (pathways_.empty()) return;
  senseAtVertices(senses, environment, time, rod, perceived, sensed_);
  labels_.clear();
  for (const rod::Vertex& vertex : rod.vertices) labels_.push_back(vertex.label);
  for (const Pathway& pathway : pathways_) perceived[index(pathway.cue)].assign(rod.size(), Eigen::Vector2d::Zero());
  for (Pathway& pathway : pathways_) {
    send(pathway, time, rod, tense, sensed_[index(pathway.cue)], perceived[index(pathway.cue)]);
  }
}

void Perception::send(Pathway& pathway, double time, const rod::Rod& rod, Tense tense, const SectionField& sensed,
                      SectionField& perceived) {
  const Route& route = pathway.route;
  if (route.sensor) read_.assign(1, reading(*route.sensor, rod, sensed));
  const SectionField& signal = route.sensor ? read_ : sensed;
  const std::vector<double>& labels = route.sensor ? kSensorLabel : labels_;
  const SectionField& recalled = tense == Tense::past ? pathway.memory.remember(time, labels, signal)
                                                      : pathway.memory.expect(time, labels, signal);
  if (route.spread) spreadOut(*route.spread, rod, recalled, spread_);
  const SectionField& arriving = route.spread ? spread_ : recalled;

  weigh(route.receivers, rod, weights_);
  for (std::size_t j = rod.firstBend(); j < rod.size(); ++j) {
    perceived[j] += weights_[j] * (route.sensor ? arriving.front() : arriving[j]);
  }
}

bool Perception::hasMemory() const {
  return std::any_of(pathways_.begin(), pathways_.end(), [](const Pathway& pathway) {
    const auto* pure = std::get_if<Delay>(&pathway.route.memory);
    return !pure || pure->time > 0.0;
  });
}

double Perception::shortestDelay() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Pathway& pathway : pathways_) shortest = std::min(shortest, delay(pathway.route.memory));
  return shortest;
}

double Perception::nextJump(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Pathway& pathway : pathways_) next = std::min(next, pathway.memory.nextJump(time));
  return next;
}

void Perception::setMark(Mark& mark) const {
  mark.clear();
  for (const Pathway& pathway : pathways_) mark.push_back(pathway.memory.size());
}

void Perception::takeBack(const Mark& mark) {
  for (std::size_t i = 0; i < pathways_.size(); ++i) pathways_[i].memory.takeBack(mark[i]);
}

std::vector<History> Perception::histories() const {
  std::vector<History> histories;
  for (const Pathway& pathway : pathways_) histories.push_back(pathway.memory.history());
  return histories;
}

void Perception::restore(const std::vector<History>& histories, const rod::Rod& rod) {
  if (histories.size() != pathways_.size()) {
    throw std::invalid_argument("there are " + std::to_string(histories.size()) + " memories instead of " +
                                std::to_string(pathways_.size()));
  }
  for (std::size_t i = 0; i < histories.size(); ++i) {
    for (const MemorySample& sample : histories[i]) {
      if (!isOf(sample, pathways_[i].route, rod)) {
        throw std::invalid_argument("memory " + std::to_string(i) + " is that of another organ");
      }
    }
    pathways_[i].memory.restore(histories[i]);
  }
}

void Perception::forgetTheOld() {
  for (Pathway& pathway : pathways_) pathway.memory.forgetTheOld();
}

}  // namespace sensory_growth::growth
