"""One job of the comparison: a result file for a law at one G and S, one onset, or one orbit.

Jobs are numbered from 1 and independent of each other. A job whose result is there already does nothing, so that the
whole may be stopped and started again; a result appears when it is complete.
"""

import argparse
import json
import os
import pathlib
import sys
import time

from comparison import experiments, shoot

GRID_G = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0)
GRID_S = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0)
ONSET_G = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0)
# Below and beyond the onset at G = 1 (2.36) and G = 2 (4.82): G, S, push, duration, elements.
ORBITS = (
    (1.0, 2.2, 2.0, 600.0, 60),
    (1.0, 2.34, 2.0, 1500.0, 60),
    (1.0, 2.4, 0.3, 1500.0, 60),
    (1.0, 2.6, 0.3, 1500.0, 60),
    (1.0, 2.6, 0.3, 1500.0, 120),
    (2.0, 4.7, 2.0, 600.0, 60),
    (2.0, 5.0, 0.3, 600.0, 60),
    (4.0, 7.0, 2.0, 300.0, 60),
)


def point(program, law, G, S):
    return {
        "disturbed": experiments.disturbed(program, law, G, S),
        "laid": experiments.laid(program, law, G, S),
    }


def all_jobs(quick=False):
    """Name of the result, experiment and its arguments."""
    grid = [(law, G, S) for law in shoot.LAWS for G in GRID_G for S in GRID_S]
    onsets = [("relaxation", G) for G in ONSET_G] + [(law, G) for law in ("intrinsic", "actual") for G in (1.0, 4.0)]
    orbits = [("relaxation", *orbit) for orbit in ORBITS]
    if quick:
        grid, onsets, orbits = [("actual", 2.0, 3.0), ("relaxation", 2.0, 3.0)], [("relaxation", 2.0)], []
    jobs = [(f"onset_{law}_G{G}", experiments.onset, (law, G)) for law, G in onsets]
    jobs += [(f"orbit_{o[0]}_G{o[1]}_S{o[2]}_n{o[-1]}", experiments.orbit, o) for o in orbits]
    jobs += [(f"point_{law}_G{G}_S{S}", point, (law, G, S)) for law, G, S in grid]
    return jobs


def run(number, program, results, quick):
    name, experiment, arguments = all_jobs(quick)[number - 1]
    path = results / f"{name}.json"
    if path.exists():
        return f"{name}: there already"
    start = time.monotonic()
    result = {"job": name, "arguments": arguments, **experiment(program, *arguments)}
    results.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_suffix(f".{os.getpid()}")
    unfinished.write_text(json.dumps(result), encoding="utf-8")
    unfinished.rename(path)
    return f"{name}: {time.monotonic() - start:.1f} s"


def main():
    parser = argparse.ArgumentParser(prog="comparison.job", description=__doc__.splitlines()[0])
    parser.add_argument("number", type=int, nargs="?", help="from 1; without it, the number of jobs is printed")
    parser.add_argument("--program", type=pathlib.Path, help="sensory_growth_batch")
    parser.add_argument("--results", type=pathlib.Path, help="folder of result files")
    parser.add_argument("--quick", action="store_true", help="a few jobs that show that all works")
    arguments = parser.parse_args()
    count = len(all_jobs(arguments.quick))
    if arguments.number is None:
        print(count)
        return 0
    if not 1 <= arguments.number <= count:
        parser.error(f"there are jobs 1 to {count}, no {arguments.number}")
    if arguments.program is None or arguments.results is None:
        parser.error("a job needs --program and --results")
    print(run(arguments.number, arguments.program, arguments.results, arguments.quick))
    return 0


if __name__ == "__main__":
    sys.exit(main())
