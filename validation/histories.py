"""Organs that remember: C6."""

import numpy as np

from validation.case import case, check
from validation.scenario import KINEMATIC, RADIUS, UPRIGHT, organ, scenario, stepping
from validation.tropism import apex_angles

STEP = 0.005
SIDE = [1, 0, 0]


def largest_angle(bench, pulses, duration):
    """Largest angle of the tip [deg] of an upright organ that senses light everywhere and forgets it exponentially.
    A pulse is start, end, intensity; pulses do not overlap."""
    protocol = []
    for start, end, intensity in pulses:
        light = {"id": "lamp", "towards": SIDE, "strength": intensity}
        protocol.append({"at": f"{start!r} s", "add": {"light_direction": light}})
        protocol.append({"at": f"{end!r} s", "remove": {"light_direction": {"id": "lamp"}}})
    rod = organ(
        base=UPRIGHT,
        growth={"rate": "1 1/s"},
        sensitivities={"light_direction": 5.0 * RADIUS},
        proprioception={"intrinsic_length": f"{0.5 * RADIUS!r} m"},
        sensing=[
            {
                "cues": ["light_direction"],
                "sensor": {"at": "local"},
                "memory": {"kernel": "exponential", "time_constant": "1 s", "before_start": "zero"},
            }
        ],
    )
    content = scenario(
        rod, relaxation=KINEMATIC, duration=f"{duration!r} s", stepping=stepping(STEP), protocol=protocol
    )
    return np.degrees(np.max(apex_angles(bench.centrelines(content))))


@case(
    "C6",
    "Light pulses: equal doses, and two with a lag",
    "law of Meroz, Bastien and Mahadevan 2019, J. R. Soc. Interface 16:20190038; "
    "figures of a first-order integration with steps of 0.00125 and 400 elements",
    "doses 1e-3, the integration's own error; ratios 2e-3",
)
def pulses(bench):
    for intensity, steps, expected in ((2.0, 50, 71.3378), (10.0, 10, 71.6071), (50.0, 2, 71.6192)):
        measured = largest_angle(bench, [(0.0, steps * STEP, intensity)], 3.0)
        yield check(
            f"intensity {intensity:.0f} for {steps} steps: largest angle [deg]", expected, measured, 1e-3, relative=True
        )
    width = 10 * STEP
    together = largest_angle(bench, [(0.0, width, 0.02)], 4.0)
    for lag, expected in ((0.25, 0.984), (1.0, 0.823), (4.0, 0.518)):
        start = lag / 0.5
        measured = largest_angle(bench, [(0.0, width, 0.01), (start, start + width, 0.01)], start + 3.0)
        yield check(
            f"two pulses, {lag} of the straightening time apart: response over that at once",
            expected,
            measured / together,
            2e-3,
        )
