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

    @property
    def passed(self):
        return bool(self.error <= self.tolerance)  # false for NaN


@dataclass(frozen=True)
class Case:
    id: str
    title: str
    source: str  # of the expected figures
    why: str  # the tolerance is what it is
    interface: str  # batch, library or node
    quick: bool  # part of the quick subset
    checks: Callable  # of a Bench; yields Checks


@dataclass(frozen=True)
class Result:
    case: Case
    checks: list
    seconds: float
    fault: str  # why the case could not be run to its end, or empty

    @property
    def passed(self):
        return bool(self.checks) and not self.fault and all(check.passed for check in self.checks)


CASES = []


def case(id, title, source, why, interface="batch", quick=False):
    """Enters a generator of Checks into the list of cases."""

    def enter(checks):
        CASES.append(Case(id, title, source, why, interface, quick, checks))
        return checks

    return enter


def check(what, expected, measured, tolerance, relative=False, order=math.nan):
    expected, measured = np.atleast_1d(expected).astype(float), np.atleast_1d(measured).astype(float)
    error = np.max(np.abs(measured - expected))
    if relative:
        error /= np.max(np.abs(expected))
    return Check(what, tuple(expected), tuple(measured), float(error), tolerance, order)


def at_most(what, bound, measured):
    """A figure that only has to be small: the bound is its tolerance."""
    return check(what, 0.0, measured, bound)


def converging(what, expected, measure, coarse, tolerance, relative=False):
    """Measures at a coarse resolution and at twice that; the second counts, both tell the order."""
    expected = np.atleast_1d(expected).astype(float)
    errors = [np.linalg.norm(np.atleast_1d(measure(coarse)) - expected)]
    measured = np.atleast_1d(measure(2 * coarse))
    errors.append(np.linalg.norm(measured - expected))
    round_off = 1e-10 * max(1.0, np.linalg.norm(expected))
    order = math.log2(errors[0] / errors[1]) if min(errors) > round_off else math.nan
    return check(what, expected, measured, tolerance, relative, order)
