"""Properties that hold without a figure: division, order in time, roll, statics against dynamics."""

import math

import numpy as np

from validation.case import at_most, bounded, case, check
from validation.elastic import extensible
from validation.growth_laws import laid
from validation.scenario import KINEMATIC, RADIUS, UPRIGHT, changed, organ, scenario, stepping, vector, weight


def order(coarse, middle, fine):
    """Of convergence, from three results each at twice the resolution of the one before."""
    return math.log2(np.linalg.norm(coarse - middle) / np.linalg.norm(middle - fine))


@case("P1", "Division keeps a helix", "constant curvature stays constant (docs/model.md 10)", "round-off", quick=True)
def helix(bench):
    rod = organ(
        elements=10,
        base=UPRIGHT,
        rest_curvature=vector("1/m", 0, 2, 3),
        division={"longest_element": "2 cm"},
    )
    state = bench.last(scenario(rod))
    yield check("elements, of 10", 80, len(state.curvature), 0.5)
    yield check("rest curvature", np.tile([0.0, 2.0, 3.0], 80), state.rest_curvature.ravel(), 1e-11)
    yield check("curvature", np.tile([0.0, 2.0, 3.0], 80), state.curvature.ravel(), 1e-9)


@case(
    "P2",
    "Second order in time under weight",
    "order 2 of the growth step (docs/model.md 11)",
    "0.2: three step sizes, no closed form",
)
def order_in_time(bench):
    for law in ("intrinsic_length", "actual_length", "relaxation_length"):

        def tip(steps):
            content = laid(law, 2.0, 0.5, 30, 0.5)
            elongating = changed(content["organs"][0], {"growth": {"elongation": None}})
            return bench.last(changed(content, {"organs": [elongating], "stepping": stepping(1.0 / steps)})).tip

        tips = [tip(steps) for steps in (40, 80, 160)]
        yield check(f"{law}: order", 2.0, order(*tips), 0.2)


@case(
    "P3",
    "Halving the way of the tip per step",
    "second order (cases, C5)",
    "0.3: step sizes are rounded to whole parts",
)
def way_of_the_tip(bench):
    def tip(limit):
        rod = organ(
            elements=50,
            radius="10 cm",
            growth={"profile": "logistic", "rate": "1 1/s", "zone_length": "50 cm", "steepness": 5, "elongation": None},
            sensitivities={"light_direction": 0.1},
            proprioception={"intrinsic_length": "0.01 m"},
        )
        content = scenario(
            rod, relaxation=KINEMATIC, duration="1 s", stepping=stepping(1.0, limits={"tip_advance": limit})
        )
        content["organs"][0]["division"] = {
            "longest_element": "20 cm"
        }  # of which the limit is a fraction; none divides
        content["stimuli"] = {"light_directions": [{"id": "sun", "towards": [0, 0, 1], "strength": 1}]}
        return bench.last(content).tip

    yield check("order", 2.0, order(*[tip(limit) for limit in (0.08, 0.04, 0.02)]), 0.3)


@case(
    "P4",
    "The roll of the base does not matter",
    "the same centreline (docs/model.md 4.3)",
    "round-off, of the statics 1e-9",
    quick=True,
)
def roll(bench):
    def centreline(degrees):
        rod = organ(
            elements=40,
            base={"direction": [1, 0.3, 0], "roll": f"{degrees} deg"},
            growth={"rate": "1 1/s", "elongation": None},
            sensitivities={"gravity": 0.1, "light_direction": 0.05},
            proprioception={"actual_length": "0.03 m"},
            **weight(2.0),
        )
        content = scenario(rod, weight=True, duration="1 s", stepping=stepping(0.05))
        content["stimuli"] = {"light_directions": [{"id": "sun", "towards": [0, 1, 1], "strength": 1}]}
        return bench.last(content).positions

    upright = centreline(0)
    for degrees in (73, 180):
        yield at_most(f"largest distance at {degrees}°", 1e-9, np.max(np.abs(centreline(degrees) - upright)))


@case("P5", "Statics and damped dynamics", "the same equilibrium (docs/model.md 13)", "1e-8 of the length")
def dynamics(bench):
    def positions(relaxation):
        area = math.pi * RADIUS**2
        axial = 4.0 / RADIUS**2  # E I = 1
        rod = organ(elements=20, material=extensible(axial / area, axial / area / 3.0, density=10.0 / area))
        return bench.last(scenario(rod, weight=True, relaxation=relaxation)).positions

    motion = positions({"method": "dynamic", "tolerance": 1e-11})
    yield at_most("largest distance, β = 10", 1e-8, np.max(np.abs(motion - positions({"method": "static"}))))


@case(
    "P6",
    "Law 2 near self-buckling needs short steps",
    "steps beyond 2 (1 - S/S_c) of the straightening time, here 0.086, diverge (docs/model.md 11.1)",
    "upright to 1e-2 of the length, or leaning by more than ten times that",
)
def short_steps(bench):
    def leaning(step):
        rod = organ(
            elements=40,
            base={"direction": [1e-3, 0, 1]},
            growth={"rate": "1 1/s"},
            sensitivities={"gravity": RADIUS},
            proprioception={"intrinsic_length": None, "actual_length": f"{RADIUS!r} m"},
            **weight(7.5),
        )
        return bench.last(scenario(rod, weight=True, duration="60 s", stepping=stepping(step))).tip[0]

    yield bounded("S = 7.5, steps of 0.05: tip aside, over L", 0.0, 0.01, leaning(0.05))
    yield bounded("S = 7.5, steps of 0.1: tip aside, over L", 0.1, 1.0, leaning(0.1))


@case(
    "P7",
    "A buckled organ with rest twist",
    "nothing holds its azimuth, and nothing turns it",
    "3° in ten steps; see what was found out",
)
def free_azimuth(bench):
    for twist, bound in ((0.0, 1e-9), (2.0, 3.0)):
        rod = organ(
            elements=40,
            base=UPRIGHT,
            rest_curvature=vector("1/m", 0, 0, twist),
            **weight(9.0),
        )
        tips = [state.tip for state in bench.states(scenario(rod, weight=True, duration="20 s"))["organ"]]
        azimuths = np.unwrap([math.atan2(tip[1], tip[0]) for tip in tips])
        drift = np.degrees(abs(azimuths[-1] - azimuths[-11]))
        yield at_most(f"rest twist {twist:.0f}/L, no growth: drift of the azimuth in ten steps [deg]", bound, drift)
