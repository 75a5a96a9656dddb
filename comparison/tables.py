"""Tables of the comparison, and the figures that its text quotes."""

import numpy as np

from comparison import theory
from comparison.behaviour import at_rest, behaviour, select, upright_stands
from comparison.shoot import LAWS

# A green stem, by figures that config/three_growth_laws.yaml cites.
YOUNG_MODULUS = 10.0e6  # [Pa]
WEIGHT = 1000.0 * 9.81  # [N/m^3]
GROWTH = 1.0 / 20.0  # relative elongation rate [1/h]
SENSITIVITY = 0.8  # to gravity


def table(head, rows):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (head, ["---"] * len(head), *rows))


def between(values, form="{:.2f}"):
    """From the smallest to the largest."""
    low, high = form.format(min(values)), form.format(max(values))
    return low if low == high else f"{low} to {high}"


def onset_table(results):
    rows = []
    for (_, G, *_), r in select(results, "onset"):
        predicted = theory.onset(G)
        if r["onset"] is None:
            rows.append(
                [f"{G}", f"none up to {r['heaviest']}", f"{predicted[0]:.4f}" if predicted else "none", "", "", ""]
            )
            continue
        S, frequency = predicted
        rows.append(
            [
                f"{G}",
                f"{r['onset']:.4f} ± {r['error']:.4f}",
                f"{S:.4f}",
                f"{100.0 * (r['onset'] / S - 1.0):+.2f} %",
                f"{r['frequency']:.4f} ± {r['frequency_error']:.4f}",
                f"{frequency:.4f}",
            ]
        )
    return table(["G", "S_H, simulated", "S_H, theory", "difference", "ω, simulated", "ω, theory"], rows)


def orbit_figures(run):
    """Ends of an orbit: distances of the tip in the last tenth, bending and twist, and twist from element to element."""
    distance = np.hypot(*np.array(run["tip"])[:, :2].T)
    twist = np.array(run["twist"])
    strong = np.flatnonzero(twist > 30.0)
    return {
        "end": (len(twist) - 1) * run["frame_time"],
        "tip": distance[-len(distance) // 10 :],
        "widest": np.max(distance),
        "bending": run["bending"][-1],
        "twist": twist[-1],
        "turn": twist[-1] / run["arguments"][5],
        "twisted": strong[0] * run["frame_time"] if len(strong) else None,
    }


def orbit_table(results):
    rows = []
    for (_, G, S, push, _, elements, step), run in select(results, "orbit"):
        found = orbit_figures(run)
        rows.append(
            [
                f"{G:g}",
                f"{S:g}",
                f"{100.0 * (S / theory.onset(G)[0] - 1.0):+.1f} %" if theory.onset(G) else "no onset",
                f"{push:g}",
                f"{elements}",
                f"{step:g}",
                f"{found['end']:.0f}, " + ("still moving" if run["ended"] else "too tight"),
                f"{found['widest']:.2f}",
                between(found["tip"], "{:.3f}"),
                f"{found['bending']:.3g}",
                f"{found['twist']:.3g}",
                f"{found['twisted']:.0f}" if found["twisted"] else "–",
            ]
        )
    head = ["G", "S", "from onset", "push", "elements", "step", "followed to", "tip, farthest", "tip, last tenth"]
    return table(head + ["bend × L, end", "twist × L, end", "twist 30/L at"], rows)


def restless_table(results):
    rows = []
    for (law, G, S), r in select(results, "restless"):
        for run in r["runs"]:
            x, y, z = run["tip"]
            rest = theory.rest_tip(G)
            away = np.linalg.norm([x - rest[0], y, z - rest[1]])
            rows.append(
                [
                    law,
                    f"{G:g}",
                    f"{S:g}",
                    f"{run['step']:g}",
                    f"{run['largest_jump']:.1g}",
                    f"{abs(y):.3f}",
                    f"{away:.3f}" if law == "actual" else "–",
                ]
            )
    return table(["law", "G", "S", "step", "largest jump / L", "tip aside / L", "tip from the shape of rest / L"], rows)


def has_mode(upright):
    """Whether one mode tells how an upright shoot goes on: it grows, or two halves of the record agree on it."""
    if "rate" not in upright:
        return False
    agree = all(upright[f"{name}_error"] < 0.05 * abs(upright[name]) for name in ("rate", "frequency"))
    return upright["rate"] > 0.0 or agree


def grid_table(results):
    head = ["law", "G", "S", "tip at rest x, z", "tip angle", "overshoot", "beyond upright", "settles in"]
    head += ["rate", "frequency", "behaviour"]
    rows = []
    for (law, G, S), point in select(results, "point"):
        laid, upright = point["laid"], point["disturbed"]
        rest = at_rest(laid)
        rate, frequency = f"{upright['late_rate']:.3f} late", "–"
        if has_mode(upright):
            rate = f"{upright['rate']:.3f} ± {upright['rate_error']:.3f}"
            if upright["frequency"] > upright["frequency_error"] and upright["frequency"] > 0.1 * abs(upright["rate"]):
                frequency = f"{upright['frequency']:.3f} ± {upright['frequency_error']:.3f}"
        rows.append(
            [
                law,
                f"{G}",
                f"{S:g}",
                f"{laid['tip'][0]:.3f}, {laid['tip'][2]:.3f}" if rest else "–",
                f"{laid['tip_angle']:.1f}°" if rest else "–",
                f"{laid['overshoot']:.1f}°" if rest else "–",
                f"{laid['beyond_upright']:.1f}°",
                f"{laid['settling_time']:.1f}" if rest and laid["settling_time"] is not None else "–",
                rate,
                frequency,
                behaviour(law, point),
            ]
        )
    return table(head, rows)


def hours(G, length, radius):
    """1 / gamma, from G = beta L / gamma and beta = sensitivity times growth over radius; lengths alike."""
    return G * radius / (SENSITIVITY * GROWTH * length)


def weight_over_stiffness(length, radius):
    return 4.0 * WEIGHT * length**3 / (YOUNG_MODULUS * radius**2)


def stem_table():
    rows = []
    for name, length, radius in (
        ("wheat coleoptile", 30.0, 0.8),
        ("thin stem", 50.0, 0.5),
        ("herbaceous stem", 100.0, 1.0),
        ("the stem of `config/three_growth_laws.yaml`", 160.0, 2.0),
    ):
        S = weight_over_stiffness(1e-3 * length, 1e-3 * radius)
        rows.append(
            [
                name,
                f"{length:g} mm",
                f"{radius:g} mm",
                f"{S:.2f}",
                *(f"{hours(G, length, radius):.2f} h" for G in (1, 2, 4)),
            ]
        )
    return table(["stem", "length", "radius", "S", "1/γ if G = 1", "G = 2", "G = 4"], rows)


def swing_table(results, radius=1.0):
    """Length at which a stem of 1 mm radius begins to swing, and how long a swing takes."""
    rows = []
    for (_, G, *_), r in select(results, "onset"):
        if r["onset"] is not None and G in (0.5, 1.0, 2.0, 3.0):
            length = 1e3 * (r["onset"] * YOUNG_MODULUS * (1e-3 * radius) ** 2 / (4.0 * WEIGHT)) ** (1.0 / 3.0)
            unit = hours(G, length, radius)
            rows.append([f"{G:g}", f"{length:.0f} mm", f"{unit:.2f} h", f"{2.0 * np.pi / r['frequency'] * unit:.1f} h"])
    return table(["G", "length from which it swings", "1/γ", "period of a swing"], rows)


def quoted_of_rest(results):
    """Figures in the text about shoots laid on their side."""
    laid = {law: [(G, S, p["laid"]) for (_, G, S), p in select(results, "point", law)] for law in LAWS}
    resting = {law: [(G, S, run) for G, S, run in runs if at_rest(run)] for law, runs in laid.items()}
    restless = {law: [f"({G:g}, {S:g})" for G, S, run in runs if not at_rest(run)] for law, runs in laid.items()}
    overshooting = {law: [G for G, _, run in runs if run["overshoot"] > 1.0] for law, runs in resting.items()}
    both = [run for law in ("intrinsic", "actual") for _, _, run in resting[law]]
    misses = [np.linalg.norm(np.array(run["tip"])[[0, 2]] - theory.rest_tip(G)) for G, _, run in resting["actual"]]
    sag = {S: run["tip_angle"] for G, S, run in laid["intrinsic"] if G == 2.0}
    standing = [(G, p["laid"]) for (_, G, _), p in select(results, "point", "relaxation") if upright_stands(p)]
    return {
        "sag_none": f"{sag[0.0]:.0f}°",
        "sag_middle": f"{sag[4.0]:.0f}°",
        "sag_heavy": f"{sag[7.0]:.0f}°",
        "miss": f"{max(misses):.5f}",
        "restless_intrinsic": ", ".join(restless["intrinsic"]),
        "restless_actual": ", ".join(restless["actual"]),
        "overshoot_intrinsic": f"{min(overshooting['intrinsic']):g}",
        "overshoot_actual": f"{min(overshooting['actual']):g}",
        "largest_overshoot": f"{max(run['overshoot'] for run in both):.1f}°",
        "longest": f"{max(run['settling_time'] or 0.0 for run in both):.1f}",
        "wound_points": f"{sum(not run['ended'] for _, _, run in laid['relaxation'])} of {len(laid['relaxation'])}",
        "wound_standing": between([G * run["end_time"] for G, run in standing], "{:.0f}"),
        "wound_all": between([G * run["end_time"] for G, _, run in laid["relaxation"]], "{:.0f}"),
        "swung": between([run["beyond_upright"] for _, run in standing], "{:.1f}") + "°",
    }


def quoted_of_motion(results):
    """Figures in the text about upright shoots."""
    upright = {law: [p["disturbed"] for _, p in select(results, "point", law) if upright_stands(p)] for law in LAWS}
    onsets = [(G, r, theory.onset(G)) for (_, G, *_), r in select(results, "onset") if r["onset"] is not None]
    none = [(G, r) for (_, G, *_), r in select(results, "onset") if r["onset"] is None]
    whirl, finer, slower = (
        orbit_figures(results[f"orbit_relaxation_G2.0_S5.0_{name}"])
        for name in ("n60_step0.05", "n120_step0.05", "n60_step0.025")
    )
    return {
        "late": between([run["late_rate"] for law in ("intrinsic", "actual") for run in upright[law]]),
        "slow": between([run["late_rate"] for run in upright["relaxation"]], "{:.3f}"),
        "onset_worst": f"{100.0 * max(abs(r['onset'] / S - 1.0) for _, r, (S, _) in onsets):.2f} %",
        "frequency_worst": f"{100.0 * max(abs(r['frequency'] / w - 1.0) for _, r, (_, w) in onsets):.2f} %",
        "last_onset": f"{max(G for G, _, _ in onsets):g}",
        "theory_ends": f"{theory.last_onset():.2f}",
        "no_onset": ", ".join(f"{G:g}" for G, _ in none),
        "heaviest": f"{none[0][1]['heaviest']:g}",
        "whirl_tip": between(whirl["tip"]),
        "whirl_bending": f"{whirl['bending']:.0f}",
        "whirl_twist": f"{whirl['twist']:.0f}",
        "whirl_turn": f"{whirl['turn']:.2f}",
        "whirl_end": f"{whirl['end']:.0f}",
        "widest": f"{max(orbit_figures(r)['widest'] for _, r in select(results, 'orbit')):.2f}",
        "twisted": f"{whirl['twisted']:.0f}",
        "twisted_elements": f"{finer['twisted']:.0f}",
        "twisted_step": f"{slower['twisted']:.0f}",
    }
