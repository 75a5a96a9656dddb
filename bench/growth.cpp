// A growth step with everything that belongs to it.

#include <benchmark/benchmark.h>

#include "organs.h"

namespace sensory_growth::bench {
namespace {

/// The same second-order step over and over: taking it back is part of what is measured, and is little.
void growthStep(benchmark::State& state) {
  const simulation::Simulation stems = growingStems(1, static_cast<std::size_t>(state.range(0)));
  const simulation::Scenario& scenario = stems.scenario();
  simulation::Organ organ(scenario.organs.front(), scenario);
  for (int i = 0; i < 3; ++i) organ.advance(scenario.stepping.step, stems.environment());
  int iterations = 0;
  for (auto _ : state) {
    const simulation::OrganReport& report = organ.advance(scenario.stepping.step, stems.environment());
    if (!report.ok() || report.substeps != 1 || report.divisions != 0) {
      return state.SkipWithError("not one plain step");
    }
    iterations = report.iterations;
    organ.undo();
  }
  state.counters["iterations"] = iterations;
}
BENCHMARK(growthStep)->Name("growth_step")->ArgName("n")->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sensory_growth::bench
