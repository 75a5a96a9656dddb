"""What is measured of a shoot under one law, at one G and S."""

import numpy as np

from comparison import shoot
from comparison.modes import leading_mode

STEP = 0.02  # law 2 is stepped explicitly in what weight adds to it, up to 25 times as much on this grid
SMALL = 0.02  # lateral tangent up to which a motion counts as linear
SETTLED = np.radians(1.0)
RESTING = 2e-4  # of the length: what no place moves by in the last tenth of a record
RESOLVED = 0.5  # [rad] at one bend; beyond that a shape is not shown


def disturbed(program, law, G, S, elements=40, duration=None, push=1e-5, step=STEP):
    """How an upright shoot goes on after a push: the rate of its size over the later half of the record; under
    relaxation also rate and frequency of the strongest mode over the last 0.6, with what two halves of that differ by
    as error. One that moves fast is watched again more closely."""
    every = 5
    duration = duration or (120.0 if law == "relaxation" else 40.0)
    content = shoot.scenario(law, G, S, [0, 0, 1], duration, step, elements, push)
    centrelines, _ = shoot.grow(program, content, every)
    lateral = shoot.tangents(centrelines) @ np.array([1.0, 1.0j, 0.0])
    start = round(shoot.FLASHES_END / (every * step)) + 1
    large = np.flatnonzero(np.max(np.abs(lateral[start:]), axis=1) > SMALL)
    end = start + large[0] if len(large) else len(lateral)
    if end - start < 40:
        return disturbed(program, law, G, S, elements, 0.2 * duration, push, 0.2 * step)
    later = np.arange((start + end) // 2, end)
    size = np.sqrt(np.mean(np.abs(lateral[later]) ** 2, axis=1))
    late = {
        "late_rate": float(np.polyfit(later * every * step, np.log(size), 1)[0]),
        "late_times": [float(later[0] * every * step), float(later[-1] * every * step)],
    }
    if law != "relaxation":
        return late
    at = [start + int(part * (end - start)) for part in (0.4, 0.7, 1.0)]
    parts = ((at[0], at[2]), (at[0], at[1]), (at[1], at[2]))
    mode, *halves = [leading_mode(lateral[first:last].T, every * step) for first, last in parts]
    names = ("rate", "frequency", "rate_error", "frequency_error")
    return late | dict(zip(names, map(float, (*mode, *np.ptp(halves, axis=0)))))


def beyond_upright(angle):
    """How far the first swing of a tip goes beyond upright."""
    passed = np.flatnonzero(angle < 0.0)
    if not len(passed):
        return 0.0
    swing = angle[passed[0] :]
    lowest = np.minimum.accumulate(swing)
    back = np.flatnonzero(swing > lowest + np.radians(0.5))
    return float(-lowest[back[0] if len(back) else -1])


def laid(program, law, G, S, elements=80, step=0.05):
    """A straight shoot laid on its side: whether and where it comes to rest, how far beyond that and beyond upright it
    went, how long it took. Under relaxation a shoot at a horizontal clamp never rests; that one is followed until it is
    wound up."""
    duration = 600.0 / G if law == "relaxation" else 40.0
    content = shoot.scenario(law, G, S, [1, 0, 0], duration, step, elements)
    centrelines, ended = shoot.grow(program, content)
    tangent = shoot.tip_tangents(centrelines)
    angle = np.unwrap(np.arctan2(tangent[:, 0], tangent[:, 2]))  # from upright, towards where the base points
    last = centrelines[-len(centrelines) // 10 :]
    resting = ended and np.max(np.abs(last - last[-1])) < RESTING
    away = np.flatnonzero(np.abs(angle - angle[-1]) > SETTLED)
    unresolved = np.flatnonzero(shoot.largest_turns(centrelines) > RESOLVED)
    shown = unresolved[0] if len(unresolved) else len(centrelines)
    thinned = 4
    return {
        "ended": ended,
        "end_time": (len(centrelines) - 1) * step,
        "rests": bool(resting),
        "largest_jump": float(np.max(np.linalg.norm(np.diff(last, axis=0), axis=2))),  # of any place between frames
        "tip_angle": float(np.degrees(angle[-1])),
        "tip": centrelines[-1, -1].tolist(),
        "aside": float(np.max(np.abs(centrelines[-1, :, 1]))),  # out of the plane it was laid in
        "overshoot": float(np.degrees(max(0.0, angle[-1] - np.min(angle)))) if resting else None,
        "beyond_upright": np.degrees(beyond_upright(angle)),
        "settling_time": float((away[-1] + 1) * step) if resting and len(away) else None,
        "angles": np.round(np.degrees(angle[:shown:thinned]), 3).tolist(),
        "frame_time": step * thinned,
        "shape": np.round(centrelines[shown - 1][:, [0, 2]], 5).tolist(),
    }


def restless(program, law, G, S, steps=(0.1, 0.05, 0.02, 0.01)):
    """Whether what a shoot laid on its side does at the end depends on the step of time."""
    runs = [laid(program, law, G, S, step=step) for step in steps]
    kept = ("rests", "largest_jump", "tip")
    return {"runs": [{"step": step} | {key: run[key] for key in kept} for step, run in zip(steps, runs)]}


def orbit(program, law, G, S, push, duration, elements, step):
    """A shoot pushed so far that its motion is no longer small: its tip, its sharpest bend and its twist over time."""
    every = round(0.2 / step)
    content = shoot.scenario(law, G, S, [0, 0, 1], duration, step, elements, push)
    tips, curvatures, ended = shoot.record(program, content, every)
    return {
        "ended": ended,
        "frame_time": step * every,
        "tip": np.round(tips, 4).tolist(),
        "bending": np.round(np.max(np.hypot(curvatures[:, :, 0], curvatures[:, :, 1]), axis=1), 4).tolist(),
        "twist": np.round(np.max(np.abs(curvatures[:, :, 2]), axis=1), 4).tolist(),
    }


def onset(program, law, G, low=0.05, high=7.6, halvings=12, elements=(20, 40)):
    """The weight at which an upright shoot begins to swing by itself, by bisection at two resolutions, extrapolated at
    second order. The error is what the last brackets leave open, the whole extrapolation, and what reading the rate
    leaves open; that of the frequency also what it changes by over the error of the onset."""
    found = []
    for count in elements:
        growing = disturbed(program, law, G, high, count)
        if growing["rate"] <= 0.0:
            return {"onset": None, "heaviest": high, "rate_there": growing["rate"]}
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
