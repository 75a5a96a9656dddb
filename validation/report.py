"""docs/validation.md: one table of all comparisons, what fails, and what was found out."""

import math
import os
import pathlib
import platform

from validation.case import Bound, Check

FINDINGS = pathlib.Path(__file__).parent / "findings.md"
FAILS, DID_NOT_RUN = "**fails**", "did not run to its end"

HEAD = """# Validation

Every figure below was measured through a public interface (`batch`: `sensory_growth_batch run` and the bag or table it
writes; `library`: a program on `libsensory_growth`; `node`: the live node, headless, and its bag) and is compared with
one that the simulator had no part in. `./scripts/validate` makes this page anew; `--quick` runs the cases marked with
a star, `--keep` leaves scenarios and bags in `build/validation`.

*Error* is the largest over the components, *order* the order of convergence seen when the resolution is doubled
(elements, or steps where the case says so; the finer run is the one shown); a case fails whose order is less than 1.8,
or than what its tolerance says instead. A figure without error has only to lie in the range that is expected; in P6, P7 and
the last row of V22 that range is set around what was measured, so that a change shows. Cases are numbered as in
[model.md](model.md) (V), whole systems are C, properties P.
"""


def line(result):
    """One line for the terminal, and one for every failure."""
    worst = max((check.error / check.tolerance for check in result.checks if isinstance(check, Check)), default=0.0)
    state = "ok    " if result.passed else "FAILED"
    text = f"{state} {result.case.id:5} {result.case.title}: {worst:.2g} of the tolerance, {result.seconds:.1f} s"
    failures = [f"\n    {_sentence(check)}" for check in result.checks if not check.passed]
    unchecked = "" if result.checks or result.fault else "\n    nothing was checked"
    return text + "".join(failures) + unchecked + (f"\n{result.fault}" if result.fault else "")


def _values(values):
    if len(values) <= 6:
        return ", ".join(f"{value:.7g}" for value in values)
    low, high = min(values), max(values)
    spread = f"{low:.7g}" if math.isclose(low, high, rel_tol=1e-6) else f"{low:.7g} to {high:.7g}"
    return f"{len(values)} times {spread}"


def _range(low, high):
    if math.isinf(low):
        return f"at most {high:.4g}"
    if math.isinf(high):
        return f"at least {low:.4g}"
    return f"{low:.4g} to {high:.4g}"


def _cells(check):
    """Quantity, expected, measured, error, tolerance, order."""
    if isinstance(check, Bound):
        return check.what, _range(check.low, check.high), _values(check.measured), "" if check.passed else FAILS, "", ""
    error = f"{check.error:.1e}" if check.close else f"{check.error:.1e} {FAILS}"
    order = "" if math.isnan(check.order) else f"{check.order:.2f}"
    if not check.converges:
        order += f", at least {check.least_order} {FAILS}"
    return check.what, _values(check.expected), _values(check.measured), error, f"{check.tolerance:.2g}", order


def _sentence(check):
    what, *cells = _cells(check)
    names = ("expected", "measured", "error", "tolerance", "order")
    return f"{what}: " + ", ".join(f"{name} {cell}" for name, cell in zip(names, cells) if cell)


def _row(*cells):
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def _rows(result):
    case = result.case
    rows = [_cells(check) for check in result.checks]
    if result.fault:
        rows.append((DID_NOT_RUN, "", "", FAILS, "", ""))
    elif not rows:
        rows.append(("nothing was checked", "", "", FAILS, "", ""))
    heads = [(f"**{case.id}**{' ★' if case.quick else ''} {case.title}", case.source, f"{result.seconds:.1f} s")]
    heads += [("", "", "")] * (len(rows) - 1)
    for (title, source, seconds), cells in zip(heads, rows):
        yield _row(title, source, *cells, seconds)


def _failures(results):
    lines = [
        f"- **{result.case.id}** {result.case.title}: {'; '.join(result.failures)}"
        for result in results
        if not result.passed
    ]
    return lines or ["No case. What the simulator cannot do is told under [What was found out](#what-was-found-out)."]


def _pictures(results):
    for result in results:
        for picture in result.pictures:
            yield f"![{picture.name}](pictures/validation/{picture.name}.svg)"
            yield ""
            yield f"*{picture.caption}*"
            yield ""


def write(path, results, seconds):
    passed = sum(result.passed for result in results)
    lines = [
        HEAD,
        f"{passed} passed, {len(results) - passed} failed, in {seconds / 60:.1f} minutes on {os.cpu_count()} processors ({platform.machine()}).",
        "",
    ]
    lines += ["## What fails", "", *_failures(results), "", "## Pictures", "", *_pictures(results), "## Cases", ""]
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
