"""Shapes of elastic rods from their differential equations, by means that share nothing with the simulator."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

_PRECISE = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-11}


def shooting(equation, base, unknowns, residual):
    """State at s = 1 of the solution that starts at base(unknowns) and ends with residual(state) = 0."""

    def end(values):
        return solve_ivp(equation, (0.0, 1.0), base(values), **_PRECISE).y[:, -1]

    found = root(lambda values: residual(end(values)), unknowns, tol=1e-10)
    if np.max(np.abs(found.fun)) > 1e-8:
        raise ArithmeticError(f"shooting failed: {found.message}")
    return found.x, end(found.x)


def planar_cantilever(load, tip_force=0.0, stretch=0.0, shear=0.0, steps=8):
    """Rod of unit length and stiffness, clamped horizontally, pulled down by `load` per length and `tip_force`: x, z
    and angle of its tip. `stretch` and `shear` are compliances. The load is raised in steps, each starting from the
    last."""

    def solve(factor, guess):
        def equation(s, y):
            angle, curvature = y[2], y[3]
            force = -factor * (load * (1.0 - s) + tip_force)
            axial, normal = force * np.sin(angle), force * np.cos(angle)
            along, across = 1.0 + stretch * axial, shear * normal
            dx = along * np.cos(angle) - across * np.sin(angle)
            dz = along * np.sin(angle) + across * np.cos(angle)
            return [dx, dz, curvature, -dx * force]

        return shooting(equation, lambda k: [0.0, 0.0, 0.0, k[0]], guess, lambda end: [end[3]])

    guess = [0.0]
    for factor in np.linspace(0.0, 1.0, steps + 1)[1:]:
        guess, end = solve(factor, guess)
    return end[:3]


def stepped_cantilever(stiffness, tip_force):
    """Height of the tip of a rod of unit length with stiffness(s), clamped horizontally, under a force at its tip. A
    jump is assumed at s = 1/2."""

    def end(moment):
        y = [0.0, 0.0, 0.0, moment]
        for span in ((0.0, 0.5), (0.5, 1.0)):
            local = stiffness(0.5 * sum(span))
            equation = lambda s, y: [np.cos(y[2]), np.sin(y[2]), y[3] / local, tip_force * np.cos(y[2])]
            y = solve_ivp(equation, span, y, **_PRECISE).y[:, -1]
        return y

    moment = brentq(lambda m: end(m)[3], -2.0 * tip_force, 0.0, xtol=1e-15)
    return end(moment)[1]


def leaning_column(load):
    """Lateral deflection and height of the tip of an upright rod of unit length and stiffness, bent by `load` per
    length beyond its Greenhill load."""

    def end(curvature):
        equation = lambda s, y: [np.sin(y[2]), np.cos(y[2]), y[3], -load * (1.0 - s) * np.sin(y[2])]
        return solve_ivp(equation, (0.0, 1.0), [0.0, 0.0, 0.0, curvature], **_PRECISE).y[:, -1]

    curvatures = np.linspace(0.1, 2.0 * np.sqrt(load) + 2.0, 80)  # energy bounds the one at the base
    moments = [end(k)[3] for k in curvatures]
    first = np.flatnonzero(np.diff(np.sign(moments)))[0]
    return end(brentq(lambda k: end(k)[3], curvatures[first], curvatures[first + 1], xtol=1e-13))[:2]


def cantilever_on_floor(load, floor):
    """Tip x and reaction of the floor for a horizontal cantilever whose tip alone rests on a frictionless floor."""

    def equation(s, y):
        return [np.cos(y[2]), np.sin(y[2]), y[3], (load * (1.0 - s) - y[4]) * np.cos(y[2]), 0.0]

    guess = [-1.5, 1.9]
    (_, reaction), end = shooting(
        equation, lambda v: [0.0, 0.0, 0.0, v[0], v[1]], guess, lambda end: [end[3], end[1] - floor]
    )
    return end[0], reaction


def spatial_tip(length, rest_curvature, stiffness, stretch_compliance, base_frame, force, steps=8):
    """Tip of a Cosserat rod clamped at the origin under a dead force at its tip; matrices have directors as columns."""

    def solve(factor, guess):
        pull = factor * np.asarray(force)

        def equation(s, y):
            frame, moment = y[3:12].reshape(3, 3), y[12:15]
            k = rest_curvature + frame.T @ moment / stiffness
            turn = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
            tangent = frame @ (np.array([0.0, 0.0, 1.0]) + stretch_compliance * (frame.T @ pull))
            return length * np.concatenate([tangent, (frame @ turn).ravel(), -np.cross(tangent, pull)])

        base = lambda m: np.concatenate([np.zeros(3), np.asarray(base_frame, float).ravel(), m])
        return shooting(equation, base, guess, lambda end: end[12:15] / np.max(np.abs(stiffness)) * length)

    guess = np.zeros(3)
    for factor in np.linspace(0.0, 1.0, steps + 1)[1:]:
        guess, end = solve(factor, guess)
    return end[:3]


def universal_shape(balance, s=1.0):
    """x, z and angle from upright at s of a shoot of unit length on its side that rights itself by G = balance
    (Bastien et al. 2013)."""
    return np.array(
        [
            2.0 / balance * np.arctan(np.tanh(balance * s / 2.0)),
            np.log(np.cosh(balance * s)) / balance,
            2.0 * np.arctan(np.exp(-balance * s)),
        ]
    )


def growth_that_buckles(radius, shear_over_young):
    """Growth strain at which a straight rod between clamps one apart buckles, stretch and shear included: the first
    solution of B θ'' + P (1 - P/EA + P/αGA) θ = 0 with two whole waves over the grown length."""

    def excess(growth):
        pressure = growth / (1.0 + growth)  # over EA
        inertia = radius**2 / 4.0  # I / A
        wave = 2.0 * np.pi / (1.0 + growth)
        return pressure * (1.0 - pressure + pressure / shear_over_young) - inertia * wave**2

    return brentq(excess, 0.0, 0.1, xtol=1e-15)


def rk4(rate, state, step):
    k1 = rate(state)
    k2 = rate(state + 0.5 * step * k1)
    k3 = rate(state + 0.5 * step * k2)
    k4 = rate(state + step * k3)
    return state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def angles_along(curvature, base=0.0):
    """From curvatures at equal distances along unit length, by the trapezoidal rule."""
    cells = 0.5 * (curvature[1:] + curvature[:-1]) / (len(curvature) - 1)
    return base + np.concatenate([[0.0], np.cumsum(cells)])


def least_angle_of_righting(balance, base, duration=4.0, cells=200, step=0.01):
    """Of the tip [rad] of a shoot whose curvature follows k' = -B sin A - k, with the angle `base` at its base."""
    curvature, tip = np.zeros(cells + 1), []
    for _ in range(round(duration / step)):
        curvature = rk4(lambda k: -balance * np.sin(angles_along(k, base)) - k, curvature, step)
        tip.append(angles_along(curvature, base)[-1])
    return min(tip)


def largest_answer_to_light(intensities, step, sensitivity=5.0, straightening=0.5, cells=200):
    """Of the tip [rad] of an upright organ of unit length that is lit from the side, by intensities that hold for a
    step each, and perceives p with p' = I cos A - p: k' = sensitivity p - straightening k."""
    state, tip = np.zeros((2, cells + 1)), []  # curvature, perceived
    for intensity in intensities:

        def rate(state):
            sensed = intensity * np.cos(angles_along(state[0]))
            return np.array([sensitivity * state[1] - straightening * state[0], sensed - state[1]])

        state = rk4(rate, state, step)
        tip.append(angles_along(state[0])[-1])
    return max(tip)


def coarse_answer_to_light(intensities, step, sensitivity=5.0, straightening=0.5, elements=100):
    """The same at first order: base frozen into the first element, light sensed in the element above a bend, Euler
    steps, and a memory that sums what was sensed, the present included."""
    curvature, perceived, largest = np.zeros(elements - 1), np.zeros(elements - 1), 0.0
    for intensity in intensities:
        angles = np.cumsum(curvature) / elements
        largest = max(largest, angles[-1])
        perceived = np.exp(-step) * perceived + step * intensity * np.cos(angles)
        curvature = curvature + step * (sensitivity * perceived - straightening * curvature)
    return largest
