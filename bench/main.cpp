// Benchmarks of the core. scripts/bench builds and runs them and makes the figures of docs/performance.md of them.

#include <benchmark/benchmark.h>

#include "sensory_growth/rod/instruction_set.h"

int main(int argc, char** argv) {
  using namespace sensory_growth::rod;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("instruction_set", name(instructionSet()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
