"""Scenarios of cases: the unit organ of unit_organ.yaml, changed."""

import copy
import math
import pathlib

import yaml

RADIUS = 0.05  # of the unit organ [m]
STIFFNESS = 1.0  # E I of the unit organ [N m^2]

_UNIT = yaml.safe_load((pathlib.Path(__file__).parent / "unit_organ.yaml").read_text(encoding="utf-8"))


def changed(base, changes):
    """`base` with the values of `changes`, dictionaries within dictionaries being changed and not replaced. A value of
    None removes its key."""
    result = copy.deepcopy(base)
    for key, value in changes.items():
        if value is None:
            result.pop(key, None)
        elif isinstance(value, dict) and isinstance(result.get(key), dict):
            result[key] = changed(result[key], value)
        else:
            result[key] = copy.deepcopy(value)
    return result


def organ(**changes):
    return changed(_UNIT["organs"][0], changes)


def scenario(*organs, **changes):
    return changed(_UNIT, {**changes, "organs": list(organs)})


def stepping(step, **more):
    return {"step": f"{step!r} s", **more}


def weight(w, radius=RADIUS):
    """Changes that give an organ the weight w per length [N/m] at an acceleration of 1 m/s^2."""
    return {"material": {"density": f"{w / (math.pi * radius**2)!r} kg/m^3"}}


def vector(unit, *components):
    return [f"{float(component)!r} {unit}" for component in components]


HORIZONTAL = {"direction": [1, 0, 0]}
UPRIGHT = {"direction": [0, 0, 1]}
KINEMATIC = {"method": "kinematic"}
