#include "sensory_growth/mechanics/instruction_set.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "kernels/motion_kernels.h"
#include "kernels/reduced_kernels.h"

namespace sensory_growth::mechanics {
namespace {

InstructionSet& current() {
  static InstructionSet set = availableInstructionSets().back();
  return set;
}

}  // namespace

const char* name(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "?";
}

std::vector<InstructionSet> availableInstructionSets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#ifdef SENSORY_GROWTH_X86_64
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(InstructionSet::avx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
      sets.push_back(InstructionSet::avx512);
    }
  }
#endif
  return sets;
}

InstructionSet instructionSet() { return current(); }

void useInstructionSet(InstructionSet set) {
  const std::vector<InstructionSet> sets = availableInstructionSets();
  if (std::find(sets.begin(), sets.end(), set) == sets.end()) {
    throw std::invalid_argument(std::string("this processor or build has no ") + name(set));
  }
  current() = set;
}

namespace kernels {

const MotionKernels& motionKernels() {
  switch (instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case InstructionSet::avx512:
      return motionKernelsAvx512();
    case InstructionSet::avx2:
      return motionKernelsAvx2();
#endif
    default:
      return motionKernelsBaseline();
  }
}

const ReducedKernels& reducedKernels() {
  switch (instructionSet()) {
#ifdef SENSORY_GROWTH_X86_64
    case InstructionSet::avx512:
      return reducedKernelsAvx512();
    case InstructionSet::avx2:
      return reducedKernelsAvx2();
#endif
    default:
      return reducedKernelsBaseline();
  }
}

}  // namespace kernels
}  // namespace sensory_growth::mechanics
