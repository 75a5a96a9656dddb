#pragma once

/// The innermost loops of sensing, one set per instruction set: eight neighbouring bends at a time, component by
/// component.

#include <cstddef>

namespace sensory_growth::growth::kernels {

constexpr std::size_t kBends = 8;

struct BendPacket {
  double below[4][kBends];     ///< frame of the element below each bend: w, x, y, z
  double above[4][kBends];     ///< of the element above
  double position[3][kBends];  ///< [m]
};

/// d1 and d2 of each bend, half-way between the frames on either side.
struct SectionPacket {
  double axis[2][3][kBends];
};

/// Components of a vector along d1 and d2.
struct FieldPacket {
  double along[2][kBends];
};

/// The direction to a source, fading where the distance falls below the softening length.
struct PullPacket {
  double distance[kBends];  ///< softened [m]
  FieldPacket direction;
};

struct CueKernels {
  void (*section)(const BendPacket& bends, SectionPacket& section);
  void (*project)(const SectionPacket& section, const double (&vector)[3], FieldPacket& field);

  /// False if a distance is so small or so large that its square is not a normal number; nothing else holds then.
  bool (*pull)(const BendPacket& bends, const SectionPacket& section, const double (&source)[3], double softening,
               PullPacket& pull);
};

/// Those of the instruction set in use.
const CueKernels& cueKernels();

const CueKernels& cueKernelsBaseline();
const CueKernels& cueKernelsAvx2();
const CueKernels& cueKernelsAvx512();

}  // namespace sensory_growth::growth::kernels
