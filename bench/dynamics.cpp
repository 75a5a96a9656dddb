// Damped dynamics: one whole relaxation, and the rate of its steps.

#include <benchmark/benchmark.h>

#include "rods.h"
#include "sensory_growth/mechanics/dynamics.h"
#include "step_cost.h"

namespace sensory_growth::bench {
namespace {

/// From straight to the residual that relaxation/heavy_cantilever reaches, too.
void relaxMoving(benchmark::State& state) {
  LoadedRod rod = heavyCantilever(static_cast<std::size_t>(state.range(0)));
  const rod::Rod straight = rod.rod;
  mechanics::DynamicsSettings settings;
  settings.tolerance = kResidual;
  mechanics::DynamicRelaxation dynamics(settings);
  mechanics::RelaxationReport report;
  for (auto _ : state) {
    rod.rod = straight;
    report = dynamics.relax(rod.rod, rod.loads);
    if (!report.ok()) return state.SkipWithError("the rod does not come to rest");
  }
  state.counters["time_steps"] = report.iterations;
}
BENCHMARK(relaxMoving)
    ->Name("dynamics/heavy_cantilever")
    ->ArgName("n")
    ->Arg(100)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// Steps of a rod that starts to fall.
void move(benchmark::State& state) {
  constexpr double kSteps = 200.0;
  LoadedRod rod = heavyCantilever(static_cast<std::size_t>(state.range(0)));
  const mechanics::DynamicsSettings settings;
  mechanics::DynamicRelaxation dynamics(settings);
  const double duration = kSteps * settings.time_step * mechanics::waveTime(rod.rod);
  double element_steps = 0.0;
  for (auto _ : state) {
    const mechanics::RelaxationReport report = dynamics.advance(rod.rod, rod.loads, duration);
    if (!report.ok()) return state.SkipWithError("the rod does not move on");
    element_steps += static_cast<double>(report.iterations) * static_cast<double>(state.range(0));
  }
  const StepCost cost = countStep();
  const auto perSecond = [&](double amount) {
    return benchmark::Counter(amount * element_steps, benchmark::Counter::kIsRate);
  };
  state.counters["element_steps_per_second"] = perSecond(1.0);
  state.counters["flops_per_second"] = perSecond(cost.flops);
  state.counters["bytes_moved_per_second"] = perSecond(cost.bytes);
  state.counters["flops_per_element_step"] = cost.flops;
  state.counters["bytes_per_element_step"] = cost.bytes;
}
BENCHMARK(move)->Name("dynamics/steps")->ArgName("n")->Arg(100)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sensory_growth::bench
