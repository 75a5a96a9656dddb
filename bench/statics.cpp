// Static equilibrium: the marginal cost of a Newton iteration, and relaxations from straight.

#include <benchmark/benchmark.h>

#include "rods.h"
#include "sensory_growth/mechanics/static_equilibrium.h"
#include "sensory_growth/rod/instruction_set.h"

namespace sensory_growth::bench {
namespace {

using mechanics::RelaxationReason;
using rod::InstructionSet;

/// Uses an instruction set as long as it lives.
class With {
 public:
  explicit With(InstructionSet set) : before_(rod::instructionSet()) { rod::useInstructionSet(set); }
  ~With() { rod::useInstructionSet(before_); }
  With(const With&) = delete;
  With& operator=(const With&) = delete;

 private:
  InstructionSet before_;
};

/// A number of iterations short of equilibrium: the rod is left as it was, and the difference between two such numbers
/// is what iterations cost, without what surrounds them.
void iterate(benchmark::State& state, InstructionSet set) {
  const With instructions(set);
  LoadedRod heavy = heavyCantilever(static_cast<std::size_t>(state.range(0)));
  mechanics::RelaxationSettings settings;
  settings.max_iterations = static_cast<int>(state.range(1));
  mechanics::StaticEquilibrium equilibrium(settings);
  for (auto _ : state) {
    const mechanics::RelaxationReport report = equilibrium.relax(heavy.rod, heavy.loads);
    if (report.reason != RelaxationReason::too_many_iterations || report.iterations != settings.max_iterations) {
      return state.SkipWithError("the rod needs another number of iterations");
    }
  }
}

void relaxFromStraight(benchmark::State& state, const LoadedRod& start, double tolerance) {
  LoadedRod rod = start;
  mechanics::RelaxationSettings settings;
  settings.tolerance = tolerance;
  mechanics::StaticEquilibrium equilibrium(settings);
  mechanics::RelaxationReport report;
  for (auto _ : state) {
    rod.rod = start.rod;
    report = equilibrium.relax(rod.rod, rod.loads);
    if (!report.ok()) return state.SkipWithError("no equilibrium");
  }
  state.counters["iterations"] = report.iterations;
}

const bool registered = [] {
  for (const InstructionSet set : rod::availableInstructionSets()) {
    const std::string name = std::string("newton/") + rod::name(set);
    benchmark::RegisterBenchmark(name.c_str(), [set](benchmark::State& state) { iterate(state, set); })
        ->ArgNames({"n", "iterations"})
        ->ArgsProduct({{100, 1000, 10000, 100000}, {1, 3}})
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

BENCHMARK_CAPTURE(relaxFromStraight, stem, stem(100), mechanics::RelaxationSettings().tolerance)
    ->Name("relaxation/stem")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(relaxFromStraight, heavy, heavyCantilever(100), kResidual)
    ->Name("relaxation/heavy_cantilever")
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sensory_growth::bench
