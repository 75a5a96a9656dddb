#include "profile_kernels.inc"

namespace sensory_growth::growth::kernels {

const ProfileKernels& profileKernelsAvx512() { return kKernels; }

}  // namespace sensory_growth::growth::kernels
