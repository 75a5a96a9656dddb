"""Makes the figures of docs/performance.md of the results of the benchmarks.

Usage: bench_figures.py RESULTS.json [lines | markdown]

Every figure is made of medians over the repetitions of one run. Those that cannot be made, because their benchmarks
were not run, are left out.
"""

import json
import statistics
import subprocess
import sys

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Results:
    def __init__(self, document):
        self.context = document["context"]
        self._runs = {}
        for run in document["benchmarks"]:
            if run["run_type"] == "iteration" and not run.get("error_occurred"):
                self._runs.setdefault(run["run_name"], []).append(run)

    def median(self, name, key):
        return statistics.median(run[key] for run in self._runs[name])

    def seconds(self, name, clock="cpu_time"):
        """Time of one iteration; by default that of the processor, which other programs disturb less."""
        return SECONDS[self._runs[name][0]["time_unit"]] * self.median(name, clock)

    def flops(self):
        """Scalar flops per second; an FMA is two."""
        return 2.0 * self.median("arithmetic/scalar_fma", "fma_per_second")

    def newton_iteration(self, n, instructions=None):
        """Seconds of one Newton iteration: the difference between three and one."""
        name = f"newton/{instructions or self.context['instruction_set']}/n:{n}/iterations:"
        return (self.seconds(name + "3") - self.seconds(name + "1")) / 2.0

    def newton_flops(self, n, instructions=None):
        return self.newton_iteration(n, instructions) / n * self.flops()

    def dynamics_share(self, limit, n):
        """Of the rate of the widest FMAs, two flops each, or of the triad's, whose bytes are decimal as ours are."""
        name = f"dynamics/steps/n:{n}"
        if limit == "arithmetic":
            return self.median(name, "flops_per_second") / (2.0 * self.median("arithmetic/widest_fma", "fma_per_second"))
        return self.median(name, "bytes_moved_per_second") / self.median("memory/triad", "bytes_per_second")


def newton_figures(instructions):
    return [
        (f"newton_iteration_flop_equivalents_{instructions}_n{n}", "", lambda r, n=n: r.newton_flops(n, instructions))
        for n in (100, 10000)
    ]


FIGURES = [
    ("newton_iteration_flop_equivalents", "<= 2000", lambda r: max(r.newton_flops(100), r.newton_flops(10000))),
    ("newton_iteration_flop_equivalents_n100", "<= 2000", lambda r: r.newton_flops(100)),
    ("newton_iteration_flop_equivalents_n10000", "<= 2000", lambda r: r.newton_flops(10000)),
    *newton_figures("baseline"),
    *newton_figures("avx2"),
    *newton_figures("avx512"),
    (
        "dynamics_over_statics",
        ">= 10000",
        lambda r: r.seconds("dynamics/heavy_cantilever/n:100/iterations:1") / r.seconds("relaxation/heavy_cantilever"),
    ),
    (
        "dynamics_step_flop_equivalents",
        "",
        lambda r: r.flops() / r.median("dynamics/steps/n:100", "element_steps_per_second"),
    ),
    (
        "dynamics_element_steps_per_second",
        "",
        lambda r: r.median("dynamics/steps/n:100", "element_steps_per_second"),
    ),
    ("dynamics_flops_per_element_step", "", lambda r: r.median("dynamics/steps/n:100", "flops_per_element_step")),
    ("dynamics_bytes_per_element_step", "", lambda r: r.median("dynamics/steps/n:100", "bytes_per_element_step")),
    *(
        (f"dynamics_share_of_{limit}_n{n}", "", lambda r, n=n, limit=limit: r.dynamics_share(limit, n))
        for n in (100, 100000)
        for limit in ("arithmetic", "memory")
    ),
    ("vector_over_scalar_fma_rate", "", lambda r: 2.0 * r.median("arithmetic/widest_fma", "fma_per_second") / r.flops()),
    (
        "growth_step_per_newton_iteration",
        "<= 6",
        lambda r: r.seconds("growth_step/n:100") / r.newton_iteration(100),
    ),
    ("relaxation_flop_equivalents", "<= 1e6", lambda r: r.seconds("relaxation/stem") * r.flops()),
    ("cost_flatness", "<= 1.3", lambda r: r.newton_flops(100000) / r.newton_flops(100)),
    (
        "memory_flatness",
        "about 1",
        lambda r: r.median("memory/organ/n:100000/iterations:1", "bytes_per_element")
        / r.median("memory/organ/n:1000/iterations:1", "bytes_per_element"),
    ),
    (
        "parallel_speedup",
        ">= 1.8",
        lambda r: r.seconds("organs/threads:1/iterations:5/real_time", "real_time")
        / r.seconds("organs/threads:2/iterations:5/real_time", "real_time"),
    ),
]


def figures(results):
    for name, bound, compute in FIGURES:
        try:
            yield name, bound, compute(results)
        except LookupError:
            continue


def print_lines(results):
    for name, _, value in figures(results):
        print(f"ratio {name} {value:.4g}")


def cpu_model():
    for line in subprocess.run(["lscpu"], capture_output=True, text=True, check=True).stdout.splitlines():
        key, _, value = line.partition(":")
        if key == "Model name":
            return value.strip()
    return "unknown"


def print_markdown(results):
    context = results.context
    print(f"{cpu_model()}, {context['num_cpus']} processors, instruction set `{context['instruction_set']}`, ", end="")
    print(f"{context['date'][:10]}.\n")
    print("| figure | value | aim |\n|---|---|---|")
    for name, bound, value in figures(results):
        aim = bound.replace("<=", "≤").replace(">=", "≥")
        print(f"| `{name}` | {value:.4g} | {aim} |")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        results = Results(json.load(file))
    if sys.argv[2:] == ["markdown"]:
        print_markdown(results)
    else:
        print_lines(results)


if __name__ == "__main__":
    main()
