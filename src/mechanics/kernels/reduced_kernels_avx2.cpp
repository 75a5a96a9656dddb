#include "kernels/reduced_kernels.inc"

namespace sensory_growth::mechanics::kernels {

const ReducedKernels& reducedKernelsAvx2() { return kKernels; }

}  // namespace sensory_growth::mechanics::kernels
