#include "kernels/reduced_kernels.inc"

namespace sensory_growth::mechanics::kernels {

const ReducedKernels& reducedKernelsAvx512() { return kKernels; }

}  // namespace sensory_growth::mechanics::kernels
