#include "cue_kernels.inc"

namespace sensory_growth::growth::kernels {

const CueKernels& cueKernelsAvx512() { return kKernels; }

}  // namespace sensory_growth::growth::kernels
