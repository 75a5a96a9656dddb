"""What a case is, and the list of all of them."""

import math
from dataclasses import dataclass
from typing import Callable

import numpy as np


@dataclass(frozen=True)
class Check:
    """One comparison. Vectors are compared by their largest error."""

    what: str
    expected: tuple
    measured: tuple
    error: float
    tolerance: float
    order: float = math.nan  # observed order of convergence; NaN if it was not measured
    least_order: float = -math.inf

    @property
    def close(self):
        return bool(self.error <= self.tolerance)  # false for NaN

    @property
    def converges(self):
        return not self.order < self.least_order  # true for NaN

    @property
    def passed(self):
        return self.close and self.converges


@dataclass(frozen=True)
class Bound:
    """Figures that must lie in a range; there is no better expectation of them."""

    what: str
    low: float
    high: float
    measured: tuple

    @property
    def passed(self):
        return all(self.low <= value <= self.high for value in self.measured)  # false for NaN


@dataclass(frozen=True)
class Case:
    id: str
    title: str
    source: str  # of the expected figures
    why: str  # the tolerance is what it is
    interface: str  # batch, library or node
    quick: bool  # part of the quick subset
    checks: Callable  # of a Bench; yields Checks and Bounds


@dataclass(frozen=True)
class Result:
    case: Case
    checks: list
    seconds: float
    fault: str  # why the case could not be run to its end, or empty
    pictures: list  # Pictures that it drew

    @property
    def failures(self):
        """What fails, in words; nothing if the case passed."""
        failed = [check.what for check in self.checks if not check.passed]
        if self.fault:
            failed.append(f"did not run to its end: {self.fault.strip().splitlines()[-1]}")
        elif not self.checks:
            failed.append("nothing was checked")
        return failed

    @property
    def passed(self):
        return not self.failures


CASES = []


def case(id, title, source, why, interface="batch", quick=False):
    """Enters a generator of Checks into the list of cases."""

    def enter(checks):
        CASES.append(Case(id, title, source, why, interface, quick, checks))
        return checks

    return enter


def check(what, expected, measured, tolerance, relative=False, order=math.nan, at_least=-math.inf):
    expected, measured = np.atleast_1d(expected).astype(float), np.atleast_1d(measured).astype(float)
    error = np.max(np.abs(measured - expected))
    if relative:
        error /= np.max(np.abs(expected))
    return Check(what, tuple(expected), tuple(measured), float(error), tolerance, order, at_least)


def bounded(what, low, high, measured):
    return Bound(what, low, high, tuple(np.atleast_1d(measured).astype(float)))


def at_most(what, high, measured):
    return bounded(what, -math.inf, high, measured)


def converging(what, expected, measure, coarse, tolerance, relative=False, at_least=1.8, known_to=1e-11):
    """Measures at a coarse resolution and at twice that; the second counts, both tell the order. One less than at_least
    fails. It cannot be told from errors that are not ten times as large as that of the expected figure, known_to so
    small a part of itself."""
    expected = np.atleast_1d(expected).astype(float)
    errors = [np.linalg.norm(np.atleast_1d(measure(coarse)) - expected)]
    measured = np.atleast_1d(measure(2 * coarse))
    errors.append(np.linalg.norm(measured - expected))
    tellable = min(errors) > 10.0 * known_to * max(1.0, np.linalg.norm(expected))
    order = math.log2(errors[0] / errors[1]) if tellable else math.nan
    return check(what, expected, measured, tolerance, relative, order, at_least)
