"""The page of the comparison with its pictures, from the result files of its jobs."""

import argparse
import pathlib
import re
import sys

from comparison import pictures, tables, theory
from comparison.behaviour import select
from comparison.job import all_jobs, read

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "three_growth_models.md"
TEMPLATE = pathlib.Path(__file__).parent / "page.md"
AGREEMENT = 0.01  # of the onset, with the theory


def load(results, program, quick):
    jobs = all_jobs(quick)
    found = {name: read(results, name, program, arguments) for name, _, arguments in jobs}
    missing = [name for name, result in found.items() if result is None]
    if missing:
        sys.exit(f"comparison: {len(missing)} of {len(found)} results are missing or stale, such as {missing[0]}")
    return found


def check(results):
    """That the onsets are where the theory has them."""
    for (_, G, *_), r in select(results, "onset"):
        predicted = theory.onset(G)
        if (r["onset"] is None) != (predicted is None):
            sys.exit(f"comparison: an onset at G = {G} is found by only one of simulation and theory")
        if predicted and abs(r["onset"] / predicted[0] - 1.0) > AGREEMENT:
            sys.exit(f"comparison: at G = {G} the onset is at {r['onset']:.4f}, by the theory at {predicted[0]:.4f}")


def page(results):
    parts = (
        tables.quoted_of_rest(results)
        | tables.quoted_of_motion(results)
        | {
            "onsets": tables.onset_table(results),
            "orbits": tables.orbit_table(results),
            "restless": tables.restless_table(results),
            "grid": tables.grid_table(results),
            "stems": tables.stem_table(),
            "swings": tables.swing_table(results),
        }
    )
    return re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], TEMPLATE.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(prog="comparison.report", description=__doc__)
    parser.add_argument("--results", type=pathlib.Path, required=True)
    parser.add_argument("--program", type=pathlib.Path, required=True, help="sensory_growth_batch that made them")
    parser.add_argument("--quick", action="store_true", help="print tables of the quick jobs, write nothing")
    arguments = parser.parse_args()
    results = load(arguments.results, arguments.program, arguments.quick)
    check(results)
    if arguments.quick:
        print(*(make(results) for make in (tables.onset_table, tables.orbit_table, tables.grid_table)), sep="\n\n")
        return
    pictures.draw(results)
    PAGE.write_text(page(results), encoding="utf-8")
    print(PAGE)


if __name__ == "__main__":
    main()
