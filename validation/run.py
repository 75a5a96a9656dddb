"""Runs cases side by side, tells how they go, and writes the report."""

import argparse
import concurrent.futures
import importlib
import os
import pathlib
import sys
import time
import traceback
from concurrent.futures.process import BrokenProcessPool

from validation import report
from validation.bench import Bench
from validation.case import CASES, Result

FAMILIES = ("elastic", "elongation", "tropism", "growth_laws", "histories", "properties", "live")
PACKAGE = pathlib.Path(__file__).resolve().parent.parent


def read_arguments():
    parser = argparse.ArgumentParser(prog="validation.run", description=__doc__)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of the programs under test")
    parser.add_argument("--results", type=pathlib.Path, required=True, help="folder for scenarios and bags")
    parser.add_argument("--report", type=pathlib.Path, help="page to write; its pictures go beside it")
    parser.add_argument("--quick", action="store_true", help="only the cases that are marked so")
    parser.add_argument("--only", default="", metavar="ID,...", help="only these cases")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="cases at a time")
    return parser.parse_args()


def load_cases():
    for family in FAMILIES:
        importlib.import_module(f"validation.{family}")
    return {case.id: case for case in CASES}


def run_case(id, programs, folder, pictures):
    """In a process of its own, where a case goes by its id, since functions do not travel: all of its Result but the
    case."""
    bench = Bench(programs, folder, pictures)
    checks, fault = [], ""
    start = time.monotonic()
    try:
        for check in load_cases()[id].checks(bench):
            checks.append(check)
    except Exception:  # whatever stops a case is its result
        fault = traceback.format_exc(limit=-1)
    return checks, time.monotonic() - start, fault, bench.drawn


def chosen_cases(arguments):
    cases = load_cases()
    if arguments.only:
        wanted = arguments.only.split(",")
        unknown = [id for id in wanted if id not in cases]
        if unknown:
            sys.exit(f"validate: no case {', '.join(unknown)}; there are {', '.join(cases)}")
        return [cases[id] for id in wanted]
    return [case for case in cases.values() if case.quick or not arguments.quick]


def main():
    arguments = read_arguments()
    cases = {case.id: case for case in chosen_cases(arguments)}
    pictures = arguments.report.parent / "pictures" / "validation" if arguments.report else None
    start = time.monotonic()
    results = {}
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        runs = {pool.submit(run_case, id, arguments.programs, arguments.results / id, pictures): id for id in cases}
        for done in concurrent.futures.as_completed(runs):
            id = runs[done]
            try:
                outcome = done.result()
            except BrokenProcessPool:  # the pool is lost, and with it all cases that have not ended
                outcome = [], 0.0, "a process that runs cases was killed", []
            results[id] = Result(cases[id], *outcome)
            print(f"[{len(results)}/{len(cases)}] {report.line(results[id])}", flush=True)
    ordered = [results[id] for id in cases]
    if arguments.report:
        report.write(arguments.report, ordered, time.monotonic() - start)
    passed = sum(result.passed for result in ordered)
    print(f"{passed} passed, {len(ordered) - passed} failed")
    return 0 if passed == len(ordered) else 1


if __name__ == "__main__":
    sys.exit(main())
