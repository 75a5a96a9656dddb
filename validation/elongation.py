"""Growth of length, division and rest curvature without elasticity: V12, V18, C4, C5."""

import functools
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erf

from validation.case import bounded, case, check, converging
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
    "fourth order in the step; 1e-5 at a step of 0.1. Speeds to 1e-8 at 1/40, for what they exceed 1 by",
)
def logistic_zone(bench):
    for length, duration in ((1.0, 5.0), (0.2, 5.0), (5.0, 2.0)):
        expected = grown_length(logistic_speed(15.0), length, duration)
        measure = lambda parts: bench.last(growing(length, logistic(15.0), duration, 1.0 / parts)).rest_length
        yield converging(f"length from {length} m (steps doubled)", expected, measure, 5, 1e-5, at_least=3.8)
    for steepness in (15.0, 5.0):
        speed = math.log1p(math.exp(steepness)) / steepness

        def measured(parts):
            state = bench.last(growing(20.0, logistic(steepness), 2.0, 1.0 / parts, elements=200))
            return (state.rest_length - 20.0) / 2.0

        what = f"by how much the speed of a long organ exceeds 1, m = {steepness:.0f} (steps doubled)"
        yield converging(what, speed - 1.0, lambda parts: measured(parts) - 1.0, 20, 1e-8, at_least=3.8)


@case(
    "V12c",
    "Other growth zones",
    "velocities of the tip in closed form, integrated by DOP853",
    "as V12b; the edge of the flat zone crosses elements, hence 1e-3 and no order",
)
def other_zones(bench):
    gaussian = {"profile": "apical_gaussian", "rate": "1 1/s", "zone_length": "1 m"}
    smooth = (("Gaussian", gaussian, gaussian_speed), ("logistic, m = 5", logistic(5), logistic_speed(5.0)))
    for length in (0.5, 2.0):
        grown = lambda growth, parts: bench.last(growing(length, growth, 2.0, 1.0 / parts)).rest_length
        expected = grown_length(lambda L: min(L, 1.0), length, 2.0)
        yield check(f"flat: length from {length} m", expected, grown(FLAT, 20), 1e-3)
        for name, growth, speed in smooth:
            expected = grown_length(speed, length, 2.0)
            measure = lambda parts: grown(growth, parts)
            what = f"{name}: length from {length} m (steps doubled)"
            yield converging(what, expected, measure, 10, 1e-5, at_least=3.8)


@case(
    "V12d", "A curved organ turns as it grows", "carried rest curvature: angle κ L₀ exp(ε t)", "exact but for round-off"
)
def passive_drift(bench):
    content = growing(
        1.0, {"profile": "uniform", "rate": "1 1/s"}, 1.0, 0.1, base=UPRIGHT, rest_curvature=vector("1/m", 0, 0.5, 0)
    )
    state = bench.last(content)
    yield check("angle of the apex", 0.5 * math.e, math.atan2(state.tangent[0], state.tangent[2]), 1e-12)


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
    "what each point gathers on its way through the zone, (δ/R) clip(ε t - (ξ - l)/l, 0, ε t) at ξ from the tip",
    "turns 5e-4 with elements of 0.05 and steps of 0.02. Curvature by itself is of first order, 5e-3: a bend keeps "
    "what it has while the piece that it stands for changes by division",
)
def zone_with_material_cue(bench):
    profile = lambda distance: 0.5 * np.clip(3.0 - (distance - 1.0), 0.0, 3.0)
    bent = lambda s: 0.25 * np.clip(s - 1.0, 0.0, 3.0) ** 2 + 1.5 * np.clip(s - 4.0, 0.0, 1.0)  # from the base up to s

    def state(parts):  # of a metre
        return bench.last(material_cue(2 * parts, 0.4 / parts))

    def turn(parts):
        lengths, curvature = np.diff(state(parts).arc_length), state(parts).rest_curvature[:, 1]
        cells = 0.5 * (np.append(0.0, lengths[:-1]) + lengths)
        cells[-1] += 0.5 * lengths[-1]  # the last curvature holds up to the apex
        return cells @ curvature

    @functools.cache
    def largest_errors(parts):
        """Of the direction of elements, and of the curvature of bends."""
        final = state(parts)
        middles = 0.5 * (final.arc_length[1:] + final.arc_length[:-1])
        angles = np.unwrap(np.arctan2(final.tangents[:, 0], final.tangents[:, 2]))
        curvature = final.rest_curvature[:, 1] - profile(5.0 - final.arc_length[:-1])
        return np.max(np.abs(angles - bent(middles))), np.max(np.abs(curvature))

    yield converging("turn from base to apex", bent(5.0), turn, 10, 5e-4)
    direction, curvature = (lambda parts: largest_errors(parts)[0]), (lambda parts: largest_errors(parts)[1])
    yield converging("largest error of a direction along it", 0.0, direction, 10, 5e-4)
    yield converging("largest error of a curvature along it", 0.0, curvature, 10, 5e-3, at_least=0.9)
    yield check("length", 5.0, state(20).rest_length, 5e-4)


def sunflower(length, elements, duration, step, divides=True):
    """A seedling with a growth zone of 6 cm [cm, h, min]."""
    rod = organ(
        length=f"{length} cm",
        elements=elements,
        radius="1 mm",
        growth={"profile": "apical_flat", "rate": "0.05 1/h", "zone_length": "6 cm", "elongation": None},
        division={"longest_element": f"{length / elements} cm" if divides else "inf"},
    )
    return scenario(rod, relaxation=KINEMATIC, duration=f"{duration} h", stepping={"step": f"{step} min"})


@case(
    "C5",
    "A flat growth zone of 6 cm at 1/(20 h), as of a sunflower seedling",
    "L = L₀ + l t/τ beyond the zone, exponential within it; 3.0 mm/h; tissue leaves it after τ ln(l/d), stretched l/d",
    "1e-6 asked. Where the organ is shorter than its zone at first, the edge comes into being within a step, and steps "
    "of 15 min leave 2e-6: hence 3.75 min there",
)
def kinematics(bench):
    zone, time_scale = 6.0, 20.0
    states = bench.states(sunflower(8.0, 40, 80.0, 15))["organ"]
    final = states[-1]
    lengths = [100.0 * state.rest_length for state in states]
    yield check("length from 8 cm after 80 h [cm]", 32.0, lengths[-1], 1e-6, relative=True)
    yield check("speed then [mm/h]", 3.0, 10.0 * (lengths[-1] - lengths[-5]), 1e-6, relative=True)
    stretched = 0.002 * math.exp(80.0 / time_scale)  # the last of the first elements
    generations = math.log2(stretched / (final.rest_length - final.arc_length[-2]))
    yield bounded("generations of elements at the tip", 5.0, math.inf, generations)

    first = time_scale * math.log(zone / 3.0)
    expected = zone + zone * (40.0 - first) / time_scale
    measured = 100.0 * bench.last(sunflower(3.0, 40, 40.0, 3.75)).rest_length
    yield check("length from 3 cm after 40 h [cm]", expected, measured, 1e-6, relative=True)

    states = bench.states(sunflower(8.0, 80, 30.0, 3.75, divides=False))["organ"]
    hours = np.array([state.time for state in states]) / 3600.0
    for distance in (4.0, 3.0):
        vertex = round(10 * (8.0 - distance))
        behind = np.array([100.0 * (state.rest_length - state.arc_length[vertex]) for state in states])
        last = np.flatnonzero(behind < zone)[-1]
        rate = math.log(behind[last] / behind[last - 1]) / (hours[last] - hours[last - 1])
        left = hours[last] + math.log(zone / behind[last]) / rate
        expected = time_scale * math.log(zone / distance)
        what = f"tissue {distance:.0f} cm from the tip leaves the zone after [h]"
        yield check(what, expected, left, 1e-6, relative=True)
    measured = 100.0 * np.diff(states[-1].arc_length[[40, 50]])
    expected = zone * math.log(4.0 / 3.0)  # integral of l / d
    yield check("tissue that stood 4 to 3 cm from the tip is so long [cm]", expected, measured, 1e-6, relative=True)


# The published kinematic model has no R in its drive and E = 0.1 with L_gz = 1: lambda and gamma are those of its code.
PORAT = {
    "const": ((1.64366, 0, 0.50690), (2.64718, 0, 0.46041), (3.64728, 0, 0.47061)),
    "point": ((1.03842, -1.03842, 1.11393), (1.25863, -1.25863, 0.44381), (0.94995, -0.94995, 1.61932)),
    "cn": ((0.12070, 0.23753, 1.97516), (0.10677, 0.58720, 2.92014), (-0.02198, 0.86392, 3.88105)),
}


def porat_scenario(name, parts):
    """With so many steps in a unit of time, and ten elements in one of length for each of them."""
    elements = 10 * parts
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
    content = growing(1.0, growth, 30.0, 1.0 / parts, elements, f"{1.0 / elements!r} m", **changes)
    content["stimuli"] = stimuli
    return content


@case(
    "C4",
    "Sensory growth without elasticity",
    "Porat, Tedone, Palladino, Marcati and Meroz 2020, Front. Robot. AI 7:89: parameters of "
    "the published code; tips of an independent second-order solver",
    "2e-3 asked at 200 elements; orders only of errors ten times as large as those of the figures' last digits",
)
def porat(bench):
    @functools.cache
    def centrelines(name, parts):
        return bench.centrelines(porat_scenario(name, parts), every=10 * parts)

    for name, tips in PORAT.items():
        for frame, expected in enumerate(tips, start=1):
            measure = lambda parts: centrelines(name, parts)[frame][-1]
            what = f"{name}: tip at t = {10 * frame} (steps, elements doubled)"
            yield converging(what, expected, measure, 10, 2e-3, known_to=5e-6)
    off = np.linalg.norm(centrelines("cn", 10)[3][-1] - PORAT["cn"][2])
    yield bounded("cn with the published code's own steps of 0.1: tip at t = 30 is off by", 2e-3, 4e-3, off)

    def draw(*panels):
        views = {"const": (0, "x"), "point": (0, "x, which is -y"), "cn": (1, "y")}
        for axes, (name, (across, label)) in zip(panels, views.items()):
            for frame, expected in enumerate(PORAT[name], start=1):
                points = centrelines(name, 20)[frame]
                axes.plot(points[:, across], points[:, 2], color="0.5", label="simulated" if frame == 1 else None)
                reference = "independent solver" if frame == 1 else None
                axes.plot(expected[across], expected[2], "o", color="#c0504d", fillstyle="none", label=reference)
            axes.set(xlabel=label, ylabel="z", title=f"C4: {name}")
        panels[0].legend(frameon=False)

    caption = "C4: organs at t = 10, 20, 30 under a constant cue, towards a point, and nutating; circles: tips asked."
    bench.picture("sensory_growth", caption, draw, panels=3)
