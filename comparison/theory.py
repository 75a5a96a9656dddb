"""Linear stability of an upright shoot under its weight, for the three growth laws.

With the small angle theta(s) from the vertical, the elastic part of the curvature is u = S int_s^1 (1 - t) theta(t) dt:
what lies above pulls. Rest curvature is theta' - u, so that a mode exp(lambda t) of the laws satisfies

    lambda (D - U) theta = (-G - (D - U)) theta    intrinsic
    lambda (D - U) theta = (-G - D) theta          actual
    lambda (D - U) theta = (-G + U) theta          relaxation

with theta(0) = 0. Chebyshev collocation; independent of the simulator.
"""

import functools

import numpy as np
from scipy.optimize import brentq

from comparison.shoot import GREENHILL

POINTS = 40


def _differentiation(points):
    angles = np.pi * np.arange(points + 1) / points
    nodes = np.cos(angles)
    weights = np.where((np.arange(points + 1) % points) == 0, 2.0, 1.0) * (-1.0) ** np.arange(points + 1)
    matrix = np.outer(weights, 1.0 / weights) / (nodes[:, None] - nodes + np.eye(points + 1))
    matrix -= np.diag(matrix.sum(axis=1))
    return 0.5 * (1.0 - nodes), -2.0 * matrix  # on [0, 1]


def spectrum(law, G, S, points=POINTS):
    """All rates [1 / time of straightening], fastest growing first. They accumulate at the rate of a point of tissue by
    itself (-1, or 0 under relaxation): what is beside it is compact. Those next to it are not resolved."""
    s, D = _differentiation(points)
    backwards = -D
    backwards[-1] = 0.0
    backwards[-1, -1] = 1.0
    no_end = np.eye(points + 1)
    no_end[-1] = 0.0
    U = S * np.linalg.solve(backwards, no_end) @ np.diag(1.0 - s)
    drive = {"intrinsic": U - D, "actual": -D, "relaxation": U}[law] - G * np.eye(points + 1)
    rates = np.linalg.eigvals(np.linalg.solve((D - U)[1:, 1:], drive[1:, 1:]))
    return rates[np.argsort(-rates.real)]


def leading_mode(G, S, points=POINTS):
    """The fastest growing rate under strain relaxation that is not one of those that accumulate at zero, or None."""
    rates = spectrum("relaxation", G, S, points)
    modes = rates[(np.abs(rates) > 0.06 * min(1.0, G)) & (rates.imag >= 0.0)]
    return modes[0] if len(modes) else None


@functools.lru_cache(maxsize=None)
def onset(G):
    """S_H and frequency at which an upright shoot under strain relaxation begins to oscillate, or None below the weight
    under which it falls over anyway."""

    def growth(S):
        mode = leading_mode(G, S)
        return -1.0 if mode is None else mode.real

    weights = np.linspace(0.2, 7.83, 78)
    values = [growth(S) for S in weights]
    for low, high, before, after in zip(weights, weights[1:], values, values[1:]):
        if before < 0.0 <= after:
            S = brentq(growth, low, high, xtol=1e-10)
            return S, abs(leading_mode(G, S).imag)
    return None


def last_onset():
    """G up to which there is an onset below Greenhill's load."""
    return brentq(lambda G: leading_mode(G, GREENHILL - 1e-4).real, 3.0, 3.4)


def rest_tip(G, base=0.5 * np.pi):
    """Tip (x, z) of the one shape in which growth stops under the law of actual curvature, tan(A/2) = tan(base/2)
    exp(-G s), whatever the weight."""
    s = np.linspace(0.0, 1.0, 2001)
    angle = 2.0 * np.arctan(np.tan(0.5 * base) * np.exp(-G * s))
    return np.array([np.trapz(np.sin(angle), s), np.trapz(np.cos(angle), s)])
