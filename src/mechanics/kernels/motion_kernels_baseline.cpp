#include "kernels/motion_kernels.inc"

namespace sensory_growth::mechanics::kernels {

const MotionKernels& motionKernelsBaseline() { return kKernels; }

}  // namespace sensory_growth::mechanics::kernels
