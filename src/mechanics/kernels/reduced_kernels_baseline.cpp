#include "kernels/reduced_kernels.inc"

namespace sensory_growth::mechanics::kernels {

const ReducedKernels& reducedKernelsBaseline() { return kKernels; }

}  // namespace sensory_growth::mechanics::kernels
