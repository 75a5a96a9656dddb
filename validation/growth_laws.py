"""Growth, weight and surroundings together: V19 to V24, C2, C3, C10, C11."""

import math

import numpy as np

from comparison import experiments, theory
from validation import closed_forms
from validation.case import at_most, case, check, converging
from validation.elastic import GREENHILL, extensible, side_and_height
from validation.scenario import RADIUS, UPRIGHT, organ, scenario, stepping, vector, weight

SECOND_ORDER = "second order in the element, at rest to 1e-9"


def laid(law, balance, load, elements=100, duration=30.0):
    """A heavy shoot of fixed length on its side, that rights itself by G = balance and straightens at a unit rate."""
    rod = organ(
        elements=elements,
        growth={"rate": "1 1/s"},
        sensitivities={"gravity": balance * RADIUS},
        proprioception={"intrinsic_length": None, law: f"{RADIUS!r} m"},
        **weight(load),
    )
    return scenario(rod, weight=True, duration=f"{duration!r} s", stepping=stepping(0.1))


def shape(state):
    """Tip x, z and angle from upright."""
    return np.array([state.tip[0], state.tip[2], math.atan2(state.tangent[0], state.tangent[2])])


def universal_shape(balance):
    return (
        2.0 / balance * math.atan(math.tanh(balance / 2.0)),
        math.log(math.cosh(balance)) / balance,
        2.0 * math.atan(math.exp(-balance)),
    )


def sagging_shape(balance, load):
    """Law 1 at rest: rest curvature G cos(elevation), elastic curvature from the weight beyond."""

    def equation(s, y):
        return [np.cos(y[2]), np.sin(y[2]), y[3] + balance * np.cos(y[2]), load * (1.0 - s) * np.cos(y[2])]

    _, end = closed_forms.shooting(equation, lambda m: [0, 0, 0, m[0]], [-load / 2.0], lambda end: [end[3]])
    return end[0], end[1], math.pi / 2.0 - end[2]


@case(
    "V19",
    "A shoot that straightens by its actual curvature does not sag",
    "tan(A/2) = exp(-s/L_c)",
    SECOND_ORDER,
    quick=True,
)
def no_sag(bench):
    measure = lambda elements: shape(bench.last(laid("actual_length", 2.0, 3.0, elements)))[:2]
    yield converging("G = 2, S = 3: tip x, z", universal_shape(2.0)[:2], measure, 50, 1e-4)


@case(
    "C2",
    "Steady shapes under weight, laws 1 and 2",
    "law 2: universal shape; law 1: elastica with rest curvature -G sin A "
    "(Chelakkot and Mahadevan 2017, J. R. Soc. Interface 14:20170001), by shooting",
    "1e-3 of L and of a radian: second order in the element",
)
def sagging(bench):
    shapes = {}
    for balance in (1.0, 2.0, 4.0):
        for load in (1.0, 4.0):
            state = bench.last(laid("actual_length", balance, load))
            yield check(
                f"law 2, G = {balance:.0f}, S = {load:.0f}: tip x, z, angle",
                universal_shape(balance),
                shape(state),
                1e-3,
            )
            shapes[2, balance, load] = state.positions
            state = bench.last(laid("intrinsic_length", balance, load))
            yield check(
                f"law 1, G = {balance:.0f}, S = {load:.0f}: tip x, z, angle",
                sagging_shape(balance, load),
                shape(state),
                1e-3,
            )
            shapes[1, balance, load] = state.positions

    def draw(axes):
        for (law, balance, load), points in shapes.items():
            if law == 2 and load != 1.0:
                continue
            label = f"law 1, S = {load:.0f}" if law == 1 else "law 2, any S"
            colour = {2: "k"}.get(law) or {1.0: "#5b9bd5", 4.0: "#c0504d"}[load]
            axes.plot(points[:, 0], points[:, 2], color=colour, label=label if balance == 1.0 else None)
        axes.set(xlabel="x / L", ylabel="z / L", aspect="equal", title="C2: steady shapes for G = 1, 2, 4")
        axes.legend(frameon=False)

    bench.picture("steady_shapes", draw)


@case(
    "C3",
    "Onset of oscillations under strain relaxation",
    "linear stability of the upright shoot by Chebyshev collocation (comparison/theory.py)",
    "onset 1 %, rates and frequencies 3 %: 40 elements; docs/three_growth_models.md has ten onsets",
)
def onset(bench):
    program = bench.programs / "sensory_growth_batch"
    for balance, load in ((1.0, 2.3), (1.0, 3.0), (2.0, 5.5)):
        mode = theory.leading_mode(balance, load)
        measured = experiments.disturbed(program, "relaxation", balance, load)
        yield check(
            f"G = {balance:.0f}, S = {load}: rate, frequency",
            (mode.real, abs(mode.imag)),
            (measured["rate"], measured["frequency"]),
            0.03,
            relative=True,
        )
    for balance in (1.0, 2.0):
        expected, frequency = theory.onset(balance)
        low, high = 0.9 * expected, 1.15 * expected
        measured = experiments.onset(program, "relaxation", balance, low, high, halvings=6)
        yield check(f"G = {balance:.0f}: S_H", expected, measured["onset"], 0.01, relative=True)
        yield check(f"G = {balance:.0f}: frequency there", frequency, measured["frequency"], 0.03, relative=True)
    for law, balance in (("intrinsic", 1.0), ("actual", 1.0), ("relaxation", 4.0)):
        rate = experiments.disturbed(program, law, balance, 7.5)["rate"]
        yield at_most(f"{law}, G = {balance:.0f}, S = 7.5: rate, which must be negative", 1e-9, max(0.0, rate))


@case("V20", "Creep under a couple at the tip", "κ₀ = γ_r ε M/(R B), κ - κ₀ = M/B", "1e-3 of it at steps of 0.05")
def creep(bench):
    def measure(parts):
        rod = organ(
            elements=10,
            growth={"rate": "1 1/s"},
            proprioception={"intrinsic_length": None, "relaxation_length": f"{RADIUS!r} m"},
            tip_couple=vector("N m", 0, 0.3, 0),
        )
        state = bench.last(scenario(rod, stepping=stepping(1.0 / parts)))
        return state.rest_curvature[4, 1], state.curvature[4, 1] - state.rest_curvature[4, 1]

    yield converging("rest and elastic curvature (steps doubled)", (0.3, 0.3), measure, 10, 3e-4)


def coupled(**changes):
    """A stiff rod that elongates as its stress lets it; section 1 m^2, yield margin 1 Pa."""
    radius = 1.0 / math.sqrt(math.pi)
    return organ(
        elements=20,
        radius=f"{radius!r} m",
        material=extensible(1e7, 1e7 / 3.0),
        growth={"rate": "1 1/s", "elongation": None, "stress_coupling": {"yield_margin": "1 Pa"}},
        **changes,
    )


def free_steps(step):
    """The limit on stress counts with a rod that is held rigidly, which these are not."""
    return stepping(step, limits={"growth_stress": "inf"})


@case(
    "V21",
    "Growth of a rod that is pulled or pressed",
    "Lockhart 1965: L = L₀ exp(ε (1 + N/Aσ) t), none below N = -Aσ",
    "1e-6: the elastic strain of 1e-7 is not in the rest length",
)
def pulled_growth(bench):
    for force in (0.5, -0.5, -1.5):
        content = scenario(coupled(tip_force=vector("N", force, 0, 0)), stepping=free_steps(0.05))
        expected = math.exp(max(0.0, 1.0 + force))
        yield check(f"length, N = {force}", expected, bench.last(content).rest_length, 1e-6)


@case(
    "V22",
    "Growth against a springy stop, and Lockhart's plateau (C11)",
    "logistic growth L = K/(1 + (K/L₀ - 1) exp(-ε K k t/Aσ)); force A σ in the end",
    "2e-3 of model.md; second order in the step",
)
def growth_against_stop(bench):
    stiffness, asymptote = 2.0, 1.5
    spring = {"label": 1, "anchor": vector("m", 1, 0, 0), "stiffness": f"{stiffness} N/m"}
    grown = lambda t: asymptote / (1.0 + (asymptote - 1.0) * math.exp(-asymptote * stiffness * t))

    def length(parts, duration=1.0):
        content = scenario(coupled(springs=[spring]), duration=f"{duration} s", stepping=free_steps(1.0 / parts))
        return bench.last(content).tip[0]

    yield converging("length at t = 1 (steps doubled)", grown(1.0), length, 20, 2e-3)
    yield check("force on the stop at t = 10", 1.0, stiffness * (length(20, 10.0) - 1.0), 1e-3)


@case(
    "V23",
    "A column grows until it falls over, and on",
    "Greenhill's load at L³ w/B = 7.837; elastica by shooting at L = 0.5 e²",
    "time 1e-3, place 1e-3: second order in elements of 1/100",
)
def growing_column(bench):
    rod = organ(
        length="0.5 m",
        base=UPRIGHT,
        growth={"rate": "1 1/s", "elongation": None},
        **weight(1.0),
    )
    states = bench.states(scenario(rod, weight=True, duration="2 s", stepping=stepping(0.01)))["organ"]
    expected = math.log(GREENHILL ** (1.0 / 3.0) / 0.5)
    upright = [state for state in states[1:] if math.hypot(*state.tip[:2]) < 1e-6][-3:]
    times, lowest = [state.time for state in upright], [state.lowest_eigenvalue for state in upright]
    yield check("time at which it cannot stand", expected, np.polyval(np.polyfit(lowest, times, 2), 0.0), 1e-3)
    length = 0.5 * math.exp(2.0)
    fallen = closed_forms.leaning_column(length**3)
    yield check("side, height over L at t = 2", fallen, side_and_height(states[-1]) / length, 1e-3)


@case("V24", "Tissue laid down free of stress", "nothing moves", "1e-9: tolerance of the relaxation", quick=True)
def deposition(bench):
    aging = {
        "clock": "time",
        "stiffening": {"mature_modulus": "2 MPa", "time": "1 s"},
        "thickening": {"mature_radius": "8 cm", "time": "2 s"},
    }
    states = bench.states(
        scenario(organ(tip_force=vector("N", 0, 0, -2), aging=aging), duration="3 s", stepping=stepping(0.1))
    )
    positions = [state.positions for state in states["organ"]]
    yield at_most(
        "largest way of a vertex while stiffness grows a hundredfold",
        1e-9,
        np.max(np.abs(positions[-1] - positions[0])),
    )
    yield check(
        "deflection that it keeps", closed_forms.planar_cantilever(0.0, tip_force=2.0)[1], positions[-1][-1, 2], 2e-4
    )


@case(
    "C10",
    "Rest curvature of an organ held on an arc",
    "Goldstein and Goriely 2006, Phys. Rev. E 74:010901: κ₀ = κ (1 - exp(-r t))",
    "0.5 % asked; exact steps give 1e-6",
)
def held_on_arc(bench):
    curvature, rate = 0.8, 1.0
    # Elements are chords of the arc: the apex is held at the end of their polygon.
    angles = curvature * (np.arange(40) + 0.5) / 40
    held = {
        "position": vector("m", np.sin(angles).mean(), 0, np.cos(angles).mean()),
        "direction": [math.sin(curvature), 0, math.cos(curvature)],
        "roll": "0 deg",
    }
    rod = organ(
        elements=40,
        base=UPRIGHT,
        growth={"rate": f"{rate} 1/s"},
        proprioception={"intrinsic_length": None, "relaxation_length": f"{RADIUS!r} m"},
        held_apex=held,
    )
    states = bench.states(scenario(rod, duration="3 s", stepping=stepping(0.05)))["organ"]
    for index in (10, 30, 60):
        expected = curvature * (1.0 - math.exp(-rate * 0.05 * index))
        yield check(
            f"rest curvature at t = {0.05 * index}", np.full(40, expected), states[index].rest_curvature[:, 1], 1e-6
        )


@case(
    "C11",
    "Growth between two clamps ends in buckling",
    "Euler: growth stretch 1 + 4 π² I/(A L²) to first order",
    "3 %: the formula's own order",
)
def growth_between_clamps(bench):
    radius = 0.02
    young = 4.0 / (math.pi * radius**4)
    critical = math.pi**2 * radius**2  # I / A = R^2 / 4
    rod = organ(
        elements=60,
        radius=f"{radius} m",
        base=UPRIGHT,
        material=extensible(young, young / 3.0),
        growth={"rate": "1e-3 1/s", "elongation": None},
        held_apex={"position": vector("m", 0, 0, 1), "direction": [0, 0, 1], "roll": "0 deg"},
    )
    states = bench.states(scenario(rod, duration="5 s", stepping=stepping(0.02)))["organ"]
    buckled = next(state for state in states if np.max(np.abs(state.positions[:, :2])) > 1e-3)
    yield check("growth strain at which it buckles", critical, buckled.rest_length - 1.0, 0.03, relative=True)
