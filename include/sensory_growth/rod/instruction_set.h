#pragma once

/// Which vector instructions growth and mechanics run on. The library is built for any processor of its architecture
/// and holds its innermost loops several times; the widest that the processor has is chosen when the program starts.
///
/// Results differ between instruction sets by round-off; on one machine they are reproducible bit for bit.

#include <vector>

namespace sensory_growth::rod {

enum class InstructionSet {
  baseline,  ///< what every processor of the architecture has (SSE2 on x86-64)
  avx2,      ///< AVX2 and fused multiply-add: 4 elements at a time
  avx512,    ///< AVX-512 F, BW, CD, DQ, VL: 8 elements at a time
};

const char* name(InstructionSet set);

/// Those that this library holds and this processor has, from the narrowest to the widest. Never empty.
std::vector<InstructionSet> availableInstructionSets();

/// The one in use; the widest available unless useInstructionSet() was called.
InstructionSet instructionSet();

/// For comparisons and benchmarks. Throws std::invalid_argument if `set` is not available. Not to be called while any
/// rod grows or relaxes.
void useInstructionSet(InstructionSet set);

}  // namespace sensory_growth::rod
