// What an organ in equilibrium holds in memory.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <memory>

#include "organs.h"

namespace sensory_growth::bench {
namespace {

double heapInUse() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Bytes that an organ adds to the heap once it has taken a step, everything it works with included.
void organMemory(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  double bytes = 0.0;
  for (auto _ : state) {
    const double before = heapInUse();
    auto stems = std::make_unique<simulation::Simulation>(growingStems(1, elements));
    if (!stems->step().ok) return state.SkipWithError("a step failed");
    bytes = heapInUse() - before;
  }
  state.counters["bytes_per_element"] = bytes / static_cast<double>(elements);
}
BENCHMARK(organMemory)
    ->Name("memory/organ")
    ->ArgName("n")
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sensory_growth::bench
