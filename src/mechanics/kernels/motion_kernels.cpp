#include "kernels/motion_kernels.h"

#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::mechanics::kernels {

const MotionKernels& motionKernels() {
  switch (rod::instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case rod::InstructionSet::avx512:
      return motionKernelsAvx512();
    case rod::InstructionSet::avx2:
      return motionKernelsAvx2();
#endif
    default:
      return motionKernelsBaseline();
  }
}

}  // namespace sensory_growth::mechanics::kernels
