"""What is measured of a shoot under one law, at one G and S."""

import numpy as np

from comparison import shoot
from comparison.modes import leading_mode

STEP = 0.02  # law 2 is stepped explicitly in what weight adds to it, up to 25 times as much on this grid
SMALL = 0.02  # lateral tangent up to which a motion counts as linear
SETTLED = np.radians(1.0)
RESTING = np.radians(0.01)


def disturbed(program, law, G, S, elements=40, duration=120.0, push=1e-5, step=STEP):
    """Rate and frequency of an upright shoot after a push, with the spread over two parts of the record as error. One
    that moves fast is watched again more closely."""
    every = 5
    content = shoot.scenario(law, G, S, [0, 0, 1], duration, step, elements, push)
    centrelines, _ = shoot.grow(program, content, every)
    lateral = shoot.tangents(centrelines) @ np.array([1.0, 1.0j, 0.0])
    start = round(shoot.FLASHES_END / (every * step)) + 1
    size = np.max(np.abs(lateral), axis=1)
    begin = size[start]
    usable = np.flatnonzero((size[start:] > SMALL) | (size[start:] < 1e-4 * begin))
    end = start + (usable[0] if len(usable) else len(size) - start)
    if end - start < 40:
        return disturbed(program, law, G, S, elements, 0.2 * duration, push, 0.2 * step)
    estimates = []
    for part in (0.4, 0.6):
        first = start + int(part * (end - start))
        estimates.append(leading_mode(lateral[first:end].T, every * step))
    (rate, frequency), spread = estimates[0], np.ptp(estimates, axis=0)
    names = ("rate", "frequency", "rate_error", "frequency_error")
    return dict(zip(names, map(float, (rate, frequency, *spread))))


def laid(program, law, G, S, elements=80, duration=40.0):
    """A straight shoot laid on its side: where it comes to rest, how far beyond it went, how long that took."""
    step, every = 0.05, 2
    content = shoot.scenario(law, G, S, [1, 0, 0], duration, step, elements)
    centrelines, ended = shoot.grow(program, content, every)
    tangent = shoot.tip_tangents(centrelines)
    angle = np.unwrap(np.arctan2(tangent[:, 0], tangent[:, 2]))  # from upright, towards where the base points
    resting = ended and np.ptp(angle[-len(angle) // 10 :]) < RESTING
    away = np.flatnonzero(np.abs(angle - angle[-1]) > SETTLED)
    return {
        "rests": bool(resting),
        "tip_angle": float(np.degrees(angle[-1])),
        "tip": [float(value) for value in centrelines[-1, -1]],
        "aside": float(np.max(np.abs(centrelines[-1, :, 1]))),  # out of the plane it was laid in
        "overshoot": float(np.degrees(max(0.0, angle[-1] - np.min(angle)))) if resting else None,
        "beyond_upright": float(np.degrees(max(0.0, -np.min(angle)))),
        "settling_time": float((away[-1] + 1) * step * every) if resting and len(away) else None,
        "angles": [round(float(value), 3) for value in np.degrees(angle)],
        "frame_time": step * every,
        "shape": [[round(float(x), 5) for x in point] for point in centrelines[-1, :, [0, 2]].T],
    }


def orbit(program, law, G, S, push, duration, elements):
    """A shoot pushed so far that its motion is no longer small: its tip over time, and its largest curvature."""
    step, every = 0.05, 4
    content = shoot.scenario(law, G, S, [0, 0, 1], duration, step, elements, push)
    centrelines, ended = shoot.grow(program, content, every)
    turns = np.arccos(
        np.clip(np.sum(np.diff(shoot.tangents(centrelines), axis=1) ** 2, axis=2) / -2.0 + 1.0, -1.0, 1.0)
    )
    return {
        "ended": ended,
        "frame_time": step * every,
        "tip": np.round(centrelines[:, -1], 4).tolist(),
        "largest_curvature": np.round(elements * turns.max(axis=1), 3).tolist(),
        "shape": np.round(centrelines[-1], 5).tolist(),
    }


def onset(program, law, G, low=0.05, high=7.6, halvings=12, elements=(20, 40)):
    """The weight at which an upright shoot begins to swing by itself, by bisection at two resolutions, extrapolated at
    second order. The error is what the last brackets leave open, the whole extrapolation, and what reading the rate
    leaves open; that of the frequency also what it changes by over the error of the onset."""
    found = []
    for count in elements:
        growing = disturbed(program, law, G, high, count)
        if growing["rate"] <= 0.0:
            return {"onset": None, "rate_below_greenhill": growing["rate"]}
        bracket = [low, high]
        for _ in range(halvings):
            middle = 0.5 * sum(bracket)
            measured = disturbed(program, law, G, middle, count)
            bracket[measured["rate"] > 0.0] = middle
        found.append((0.5 * sum(bracket), measured))
    (coarse, before), (fine, measured) = found
    beyond = disturbed(program, law, G, 1.02 * fine, elements[1])
    slope, frequency_slope = ((beyond[name] - measured[name]) / (0.02 * fine) for name in ("rate", "frequency"))
    shift = (fine - coarse) / 3.0
    frequency_shift = (measured["frequency"] - before["frequency"]) / 3.0
    half_brackets = (4.0 + 1.0) / 3.0 * (high - low) / 2.0 ** (halvings + 1)  # of (4 fine - coarse) / 3
    error = half_brackets + abs(shift) + measured["rate_error"] / abs(slope)
    return {
        "onset": fine + shift,
        "error": error,
        "at_resolutions": [coarse, fine],
        "frequency": measured["frequency"] + frequency_shift,
        "frequency_error": abs(frequency_shift) + measured["frequency_error"] + abs(frequency_slope) * error,
    }
