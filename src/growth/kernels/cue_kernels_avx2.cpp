#include "cue_kernels.inc"

namespace sensory_growth::growth::kernels {

const CueKernels& cueKernelsAvx2() { return kKernels; }

}  // namespace sensory_growth::growth::kernels
