#include "kernels/reduced_kernels.h"

#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::mechanics::kernels {

const ReducedKernels& reducedKernels() {
  switch (rod::instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case rod::InstructionSet::avx512:
      return reducedKernelsAvx512();
    case rod::InstructionSet::avx2:
      return reducedKernelsAvx2();
#endif
    default:
      return reducedKernelsBaseline();
  }
}

}  // namespace sensory_growth::mechanics::kernels
