"""The live node: lights sent while it runs, and a shipped scenario. C7 and C8, also in a batch, and C2 once more."""

import math
import pathlib

import yaml

from validation import closed_forms
from validation.case import case, check
from validation.growth_laws import sagging_shape

PACKAGE = pathlib.Path(__file__).resolve().parent.parent


def seedling(gravity, light, exponent=1.0, direction=(0, 0, 1)):
    """An upright shoot of balance number 10 that keeps its length."""
    return {
        "name": "seedling",
        "gravity": {"direction": [0, 0, -1], "acceleration": "9.81 m/s^2"},
        "weight": False,
        "stepping": {"step": "1 min"},
        "relaxation": {"method": "kinematic"},
        "organs": [
            {
                "id": "shoot",
                "base": {"position": ["0 m"] * 3, "direction": list(direction)},
                "length": "100 mm",
                "elements": 100,
                "radius": "1 mm",
                "material": {"young_modulus": "10 MPa", "poisson_ratio": 0.5, "density": "1000 kg/m^3"},
                "growth": {"profile": "uniform", "rate": "6 1/h", "elongation": False},
                "sensitivities": {
                    "gravity": gravity,
                    "light_direction": light,
                    "point_source": 0,
                    "intensity_exponent": exponent,
                },
                "proprioception": {"intrinsic_length": "8 mm"},
                "division": {"longest_element": "inf"},
            }
        ],
    }


def both(bench, content, lights, steps=60):
    """How lights came to the seedling, and its last state: on the topic of a live node, and in the scenario of a batch."""
    yield "live", bench.live(content, steps, lights)["shoot"][-1]
    lamps = [{"id": name, "towards": list(map(float, towards)), "strength": strength} for name, towards, strength in lights]
    yield "batch", bench.last(content | {"duration": f"{steps} min", "stimuli": {"light_directions": lamps}})


@case(
    "C7",
    "Light against gravity, on the topic and in the scenario",
    "tan A = ν sin P/(β + ν cos P) (Bastien, Douady and Moulia 2015, PLoS Comput. Biol. 11:e1004037)",
    "0.2° asked: an organ of ten convergence lengths is within e⁻¹⁰ of it",
    interface="node, batch",
    quick=True,
)
def photogravitropism(bench):
    for degrees, ratio in ((100.0, 0.5), (60.0, 2.0)):
        light = math.radians(degrees)
        lights = [("window", [math.sin(light), 0.0, math.cos(light)], 1.0)]
        expected = math.degrees(math.atan2(ratio * math.sin(light), 1.0 + ratio * math.cos(light)))
        for how, state in both(bench, seedling(0.8, 0.8 * ratio), lights):
            measured = math.degrees(math.atan2(state.tangent[0], state.tangent[2]))
            what = f"light at {degrees:.0f}°, ν/β = {ratio}, {how}: angle of the tip [deg]"
            yield check(what, expected, measured, 0.2)


@case(
    "C8",
    "Two lights and an answer to a power of the intensity, on the topic and in the scenario",
    "azimuth atan(I₂^α/I₁^α) (Meroz 2026, review, eq. 10, quoted in the cases); equal lights from opposite sides cancel",
    "0.5° asked",
    interface="node, batch",
)
def two_lights(bench):
    exponent = 0.4
    for first, second in ((1.0, 3.0), (8.0, 1.0)):
        lights = [("east", (1.0, 0.0, 0.0), first), ("north", (0.0, 1.0, 0.0), second)]
        expected = math.degrees(math.atan2(second**exponent, first**exponent))
        for how, state in both(bench, seedling(0.2, 0.6, exponent), lights):
            measured = math.degrees(math.atan2(state.tangent[1], state.tangent[0]))
            what = f"intensities {first:.0f} and {second:.0f}, {how}: azimuth of the tip [deg]"
            yield check(what, expected, measured, 0.5)
    lights = [("east", (1.0, 0.0, 0.0), 2.0), ("west", (-1.0, 0.0, 0.0), 2.0)]
    for how, state in both(bench, seedling(0.2, 0.6, exponent), lights):
        tilt = math.degrees(math.hypot(state.tangent[0], state.tangent[1]))
        yield check(f"equal lights from opposite sides, {how}: tilt of the tip [deg]", 0.0, tilt, 0.5)


@case(
    "C2 live",
    "config/three_growth_laws.yaml in the node: laws 1 and 2 at rest",
    "as C2, with G and S of the file's parameters",
    "0.2°, 2e-3 of L: the file's rod stretches and shears a little",
    interface="node",
)
def shipped_growth_laws(bench):
    content = yaml.safe_load((PACKAGE / "config" / "three_growth_laws.yaml").read_text(encoding="utf-8"))
    length, radius, young, density = 0.16, 2e-3, 10e6, 1000.0
    load = density * 9.81 * math.pi * radius**2 * length**3 / (young * math.pi * radius**4 / 4.0)
    balance = 0.8 * length / 0.064
    states = bench.live(content, 24 * 30, growth_time_scale=600)
    for organ, expected in (
        ("actual", closed_forms.universal_shape(balance)),
        ("intrinsic", sagging_shape(balance, load)),
    ):
        state = states[organ][-1]
        tip = (state.tip - state.positions[0])[[0, 2]] / length
        yield check(f"{organ}: tip x, z", expected[:2], tip, 2e-3)
        angle = math.degrees(math.atan2(state.tangent[0], state.tangent[2]))
        yield check(f"{organ}: angle of the tip from upright [deg]", math.degrees(expected[2]), angle, 0.2)
