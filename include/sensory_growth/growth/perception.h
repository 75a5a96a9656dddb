#pragma once

/// What the bends of an organ perceive of its cues: elsewhere, later, faded or spread out (model.md 7).

#include <cstddef>
#include <optional>
#include <vector>

#include "sensory_growth/growth/cues.h"
#include "sensory_growth/growth/memory.h"
#include "sensory_growth/growth/sensing.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::growth {

/// One way from cues to where they are answered. The section components of a cue are handed on along the fibres, that
/// is as they are, whatever the frames on the way.
struct Route {
  std::vector<Cue> cues;
  std::optional<Sensor> sensor;  ///< none: every bend senses for itself
  MemoryKernel memory = Delay{};
  BeforeStart before_start = BeforeStart::constant;
  std::optional<Spread> spread;  ///< only without a sensor
  Receivers receivers;
};

/// Perceives the cues that have routes through them, adding up those of one cue, and all other cues where and when they
/// are.
class Perception {
 public:
  /// Throws std::invalid_argument naming the fault of a route.
  explicit Perception(const std::vector<Route>& routes);

  /// What every bend perceives at `time` [s]; keeps what is sensed in memory. Called at the beginning and at the end of
  /// every part of a step, so that stimuli that change between steps jump. Sizes n.
  void remember(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
                CueFields& perceived);

  /// What every bend would perceive at `time` if the rod was like this then; keeps nothing.
  void expect(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod,
              CueFields& perceived);

  /// Whether anything perceived depends on the past.
  bool hasMemory() const;

  /// When what is perceived next jumps after `time` [s], because a stimulus did so a delay ago; infinity if it does
  /// not.
  double nextJump(double time) const;

  /// [s]; infinity without delays. A part of a step must be shorter (model.md 11.2).
  double shortestDelay() const;

  /// How much is remembered now, to come back to.
  using Mark = std::vector<std::size_t>;

  void setMark(Mark& mark) const;
  void takeBack(const Mark& mark);

  /// What is remembered, one for each cue of each route in their order.
  std::vector<History> histories() const;

  /// Remembers this and nothing else; `rod` is the organ as it is now. Earlier marks end. Throws std::invalid_argument
  /// if these are no histories of such an organ with these routes.
  void restore(const std::vector<History>& histories, const rod::Rod& rod);

  /// Forgets what is not needed from now on. Earlier marks end.
  void forgetTheOld();

 private:
  /// A route of one cue, with the history of that cue.
  struct Pathway {
    Cue cue;
    Route route;
    Memory memory;
  };
  enum class Tense { past, future };

  void perceive(const Senses& senses, const Environment& environment, double time, const rod::Rod& rod, Tense tense,
                CueFields& perceived);
  void send(Pathway& pathway, double time, const rod::Rod& rod, Tense tense, const SectionField& sensed,
            SectionField& perceived);

  std::vector<Pathway> pathways_;
  std::vector<double> labels_;  ///< of the vertices
  CueFields sensed_;            ///< at the vertices
  SectionField read_, spread_;
  std::vector<double> weights_;
};

}  // namespace sensory_growth::growth
