#pragma once

namespace sensory_growth::bench {

/// What a time step of the dynamics asks of the processor, per element.
struct StepCost {
  double flops = 0.0;  ///< of one number each; an FMA would be two
  double bytes = 0.0;  ///< fetched and put back, if nothing stays in a cache between the two passes of a step
};

/// Counted, not estimated: the kernels of the dynamics run once with numbers that count.
StepCost countStep();

}  // namespace sensory_growth::bench
