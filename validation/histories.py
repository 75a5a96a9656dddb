"""Organs that remember: C6."""

import numpy as np

from validation import closed_forms
from validation.case import case, check
from validation.scenario import KINEMATIC, RADIUS, UPRIGHT, organ, scenario, stepping
from validation.tropism import apex_angles

STEP = 0.005  # of the coarse figures
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


def intensities(pulses, duration):
    """The same, step by step."""
    times = STEP * (np.arange(round(duration / STEP)) + 0.5)
    return sum(intensity * ((start < times) & (times < end)) for start, end, intensity in pulses)


@case(
    "C6",
    "Light pulses: equal doses, and two with a lag",
    "law of Meroz, Bastien and Mahadevan 2019, J. R. Soc. Interface 16:20190038, integrated with 200 cells by RK4; "
    "beside it the coarse figures that the cases were given with",
    "1e-4 of the integration, 1 % asked; that the coarse figures come from the coarse scheme shows to their last digit",
)
def pulses(bench):
    doses = {2.0: (50, 70.855), 10.0: (10, 71.123), 50.0: (2, 71.135)}
    for intensity, (steps, figure) in doses.items():
        dose = [(0.0, steps * STEP, intensity)]
        lit = intensities(dose, 3.0)
        expected = np.degrees(closed_forms.largest_answer_to_light(lit, STEP))
        what = f"intensity {intensity:.0f} for {steps} steps: largest angle [deg]"
        measured = largest_angle(bench, dose, 3.0)
        yield check(what, expected, measured, 1e-4, relative=True)
        yield check(f"{what}, coarse figure", figure, measured, 0.01, relative=True)
        coarse = np.degrees(closed_forms.coarse_answer_to_light(lit, STEP))
        yield check(f"{what}, coarse figure, by the coarse scheme", figure, coarse, 5e-4)
    width = 10 * STEP
    together = [(0.0, width, 0.02)]
    at_once = largest_angle(bench, together, 4.0)
    for lag, figure in ((0.25, 0.984), (1.0, 0.823), (4.0, 0.518)):
        start = lag / 0.5
        apart, duration = [(0.0, width, 0.01), (start, start + width, 0.01)], start + 3.0
        answers = [closed_forms.largest_answer_to_light(intensities(lit, duration), STEP) for lit in (apart, together)]
        measured = largest_angle(bench, apart, duration) / at_once
        what = f"two pulses, {lag} of the straightening time apart: response over that at once"
        yield check(what, answers[0] / answers[1], measured, 1e-4)
        yield check(f"{what}, coarse figure", figure, measured, 0.01, relative=True)
