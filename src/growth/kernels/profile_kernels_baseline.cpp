#include "profile_kernels.inc"

namespace sensory_growth::growth::kernels {

const ProfileKernels& profileKernelsBaseline() { return kKernels; }

}  // namespace sensory_growth::growth::kernels
