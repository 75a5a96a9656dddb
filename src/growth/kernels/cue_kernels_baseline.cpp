#include "cue_kernels.inc"

namespace sensory_growth::growth::kernels {

const CueKernels& cueKernelsBaseline() { return kKernels; }

}  // namespace sensory_growth::growth::kernels
