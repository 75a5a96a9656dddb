#include "profile_kernels.h"

#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::growth::kernels {

const ProfileKernels& profileKernels() {
  switch (rod::instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case rod::InstructionSet::avx512:
      return profileKernelsAvx512();
    case rod::InstructionSet::avx2:
      return profileKernelsAvx2();
#endif
    default:
      return profileKernelsBaseline();
  }
}

}  // namespace sensory_growth::growth::kernels
