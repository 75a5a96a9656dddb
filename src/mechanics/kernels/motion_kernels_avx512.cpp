#include "kernels/motion_kernels.inc"

namespace sensory_growth::mechanics::kernels {

const MotionKernels& motionKernelsAvx512() { return kKernels; }

}  // namespace sensory_growth::mechanics::kernels
