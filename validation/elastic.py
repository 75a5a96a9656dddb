"""Rods under loads, without growth: V1 to V11 of docs/model.md."""

import math

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk, jv

from validation import closed_forms
from validation.case import at_most, case, check, converging
from validation.scenario import HORIZONTAL, STIFFNESS, UPRIGHT, organ, scenario, vector, weight

SECOND_ORDER = "second order in the element: 1e-4 of the length at 100 elements"
GREENHILL = 2.25 * brentq(lambda z: jv(-1.0 / 3.0, z), 1.5, 2.2) ** 2  # 7.8373


def extensible(young_modulus, shear_modulus, density=1.0, shear_correction=1.0):
    return {
        "young_modulus": f"{young_modulus!r} Pa",
        "shear_modulus": f"{shear_modulus!r} Pa",
        "density": f"{density!r} kg/m^3",
        "shear_correction": shear_correction,
        "poisson_ratio": None,
        "inextensible": None,
    }


def heavy(load, elements, **changes):
    return scenario(organ(elements=elements, **weight(load), **changes), weight=True)


def pulled(elements, force, **changes):
    return scenario(organ(elements=elements, tip_force=vector("N", *force), **changes))


def side_and_height(state):
    return np.array([math.hypot(state.tip[0], state.tip[1]), state.tip[2]])


@case(
    "V1",
    "Cantilever under its own weight",
    "elastica B θ'' = w (L - s) cos θ, by shooting",
    SECOND_ORDER,
    quick=True,
)
def heavy_cantilever(bench):
    for load in (1, 5, 10, 20, 50):
        x, z, angle = closed_forms.planar_cantilever(load)

        def measure(elements):
            state = bench.last(heavy(load, elements))
            return state.tip[0], state.tip[2], math.asin(state.tangent[2])

        tolerance = 2e-4 if load <= 20 else 5e-4
        yield converging(f"β = {load}: tip x, z, angle", (x, z, angle), measure, 50, tolerance)

    def draw(axes):
        counts = 10 * 2 ** np.arange(6)
        for load in (1, 10, 50):
            expected = closed_forms.planar_cantilever(load)[:2]
            tips = [bench.last(heavy(load, int(count))).tip[[0, 2]] for count in counts]
            axes.loglog(counts, np.linalg.norm(np.array(tips) - expected, axis=1), "o-", label=f"β = {load}")
        axes.loglog(counts, 0.3 / counts**2, "k--", linewidth=1, label="slope -2")
        axes.set(xlabel="elements", ylabel="distance of the tip from the elastica / L", title="V1: second order")
        axes.legend(frameon=False)

    bench.picture("order", "V1: a heavy cantilever's tip comes nearer by a factor of four as elements double.", draw)


@case("V2", "The same with stretch and shear", "Cosserat elastica, by shooting", SECOND_ORDER)
def extensible_cantilever(bench):
    for slenderness in (10, 20, 100):
        radius = 1.0 / slenderness
        axial = 4.0 * slenderness**2  # E A at unit E I
        x, z, _ = closed_forms.planar_cantilever(10.0, stretch=1.0 / axial, shear=3.0 / axial)
        area = math.pi * radius**2
        material = extensible(axial / area, axial / area / 3.0, density=10.0 / area)

        def measure(elements):
            rod = organ(elements=elements, radius=f"{radius!r} m", material=material)
            return bench.last(scenario(rod, weight=True)).tip[[0, 2]]

        yield converging(f"L/R = {slenderness}: tip x, z", (x, z), measure, 50, 2e-4)


@case("V3", "Cantilever under a dead force at its tip", "Bisshopp and Drucker 1945, elastica by shooting", SECOND_ORDER)
def end_loaded_cantilever(bench):
    for load in (1, 2, 5, 10):
        x, z, _ = closed_forms.planar_cantilever(0.0, tip_force=load)
        measure = lambda elements: bench.last(pulled(elements, (0, 0, -load))).tip[[0, 2]]
        yield converging(f"P L²/B = {load}: tip x, z", (x, z), measure, 50, 1e-4)


@case(
    "V4",
    "Column past buckling under a force at its tip",
    "Euler's elastica in elliptic integrals",
    "second order; just past buckling the deflection is the root of a small difference, hence 2e-3 there",
)
def euler_column(bench):
    for degrees in (20, 60, 120):
        k = math.sin(math.radians(degrees) / 2.0)
        integral_k, integral_e = ellipk(k * k), ellipe(k * k)
        load = integral_k**2  # over B / L^2
        expected = (2.0 * k / integral_k, 2.0 * integral_e / integral_k - 1.0)
        measure = lambda elements: side_and_height(bench.last(pulled(elements, (0, 0, -load), base=UPRIGHT)))
        tolerance = 2e-3 if degrees == 20 else 2e-4
        yield converging(f"tip at {degrees}°: side, height", expected, measure, 50, tolerance)


@case(
    "V5",
    "Weight under which a column buckles",
    "Greenhill 1881: 9/4 of the squared first zero of the Bessel function of order -1/3",
    "1e-4 asked; the constant, of docs/model.md 18, to 1 %: the lowest eigenvalue of stable columns extrapolated to zero",
    quick=True,
)
def greenhill(bench):
    def critical(elements):
        loads = GREENHILL * np.array([0.990, 0.993, 0.996])
        lowest = [bench.last(heavy(float(load), elements, base=UPRIGHT)).lowest_eigenvalue for load in loads]
        return np.polyval(np.polyfit(lowest, loads, 2), 0.0)

    yield converging("β at which it buckles", GREENHILL, critical, 50, 1e-4, relative=True)
    yield check("its relative error times n², n = 100", -0.5155, 100**2 * (critical(100) / GREENHILL - 1.0), 5e-3)


@case(
    "V6", "Column past buckling under its own weight", "elastica by shooting", "5e-4 asked; second order in the element"
)
def heavy_column(bench):
    for factor in (1.02, 1.1, 1.5, 2.0):
        load = factor * GREENHILL
        expected = closed_forms.leaning_column(load)
        measure = lambda elements: side_and_height(bench.last(heavy(load, elements, base=UPRIGHT)))
        yield converging(f"{factor} of Greenhill's load: side, height", expected, measure, 50, 5e-4)


@case(
    "V7",
    "Cantilever of two stiffnesses, 16 to 1",
    "elastica by shooting on both halves",
    "second order also at the jump, thanks to the harmonic mean",
    interface="library",
)
def stepped_cantilever(bench):
    expected = closed_forms.stepped_cantilever(lambda s: 16.0 if s < 0.5 else 1.0, 0.05)
    measure = lambda elements: float(bench.call("sensory_growth_validation", "stepped_cantilever", elements))
    yield converging("tip z", expected, measure, 50, 2e-4, relative=True)


@case(
    "V8",
    "Bend of 45° loaded out of its plane",
    "the problem of Bathe and Bolourchi 1979 with the stiffnesses of Simo and Vu-Quoc 1986; Cosserat rod by shooting",
    "1e-4 of the length of 78.5 m",
    quick=True,
)
def bend_out_of_plane(bench):
    bending, axial, shear = 1e7 / 12.0, 1e7, 5e6
    length, radius = 25.0 * math.pi, 1.0 / math.sqrt(3.0)  # E I / E A = R^2 / 4
    frame = np.column_stack([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    material = extensible(axial / (math.pi * radius**2), shear / (math.pi * radius**2))
    for force in (300.0, 600.0):
        expected = closed_forms.spatial_tip(
            length,
            np.array([0.0, 0.01, 0.0]),
            np.full(3, bending),
            np.array([1 / shear, 1 / shear, 1 / axial]),
            frame,
            [0.0, 0.0, force],
        )

        def measure(elements):
            rod = organ(
                elements=elements,
                length=f"{length!r} m",
                radius=f"{radius!r} m",
                base={"direction": [0, 1, 0]},
                material=material,
                rest_curvature=vector("1/m", *(frame_of_base().T @ frame @ [0.0, 0.01, 0.0])),
                tip_force=vector("N", 0, 0, force),
            )
            return bench.last(scenario(rod)).tip

        yield converging(f"P = {force:.0f} N: tip", expected, measure, 32, 1e-4 * length)


def frame_of_base():
    """The frame that docs/scenario.md gives to a base that points to +y: the world's, turned about x."""
    return np.column_stack([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


@case(
    "V9",
    "Couples at the tip: a twist and a circle",
    "constant curvature M / B, twist M / 2 G I",
    "1e-11: exact in every bend but for round-off",
    quick=True,
)
def end_couples(bench):
    twisted = bench.last(scenario(organ(tip_couple=vector("N m", 0, 0, 0.3))))
    yield check("twist, M = 0.3 N m", np.full(100, 0.3 * 1.5), twisted.curvature[:, 2], 1e-11)
    bent = bench.last(scenario(organ(tip_couple=vector("N m", 0, 2.0, 0))))
    yield check("curvature, M = 2 N m", np.full(100, 2.0 / STIFFNESS), bent.curvature[:, 1], 1e-11)


def helix_through(points, axis):
    """Radius and pitch of the helix about `axis` on which points lie, by least squares."""
    along = points @ axis
    plane = np.linalg.svd(axis[None])[2][1:]  # two directions across it, right-handed with it
    plane[1] *= np.linalg.det([*plane, axis])
    across = points @ plane.T
    centre = np.linalg.lstsq(
        np.column_stack([2 * across, np.ones(len(across))]), np.sum(across**2, axis=1), rcond=None
    )
    offset = across - centre[0][:2]
    turned = np.unwrap(np.arctan2(offset[:, 1], offset[:, 0]))
    return np.mean(np.hypot(*offset.T)), 2.0 * math.pi * np.polyfit(turned, along, 1)[0]


@case(
    "V10",
    "Rest helix",
    "exponential of the constant turn; radius κ/(κ² + τ²), pitch 2πτ/(κ² + τ²)",
    "5e-5; second order: chords of a helix of radius 0.15",
    quick=True,
)
def rest_helix(bench):
    curvature, torsion, length = 2.0, 3.0, 2.0
    turn = np.array([[0, -torsion, curvature], [torsion, 0, 0], [-curvature, 0, 0]])
    rate = math.hypot(curvature, torsion)
    angle = rate * length
    shape = (
        length * np.eye(3)
        + (1 - math.cos(angle)) / rate**2 * turn
        + (angle - math.sin(angle)) / rate**3 * turn @ turn
    )

    def positions(elements):
        rod = organ(
            elements=elements,
            length=f"{length} m",
            base=UPRIGHT,
            rest_curvature=vector("1/m", 0, curvature, torsion),
        )
        return bench.last(scenario(rod)).positions

    yield converging("tip", shape[:, 2], lambda elements: positions(elements)[-1], 100, 5e-5)
    axis = np.array([0.0, curvature, torsion]) / rate
    expected = (curvature / rate**2, 2.0 * math.pi * torsion / rate**2)
    yield converging("radius, pitch", expected, lambda elements: helix_through(positions(elements), axis), 100, 5e-5)


@case(
    "V11",
    "Cantilever whose tip rests on a floor",
    "elastica with the reaction as unknown, by shooting",
    "1e-3; second order; the tip vertex alone touches. The reaction is what bending moments ask for on the tip",
)
def cantilever_on_floor(bench):
    load, floor = 10.0, -0.5
    x, reaction = closed_forms.cantilever_on_floor(load, floor)
    wall = {"point": vector("m", 0, 0, floor), "normal": [0, 0, 1], "stiffness": "rigid"}

    def measure(elements):
        state = bench.last(heavy(load, elements, walls=[wall]))
        # Across the first element the moment changes by the upward force that it carries, at this lever:
        lever = state.positions[1, 0] - state.positions[0, 0]
        carried = STIFFNESS * (state.curvature[0, 1] - state.curvature[1, 1]) / lever
        return state.tip[0], load * (1.0 - 0.5 / elements) - carried

    yield converging("β = 10: tip x, reaction of the floor", (x, reaction), measure, 50, 1e-3)
    yield at_most(
        "height of the tip above the floor", 1e-9, abs(bench.last(heavy(load, 100, walls=[wall])).tip[2] - floor)
    )


@case(
    "C9",
    "Timoshenko's cantilever under a small force",
    "y = -F s/(α G A) - F L s²/2EI + F s³/6EI",
    "the force is so small that what is not linear shows below 1e-6 of the deflection",
)
def timoshenko(bench):
    length, radius, young, force = 3.0, 0.25, 1e6, 0.05
    area = math.pi * radius**2
    bending, shear = young * area * radius**2 / 4.0, 27.0 / 28.0 * young / 100.0 * area
    line = lambda s: force * (-s / shear - length * s**2 / (2.0 * bending) + s**3 / (6.0 * bending))

    def deflection(elements):
        rod = organ(
            elements=elements,
            length=f"{length} m",
            radius=f"{radius} m",
            base=HORIZONTAL,
            material=extensible(young, young / 100.0, 5000.0, 27.0 / 28.0),
            tip_force=vector("N", 0, 0, -force),
        )
        state = bench.last(scenario(rod))
        return state.positions[:: elements // 50, 2]

    s = np.linspace(0.0, length, 51)
    yield converging("z at 51 places along it", line(s), deflection, 50, 2e-4, relative=True, known_to=1e-12)
    arc = bench.last(scenario(organ(rest_curvature=vector("1/m", 0, 1.5, 0), base=UPRIGHT)))
    angle = 1.5 * arc.arc_length
    expected = np.column_stack([(1.0 - np.cos(angle)) / 1.5, np.zeros_like(angle), np.sin(angle) / 1.5])
    yield at_most(
        "rest curvature imposed and released: largest distance from the arc",
        1e-3,
        np.max(np.linalg.norm(arc.positions - expected, axis=1)),
    )
