"""docs/validation.md: one table of all comparisons, what fails, and what was found out."""

import math
import pathlib
import platform

FINDINGS = pathlib.Path(__file__).parent / "findings.md"

HEAD = """# Validation

Every figure below was measured through a public interface (`batch`: `sensory_growth_batch run` and the bag or table it
writes; `library`: a program on `libsensory_growth`; `node`: the live node, headless, and its bag) and is compared with
one that the simulator had no part in. `./scripts/validate` makes this page anew; `--quick` runs the cases marked with
a star, `--keep` leaves scenarios and bags in `build/validation`.

*Error* is the largest over the components, *order* the order of convergence seen when the resolution is doubled
(elements, or steps where the case says so; the finer run is the one shown). Cases are numbered as in
[model.md](model.md) (V), whole systems are C, properties P.
"""


def line(result):
    """One line for the terminal."""
    worst = max((check.error / check.tolerance for check in result.checks), default=math.nan)
    state = "ok    " if result.passed else "FAILED"
    text = f"{state} {result.case.id:5} {result.case.title}: {worst:.2g} of the tolerance, {result.seconds:.1f} s"
    failures = [
        f"\n    {check.what}: expected {_values(check.expected)}, measured {_values(check.measured)}, "
        f"error {check.error:.3g}, tolerance {check.tolerance:.3g}"
        for check in result.checks
        if not check.passed
    ]
    return text + "".join(failures) + (f"\n{result.fault}" if result.fault else "")


def _values(values):
    if len(values) > 4:
        low, high = min(values), max(values)
        spread = f"{low:.7g}" if math.isclose(low, high, rel_tol=1e-6) else f"{low:.7g} to {high:.7g}"
        return f"{len(values)} times {spread}"
    return ", ".join(f"{value:.7g}" for value in values)


def _row(*cells):
    return "| " + " | ".join(cells) + " |"


def _rows(result):
    case = result.case
    for index, check in enumerate(result.checks):
        first = index == 0
        yield _row(
            f"**{case.id}**{' ★' if case.quick else ''} {case.title}" if first else "",
            case.source if first else "",
            check.what,
            _values(check.expected),
            _values(check.measured),
            f"{check.error:.1e}" if check.passed else f"**{check.error:.1e} fails**",
            f"{check.tolerance:.0e}",
            "" if math.isnan(check.order) else f"{check.order:.2f}",
            f"{result.seconds:.1f} s" if first else "",
        )


def _failures(results):
    failed = [result for result in results if not result.passed]
    if not failed:
        return ["Nothing."]
    lines = []
    for result in failed:
        what = (
            ", ".join(check.what for check in result.checks if not check.passed)
            or result.fault.strip().splitlines()[-1]
        )
        lines.append(f"- **{result.case.id}** {result.case.title}: {what}")
    return lines


def write(path, results, seconds):
    passed = sum(result.passed for result in results)
    lines = [
        HEAD,
        f"{passed} passed, {len(results) - passed} failed, in {seconds / 60:.1f} minutes on {platform.machine()}.",
        "",
    ]
    lines += ["## What fails", "", *_failures(results), "", "## Cases", ""]
    lines += [
        _row("case", "source", "quantity", "expected", "measured", "error", "tolerance", "order", "time"),
        _row(*["---"] * 9),
    ]
    for result in results:
        lines += _rows(result)
    lines += [
        "",
        "## Interfaces and tolerances",
        "",
        _row("case", "interface", "why this tolerance"),
        _row(*["---"] * 3),
    ]
    lines += [_row(result.case.id, result.case.interface, result.case.why) for result in results]
    lines += ["", FINDINGS.read_text(encoding="utf-8").rstrip(), ""]
    path.write_text("\n".join(lines), encoding="utf-8")
