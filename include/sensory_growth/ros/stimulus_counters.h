#pragma once

/// What became of the stimuli that were sent to the node.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace sensory_growth::node {

enum class StimulusFate {
  accepted,
  unknown_operation,  ///< neither add, change nor remove
  malformed,          ///< empty id, non-finite number, direction without length
  no_transform,       ///< its frame cannot be transformed to the world
  too_many_waiting,   ///< more commands than one step boundary takes
  not_applicable,     ///< well formed, but there is nothing of this id to change or remove
};

inline constexpr std::array<StimulusFate, 6> kStimulusFates = {
    StimulusFate::accepted,     StimulusFate::unknown_operation, StimulusFate::malformed,
    StimulusFate::no_transform, StimulusFate::too_many_waiting,  StimulusFate::not_applicable};

constexpr const char* name(StimulusFate fate) {
  switch (fate) {
    case StimulusFate::accepted:
      return "accepted";
    case StimulusFate::unknown_operation:
      return "unknown operation";
    case StimulusFate::malformed:
      return "malformed";
    case StimulusFate::no_transform:
      return "no transform";
    case StimulusFate::too_many_waiting:
      return "too many waiting";
    case StimulusFate::not_applicable:
      return "not applicable";
  }
  return "?";
}

/// Thread-safe.
class StimulusCounters {
 public:
  void count(StimulusFate fate) { ++counts_[static_cast<std::size_t>(fate)]; }

  std::uint64_t of(StimulusFate fate) const { return counts_[static_cast<std::size_t>(fate)]; }

  std::uint64_t refused() const {
    std::uint64_t sum = 0;
    for (const StimulusFate fate : kStimulusFates) sum += fate == StimulusFate::accepted ? 0 : of(fate);
    return sum;
  }

 private:
  std::array<std::atomic<std::uint64_t>, kStimulusFates.size()> counts_ = {};
};

}  // namespace sensory_growth::node
