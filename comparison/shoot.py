"""The shoot of the comparison and its experiments: scenarios, runs, centrelines.

Everything is without dimension: lengths over the length L of the shoot, times over that in which it straightens,
R / (gamma e_g). G is what it rights itself by over what it straightens by, beta L / gamma; S is its weight over its
stiffness, rho g A L^3 / (E I). A radius of 5 cm, a length of 1 m and E I = 1 N m^2 stand for the units.
"""

import itertools
import math
import pathlib
import subprocess
import tempfile

import numpy as np
import rosbag
import yaml

LAWS = {"intrinsic": "intrinsic_length", "actual": "actual_length", "relaxation": "relaxation_length"}
GREENHILL = 7.837347439  # S under which an upright shoot falls over
RADIUS = 0.05
YOUNG_MODULUS = 4.0 / (math.pi * RADIUS**4)

# A light from one side, then one from another: a push that favours neither a plane nor a sense of rotation.
FLASHES_END = 0.2
FLASHES = [
    {"at": "0 s", "add": {"light_direction": {"id": "flash", "towards": [1, 0, 0], "strength": 1}}},
    {"at": "0.1 s", "change": {"light_direction": {"id": "flash", "towards": [0.5, 1, 0], "strength": 1}}},
    {"at": f"{FLASHES_END} s", "remove": {"light_direction": {"id": "flash"}}},
]


def scenario(law, G, S, base, duration, step, elements, push=0.0):
    """A shoot that keeps its length and grows all over by one unit of strain per second. `push` [-] is its sensitivity
    to the flashes over that to gravity at G = 1."""
    shoot = {
        "id": "shoot",
        "base": {"position": ["0 m"] * 3, "direction": base},
        "length": "1 m",
        "elements": elements,
        "radius": f"{RADIUS} m",
        "material": {
            "young_modulus": f"{YOUNG_MODULUS!r} Pa",
            "poisson_ratio": 0.5,
            "density": f"{S / (math.pi * RADIUS**2)!r} kg/m^3" if S > 0 else "1 kg/m^3",
            "inextensible": True,
        },
        "growth": {"profile": "uniform", "rate": "1 1/s", "elongation": False},
        "sensitivities": {"gravity": G * RADIUS, "light_direction": push * RADIUS, "point_source": 0},
        "proprioception": {LAWS[law]: f"{RADIUS} m"},
        "division": {"longest_element": "inf"},
    }
    return {
        "name": "shoot",
        "gravity": {"direction": [0, 0, -1], "acceleration": "1 m/s^2"},
        "weight": S > 0,
        "duration": f"{duration} s",
        "stepping": {"step": f"{step} s"},
        "organs": [shoot],
        "protocol": FLASHES if push else [],
    }


def run(program, content, folder, *outputs):
    """Runs a scenario; returns whether it came to its end. An organ that curls up or twists tighter than its elements
    resolve does not."""
    path = pathlib.Path(folder) / "scenario.yaml"
    path.write_text(yaml.safe_dump(content, sort_keys=False), encoding="utf-8")
    command = [program, "run", path, *outputs, "--threads", 1, "--growth-time-scale", 1, "--quiet"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or (done.returncode == 1 and "unresolved_bend" not in done.stderr):
        raise RuntimeError(f"{program} ended with {done.returncode}: {done.stderr.strip()}")
    return done.returncode == 0


def grow(program, content, every=1):
    """Centrelines as an array of frames, vertices, coordinates, and whether the run came to its end."""
    with tempfile.TemporaryDirectory() as folder:
        ended = run(program, content, folder, "--csv", folder, "--every", every)
        table = np.loadtxt(pathlib.Path(folder) / "shoot.csv", delimiter=",", skiprows=1)
    vertices = content["organs"][0]["elements"] + 1
    return table[:, 1:].reshape(-1, vertices, 3), ended


def record(program, content, every):
    """Positions of the tip, curvature and twist at every bend (frames, bends, components along the directors), and
    whether the run came to its end."""
    tips, curvatures = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "run.bag"
        ended = run(program, content, folder, "--bag", path, "--marker-every", 0)
        with rosbag.Bag(str(path)) as bag:
            states = bag.read_messages(topics="/sensory_growth/organs/shoot/state", raw=True)
            for _, (_, data, _, _, message), _ in itertools.islice(states, 0, None, every):
                state = message().deserialize(data)
                tips.append([state.positions[-1].x, state.positions[-1].y, state.positions[-1].z])
                curvatures.append([[bend.x, bend.y, bend.z] for bend in state.curvature])
    return np.array(tips), np.array(curvatures), ended


def tangents(centrelines):
    edges = np.diff(centrelines, axis=1)
    return edges / np.linalg.norm(edges, axis=2, keepdims=True)


def largest_turns(centrelines):
    """Largest angle between neighbouring edges, frame by frame."""
    chords = np.linalg.norm(np.diff(tangents(centrelines), axis=1), axis=2)
    return 2.0 * np.max(np.arcsin(np.minimum(0.5 * chords, 1.0)), axis=1)


def tip_tangents(centrelines):
    """Unit tangents at the apex, half an element beyond the last edge: extrapolated linearly."""
    last = tangents(centrelines[:, -3:])
    tangent = 1.5 * last[:, 1] - 0.5 * last[:, 0]
    return tangent / np.linalg.norm(tangent, axis=1, keepdims=True)
