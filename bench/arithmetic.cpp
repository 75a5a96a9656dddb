// What the machine can do at most: the yardsticks of the other figures.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace {

/// Enough independent chains to hide the latency of an FMA on two ports, few enough for the registers.
constexpr int kChains = 12;
constexpr int kRounds = 1000;

/// value = value * factor + summand in every chain. The barriers keep the compiler from leaving anything out and from
/// packing scalar chains together.
template <typename Value>
[[gnu::always_inline]] inline void runChains() {
  const Value factor = Value{} + 0.999;
  const Value summand = Value{} + 0.001;
  Value chain[kChains] = {};
  for (int round = 0; round < kRounds; ++round) {
#pragma GCC unroll 12
    for (Value& value : chain) {
      value = value * factor + summand;
      asm volatile("" : "+x"(value));
    }
  }
}

/// Counts one multiplication and addition as one FMA; flop rates take it for two.
void countFmas(benchmark::State& state, int lanes) {
  state.counters["fma_per_second"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * kRounds * kChains * lanes, benchmark::Counter::kIsRate);
}

void measure(benchmark::State& state, void (*run)(), int lanes) {
  for (auto _ : state) run();
  countFmas(state, lanes);
}

// The compiler contracts multiplication and addition to an FMA where the target has it.
void runScalar() { runChains<double>(); }

#ifdef __x86_64__
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

[[gnu::target("fma")]] void runScalarFma() { runChains<double>(); }
[[gnu::target("avx2,fma")]] void runFourFma() { runChains<Four>(); }
[[gnu::target("avx512f,fma")]] void runEightFma() { runChains<Eight>(); }
#endif

void scalarFma(benchmark::State& state) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("fma")) return measure(state, runScalarFma, 1);
#endif
  measure(state, runScalar, 1);
}
BENCHMARK(scalarFma)->Name("arithmetic/scalar_fma");

void vectorFma(benchmark::State& state) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f")) return measure(state, runEightFma, 8);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return measure(state, runFourFma, 4);
#endif
  measure(state, runScalar, 1);
}
BENCHMARK(vectorFma)->Name("arithmetic/widest_fma");

/// STREAM's triad a = b + s c on arrays beyond the caches; 24 bytes per element by its convention.
void triad(benchmark::State& state) {
  constexpr std::size_t kSize = std::size_t{1} << 23;
  std::vector<double> a(kSize), b(kSize, 1.0), c(kSize, 2.0);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kSize; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * kSize * 3 * sizeof(double)));
}
BENCHMARK(triad)->Name("memory/triad")->Unit(benchmark::kMillisecond);

}  // namespace
