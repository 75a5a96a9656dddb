// Many organs on one thread and on several.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "organs.h"

namespace sensory_growth::bench {
namespace {

/// The same first steps of 1000 organs of 100 elements in every run.
void growMany(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  const tbb::global_control enough(tbb::global_control::max_allowed_parallelism, 64);
  simulation::Simulation stems = growingStems(1000, 100, threads);
  if (!stems.step().ok) return state.SkipWithError("a step failed");
  for (auto _ : state) {
    if (!stems.step().ok) return state.SkipWithError("a step failed");
  }
  state.SetItemsProcessed(state.iterations() * 1000);
}
BENCHMARK(growMany)->Name("organs")->ArgName("threads")->Arg(1)->Arg(2)->Iterations(5)->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace sensory_growth::bench
