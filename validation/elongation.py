"""Growth of length, division and rest curvature without elasticity: V12, V18, C4, C5."""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erf

from validation.case import at_most, case, check, converging
from validation.scenario import KINEMATIC, UPRIGHT, organ, scenario, stepping, vector


def growing(length, growth, duration, step, elements=40, longest="inf", **changes):
    rod = organ(
        length=f"{length!r} m",
        elements=elements,
        growth={"elongation": None, **growth},
        division={"longest_element": longest},
        **changes,
    )
    return scenario(rod, relaxation=KINEMATIC, duration=f"{duration!r} s", stepping=stepping(step))


def grown_length(speed, length, duration):
    """Length after growth whose tip moves at speed(length)."""
    solution = solve_ivp(lambda t, L: speed(L[0]), (0.0, duration), [length], method="DOP853", rtol=1e-11, atol=1e-12)
    return solution.y[0, -1]


FLAT = {"profile": "apical_flat", "rate": "1 1/s", "zone_length": "1 m"}


def logistic(steepness):
    return {"profile": "logistic", "rate": "1 1/s", "zone_length": "1 m", "steepness": steepness}


def logistic_speed(steepness):
    return lambda L: (np.logaddexp(0.0, steepness) - np.logaddexp(0.0, steepness * (1.0 - L))) / steepness


def gaussian_speed(L):
    width = math.sqrt(2.0 / math.pi)
    return width * math.sqrt(math.pi / 2.0) * erf(L / (math.sqrt(2.0) * width))


@case("V12a", "Uniform growth", "L = L₀ exp(ε t)", "RK4 on the logarithm of lengths is exact here", quick=True)
def uniform(bench):
    content = growing(1.0, {"profile": "uniform", "rate": "0.5 1/s"}, 3.0, 0.1)
    yield check("length", math.exp(1.5), bench.last(content).rest_length, 1e-12, relative=True)


@case(
    "V12b",
    "Logistic growth zone",
    "dL/dt = velocity of the tip in closed form, integrated by DOP853",
    "fourth order in the step; 1e-5 at a step of 0.1",
)
def logistic_zone(bench):
    for length, duration in ((1.0, 5.0), (0.2, 5.0), (5.0, 2.0)):
        expected = grown_length(logistic_speed(15.0), length, duration)
        measure = lambda parts: bench.last(growing(length, logistic(15.0), duration, 1.0 / parts)).rest_length
        yield converging(f"length from {length} m (steps doubled)", expected, measure, 5, 1e-5)


@case(
    "V12c",
    "Other growth zones",
    "velocities of the tip in closed form, integrated by DOP853",
    "as V12b; the edge of the flat zone crosses elements, hence 1e-3",
)
def other_zones(bench):
    gaussian = {"profile": "apical_gaussian", "rate": "1 1/s", "zone_length": "1 m"}
    zones = (
        ("flat", FLAT, lambda L: min(L, 1.0), 1e-3),
        ("Gaussian", gaussian, gaussian_speed, 1e-5),
        ("logistic, m = 5", logistic(5), logistic_speed(5.0), 1e-5),
    )
    for name, growth, speed, tolerance in zones:
        for length in (0.5, 2.0):
            expected = grown_length(speed, length, 2.0)
            measured = bench.last(growing(length, growth, 2.0, 0.05)).rest_length
            yield check(f"{name}: length from {length} m", expected, measured, tolerance)


@case(
    "V12d", "A curved organ turns as it grows", "carried rest curvature: angle κ L₀ exp(ε t)", "exact but for round-off"
)
def passive_drift(bench):
    content = growing(
        1.0, {"profile": "uniform", "rate": "1 1/s"}, 1.0, 0.1, base=UPRIGHT, rest_curvature=vector("1/m", 0, 0.5, 0)
    )
    state = bench.last(content)
    yield check("angle of the apex", 0.5 * math.e, math.atan2(state.tangent[0], state.tangent[2]), 1e-9)


def material_cue(elements, step):
    """A cue that stays with the tissue: an oscillator that hardly turns."""
    return growing(
        2.0,
        {**FLAT},
        3.0,
        step,
        elements,
        f"{2.0 / elements!r} m",
        radius="10 cm",
        base=UPRIGHT,
        circumnutation={"form": "oscillator", "period": "1e12 s", "amplitude": 0.05, "phase": "0 rad"},
    )


@case(
    "V18",
    "Flat zone under a cue fixed in the tissue",
    "what each point gathers on its way through the zone, integrated: 3.75 from base to apex",
    "5e-4 with elements of 0.05 and steps of 0.02: the edge of the zone crosses elements",
)
def zone_with_material_cue(bench):
    # Turn per length: (delta / R) clip(T - (xi - 1), 0, T) at the distance xi from the tip; L = 5.
    xi = np.linspace(0.0, 5.0, 500001)
    turn = np.trapz(0.5 * np.clip(3.0 - (xi - 1.0), 0.0, 3.0), xi)
    state = bench.last(material_cue(40, 0.02))
    lengths = np.diff(state.arc_length)
    cells = 0.5 * (np.append(0.0, lengths[:-1]) + lengths)
    cells[-1] += 0.5 * lengths[-1]  # the last curvature holds up to the apex
    yield check("turn from base to apex", turn, cells @ state.rest_curvature[:, 1], 5e-4)
    yield check("length", 5.0, state.rest_length, 5e-4)


@case(
    "C5",
    "A flat growth zone of 6 cm at 1/(20 h), as of a sunflower seedling",
    "L = L₀ + l t/τ beyond the zone, exponential within it; 3.0 mm/h",
    "1e-6 with elements that divide, at the edge of a zone that does not lie on a vertex",
)
def kinematics(bench):
    zone, time_scale = 6.0, 20.0  # cm, h
    for start, duration in ((8.0, 30.0), (3.0, 40.0)):
        first = max(0.0, time_scale * math.log(zone / start))
        expected = max(start, zone) + zone * (duration - first) / time_scale
        rod = organ(
            length=f"{start} cm",
            elements=40,
            radius="1 mm",
            growth={"profile": "apical_flat", "rate": "0.05 1/h", "zone_length": "6 cm", "elongation": None},
            division={"longest_element": f"{start / 40.0} cm"},
        )
        content = scenario(rod, relaxation=KINEMATIC, duration=f"{duration} h", stepping={"step": "15 min"})
        states = bench.states(content)["organ"]
        yield check(
            f"length from {start} cm after {duration:.0f} h [cm]",
            expected,
            100.0 * states[-1].rest_length,
            1e-3,
            relative=True,
        )
        yield at_most(f"length from {start} cm: fewer than 5 divisions seen", 0.5, sum(s.divisions for s in states) < 5)
    # Tissue at the distance d from the tip leaves the zone with the stretch l / d.
    growth = {"profile": "apical_flat", "rate": "0.05 1/h", "zone_length": "6 cm", "elongation": None}
    rod = organ(length="8 cm", elements=400, radius="1 mm", growth=growth)
    state = bench.last(scenario(rod, relaxation=KINEMATIC, duration="30 h", stepping={"step": "15 min"}))
    vertices = [round(400 * (8.0 - distance) / 8.0) for distance in (4.0, 3.0)]
    measured = 100.0 * np.diff(state.arc_length[vertices])
    yield check("tissue that stood 4 to 3 cm from the tip is so long [cm]", zone * math.log(4.0 / 3.0), measured, 1e-3)


# The published kinematic model has no R in its drive and E = 0.1 with L_gz = 1: lambda and gamma are those of its code.
PORAT = {
    "const": ((1.64366, 0, 0.50690), (2.64718, 0, 0.46041), (3.64728, 0, 0.47061)),
    "point": ((1.03842, -1.03842, 1.11393), (1.25863, -1.25863, 0.44381), (0.94995, -0.94995, 1.61932)),
    "cn": ((0.12070, 0.23753, 1.97516), (0.10677, 0.58720, 2.92014), (-0.02198, 0.86392, 3.88105)),
}


@case(
    "C4",
    "Sensory growth without elasticity",
    "Porat, Tedone, Palladino, Marcati and Meroz 2020, Front. Robot. AI 7:89: parameters of "
    "the published code; tips of an independent second-order solver",
    "2e-3: the figures' own error with 200 elements and more",
)
def porat(bench):
    elements, step = 200, 0.05
    for name, tips in PORAT.items():
        changes = {"radius": "10 cm", "base": UPRIGHT, "proprioception": {"intrinsic_length": "0.1 m"}}
        stimuli = {}
        if name == "const":
            changes["sensitivities"] = {"light_direction": 1}
            stimuli = {"light_directions": [{"id": "sun", "towards": [1, 0, 0], "strength": 1}]}
        elif name == "point":
            changes["sensitivities"] = {"point_source": 1, "softening_length": "0 m"}
            stimuli = {"point_sources": [{"id": "lamp", "position": vector("m", 1, -1, 1), "strength": 1}]}
        else:
            changes["circumnutation"] = {
                "form": "oscillator",
                "period": f"{math.pi!r} s",
                "amplitude": 0.5,
                "phase": "0 rad",
            }
        growth = {"profile": "apical_flat", "rate": "0.1 1/s", "zone_length": "1 m"}
        content = growing(1.0, growth, 30.0, step, elements, f"{1.0 / elements!r} m", **changes)
        content["stimuli"] = stimuli
        centrelines = bench.centrelines(content, every=200)
        for frame, expected in enumerate(tips, start=1):
            yield check(f"{name}: tip at t = {10 * frame}", expected, centrelines[frame][-1], 2e-3)
