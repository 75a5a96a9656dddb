"""One job of the comparison: a result file for a law at one G and S, one onset, or one orbit.

Jobs are numbered from 1 and independent of each other. A job does nothing if its result is there already and was made by
the same program, the same experiments and the same arguments, so that the whole may be stopped and started again; a
result appears when it is complete.
"""

import argparse
import hashlib
import json
import os
import pathlib
import sys
import time

from comparison import experiments, modes, shoot

GRID_G = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0)
GRID_S = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 7.6)
ONSET_G = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0)
# Below and beyond the onset at G = 1 (2.36) and G = 2 (4.82): G, S, push, duration, elements, step.
ORBITS = (
    (1.0, 2.2, 2.0, 600.0, 60, 0.05),
    (1.0, 2.34, 2.0, 1500.0, 60, 0.05),
    (1.0, 2.4, 0.3, 1500.0, 60, 0.05),
    (1.0, 2.6, 0.3, 1500.0, 60, 0.05),
    (1.0, 2.6, 0.3, 1500.0, 120, 0.05),
    (2.0, 4.7, 2.0, 600.0, 60, 0.05),
    (2.0, 5.0, 0.3, 600.0, 60, 0.05),
    (2.0, 5.0, 0.3, 600.0, 60, 0.025),
    (2.0, 5.0, 0.3, 600.0, 120, 0.05),
    (4.0, 7.0, 2.0, 300.0, 60, 0.05),
)
RESTLESS = (("intrinsic", 4.0, 7.0), ("actual", 3.0, 7.0), ("actual", 4.0, 7.0))


def point(program, law, G, S):
    return {
        "disturbed": experiments.disturbed(program, law, G, S),
        "laid": experiments.laid(program, law, G, S),
    }


def all_jobs(quick=False):
    """Name of the result, experiment and its arguments."""
    grid = [(law, G, S) for law in shoot.LAWS for G in GRID_G for S in GRID_S]
    onsets = [("relaxation", G) for G in ONSET_G]
    orbits = [("relaxation", *orbit) for orbit in ORBITS]
    restless = RESTLESS
    if quick:
        grid = [("actual", 2.0, 3.0), ("relaxation", 4.0, 3.0)]
        onsets = [("relaxation", 2.0, 4.0, 6.0, 6, (10, 20))]
        orbits, restless = [("relaxation", 2.0, 5.0, 2.0, 20.0, 20, 0.05)], []
    jobs = [(f"onset_{o[0]}_G{o[1]}", experiments.onset, o) for o in onsets]
    jobs += [(f"orbit_{o[0]}_G{o[1]}_S{o[2]}_n{o[5]}_step{o[6]}", experiments.orbit, o) for o in orbits]
    jobs += [(f"restless_{law}_G{G}_S{S}", experiments.restless, (law, G, S)) for law, G, S in restless]
    jobs += [(f"point_{law}_G{G}_S{S}", point, (law, G, S)) for law, G, S in grid]
    return jobs


def provenance(program, arguments):
    """What a result depends on, as a hash: the program with its libraries, the experiments, their arguments."""
    digest = hashlib.sha256(json.dumps(arguments).encode())
    sources = [pathlib.Path(module.__file__) for module in (experiments, modes, shoot)]
    libraries = sorted(program.parent.parent.glob("libsensory_growth*.so"))
    for path in (program, *libraries, *sources):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def read(results, name, program, arguments):
    """The result of a job, or None if there is none that it would give today."""
    path = results / f"{name}.json"
    if not path.exists():
        return None
    result = json.loads(path.read_text(encoding="utf-8"))
    return result if result["provenance"] == provenance(program, arguments) else None


def run(number, program, results, quick):
    name, experiment, arguments = all_jobs(quick)[number - 1]
    if read(results, name, program, arguments):
        return f"{name}: there already"
    start = time.monotonic()
    measured = experiment(program, *arguments)
    result = {"job": name, "arguments": arguments, "provenance": provenance(program, arguments), **measured}
    results.mkdir(parents=True, exist_ok=True)
    path = results / f"{name}.json"
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
