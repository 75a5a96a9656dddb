#pragma once

/// Static equilibrium of a rod in its surroundings, by Newton's method on rotations and strains (model.md 12).
///
/// Serves every base support and all loads. Rigid walls and a held apex are met to kSupportTolerance of the length of
/// the rod by rounds of multiplier updates.

#include <memory>

#include "sensory_growth/mechanics/loads.h"
#include "sensory_growth/mechanics/relaxation.h"
#include "sensory_growth/mechanics/surroundings.h"
#include "sensory_growth/rod/rod.h"

namespace sensory_growth::mechanics {

/// How closely rigid walls and a held apex are met, over the rest length of the rod [-].
constexpr double kSupportTolerance = 1e-10;

/// Owns the work space of its iterations.
class SupportedEquilibrium {
 public:
  explicit SupportedEquilibrium(const RelaxationSettings& settings = {});
  ~SupportedEquilibrium();
  SupportedEquilibrium(SupportedEquilibrium&&) noexcept;
  SupportedEquilibrium& operator=(SupportedEquilibrium&&) noexcept;

  /// Moves the rod from where it stands to a stable equilibrium. On failure the rod is left as it was given. The
  /// surroundings must be free of faults (findFault).
  RelaxationReport relax(rod::Rod& rod, const Loads& loads);

  /// What the surroundings do to the rod of the last relax() that converged.
  const Reactions& reactions() const;

 private:
  struct Workspace;
  RelaxationSettings settings_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace sensory_growth::mechanics
