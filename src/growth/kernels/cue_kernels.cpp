#include "cue_kernels.h"

#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::growth::kernels {

const CueKernels& cueKernels() {
  switch (rod::instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case rod::InstructionSet::avx512:
      return cueKernelsAvx512();
    case rod::InstructionSet::avx2:
      return cueKernelsAvx2();
#endif
    default:
      return cueKernelsBaseline();
  }
}

}  // namespace sensory_growth::growth::kernels
