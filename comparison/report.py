"""Pictures and tables of the comparison, from the result files of its jobs."""

import argparse
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from comparison import theory
from comparison.job import all_jobs
from comparison.shoot import GREENHILL, LAWS

PACKAGE = pathlib.Path(__file__).resolve().parent.parent
PAGE = PACKAGE / "docs" / "three_growth_models.md"
PICTURES = PACKAGE / "docs" / "pictures" / "three_growth_models"
TEMPLATE = pathlib.Path(__file__).parent / "page.md"

COLOURS = {"intrinsic": "#3b6ea5", "actual": "#2c7d4f", "relaxation": "#b5482f"}
BEHAVIOURS = {  # name: marker, colour
    "rights itself": ("o", "#2c7d4f"),
    "overshoots by more than 1°, then rests": ("o", "#9ccc65"),
    "falls aside": ("^", "#7a5195"),
    "swings; small swings die out": ("D", "#f2c14e"),
    "swings of itself, more and more": ("s", "#e07b39"),
    "bends over without swinging": ("X", "#8c2d19"),
}


def load(results, quick):
    found, missing = {}, []
    for name, _, _ in all_jobs(quick):
        path = results / f"{name}.json"
        if path.exists():
            found[name] = json.loads(path.read_text(encoding="utf-8"))
        else:
            missing.append(name)
    if missing:
        sys.exit(f"comparison: {len(missing)} of {len(missing) + len(found)} results are missing, such as {missing[0]}")
    return found


def select(results, kind, law=None):
    """Results of a kind with their arguments, law first."""
    chosen = [(r["arguments"], r) for name, r in results.items() if name.startswith(f"{kind}_")]
    return [(arguments, r) for arguments, r in chosen if law in (None, arguments[0])]


def behaviour(point):
    rate, frequency = point["disturbed"]["rate"], point["disturbed"]["frequency"]
    if rate > 0.0:
        return "swings of itself, more and more" if frequency > 0.1 * rate else "bends over without swinging"
    if point["laid"]["aside"] > 0.01:
        return "falls aside"
    if not point["laid"]["rests"]:
        return "swings; small swings die out"
    return "rights itself" if point["laid"]["overshoot"] < 1.0 else "overshoots by more than 1°, then rests"


def save(figure, name):
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(PICTURES / f"{name}.svg", metadata={"Date": None}, bbox_inches="tight", dpi=150)
    plt.close(figure)


def draw_behaviours(results):
    figure, panels = plt.subplots(1, 3, figsize=(12, 4.6), sharey=True, constrained_layout=True)
    for axes, law in zip(panels, LAWS):
        for (_, G, S), point in select(results, "point", law):
            marker, colour = BEHAVIOURS[behaviour(point)]
            axes.scatter(G, S, marker=marker, color=colour, s=60)
        axes.axhline(GREENHILL, color="0.4", linestyle=":")
        axes.set(title=f"law: {law}", xlabel="G, righting over straightening")
    balances = np.linspace(0.2, 3.1, 30)
    panels[2].plot(balances, [theory.onset(G)[0] for G in balances], color="k", linewidth=1)
    panels[0].set_ylabel("S, weight over stiffness")
    panels[0].text(0.5, GREENHILL + 0.08, "falls over by its weight alone", fontsize="small", color="0.4")
    handles = [plt.Line2D([], [], linestyle="", marker=m, color=c, label=name) for name, (m, c) in BEHAVIOURS.items()]
    handles.append(plt.Line2D([], [], color="k", linewidth=1, label="onset, linear theory"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, frameon=False)
    save(figure, "behaviours")


def draw_onsets(results):
    onsets = [(G, r) for (_, G), r in select(results, "onset", "relaxation") if r["onset"] is not None]
    balances = np.linspace(0.2, 3.1, 60)
    curve = np.array([theory.onset(G) for G in balances])
    figure, panels = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    for axes, column, value, error in zip(panels, (0, 1), ("onset", "frequency"), ("error", "frequency_error")):
        axes.plot(balances, curve[:, column], color="0.5", label="linear theory")
        axes.errorbar(
            [G for G, _ in onsets],
            [r[value] for _, r in onsets],
            [r[error] for _, r in onsets],
            fmt="o",
            capsize=4,
            markersize=4,
            color=COLOURS["relaxation"],
            label="bisection in the full simulation",
        )
        axes.set_xlabel("G, righting over straightening")
    panels[0].axhline(GREENHILL, color="0.4", linestyle=":", label="Greenhill's load")
    panels[0].set_ylabel("S_H, weight at which swings begin")
    panels[1].set_ylabel("angular frequency there, over the rate of straightening")
    panels[0].legend(frameon=False)
    save(figure, "onset")


def draw_righting(results):
    figure, panels = plt.subplots(2, 3, figsize=(12, 7), constrained_layout=True)
    for column, (G, S) in enumerate(((1.0, 1.0), (2.0, 3.0), (4.0, 6.0))):
        for law in LAWS:
            run = results[f"point_{law}_G{G}_S{S}"]["laid"]
            shape, angles = np.array(run["shape"]), np.array(run["angles"])
            panels[0, column].plot(*shape.T, color=COLOURS[law], label=law)
            panels[1, column].plot(run["frame_time"] * np.arange(len(angles)), angles, color=COLOURS[law], label=law)
        panels[0, column].set(title=f"G = {G:.0f}, S = {S:.0f}", xlabel="x / L", aspect="equal")
        panels[1, column].axhline(0.0, color="0.7", linewidth=0.8)
        panels[1, column].set(xlabel="time", ylim=(-190, 190))
    panels[0, 0].set_ylabel("height / L, at the end")
    panels[1, 0].set_ylabel("angle of the tip from upright [°]")
    panels[0, 0].legend(frameon=False)
    save(figure, "righting")


def draw_orbits(results):
    shown = [results[f"orbit_relaxation_G1.0_S{S}"] for S in ("2.2_n60", "2.4_n60", "2.6_n60", "2.6_n120")]
    figure, panels = plt.subplots(1, 3, figsize=(13, 4.2), constrained_layout=True)
    last = shown[1]
    tip = np.array(last["tip"])
    times = last["frame_time"] * np.arange(len(tip))
    points = panels[0].scatter(tip[:, 0], tip[:, 1], c=times, s=1.5, cmap="viridis", rasterized=True)
    panels[0].set(xlabel="x / L", ylabel="y / L", aspect="equal", title="tip from above, G = 1, S = 2.4")
    figure.colorbar(points, ax=panels[0], label="time")
    for run, colour in zip(shown, ("#2c7d4f", "#e07b39", "#8c2d19", "#5b7fb5")):
        tip = np.array(run["tip"])
        times = run["frame_time"] * np.arange(len(tip))
        label = f"S = {run['arguments'][2]}, {run['arguments'][-1]} elements"
        panels[1].plot(times, np.hypot(tip[:, 0], tip[:, 1]), color=colour, linewidth=1, label=label)
        panels[2].semilogy(times, run["largest_curvature"], color=colour, linewidth=1, label=label)
    panels[1].set(xlabel="time", ylabel="distance of the tip from the vertical / L", title="the swing")
    panels[2].set(xlabel="time", ylabel="largest curvature × L", title="the curl")
    panels[2].legend(frameon=False, loc="lower right")
    save(figure, "orbits")


def row(*cells):
    return "| " + " | ".join(cells) + " |"


def onset_table(results):
    lines = [row("G", "S_H, simulated", "S_H, theory", "difference", "ω, simulated", "ω, theory"), row(*["---"] * 6)]
    for (_, G), r in select(results, "onset", "relaxation"):
        predicted = theory.onset(G)
        if r["onset"] is None or predicted is None:
            agree = "none" if r["onset"] is None else f"{r['onset']:.3f}"
            lines.append(row(f"{G}", agree, "none" if predicted is None else f"{predicted[0]:.4f}", "", "", ""))
            continue
        S, frequency = predicted
        lines.append(
            row(
                f"{G}",
                f"{r['onset']:.4f} ± {r['error']:.4f}",
                f"{S:.4f}",
                f"{100.0 * (r['onset'] / S - 1.0):+.2f} %",
                f"{r['frequency']:.4f} ± {r['frequency_error']:.4f}",
                f"{frequency:.4f}",
            )
        )
    return "\n".join(lines)


def grid_table(results):
    head = (
        "law",
        "G",
        "S",
        "tip at rest x, z",
        "tip angle",
        "overshoot",
        "settles in",
        "rate",
        "frequency",
        "behaviour",
    )
    lines = [row(*head), row(*["---"] * len(head))]
    for (law, G, S), point in select(results, "point"):
        laid, disturbed = point["laid"], point["disturbed"]
        resting = laid["rests"] and laid["aside"] <= 0.01
        lines.append(
            row(
                law,
                f"{G}",
                f"{S:.0f}",
                f"{laid['tip'][0]:.3f}, {laid['tip'][2]:.3f}" if resting else "–",
                f"{laid['tip_angle']:.1f}°" if resting else "–",
                f"{laid['overshoot']:.1f}°" if resting else "–",
                f"{laid['settling_time']:.1f}" if resting and laid["settling_time"] is not None else "–",
                f"{disturbed['rate']:.3f} ± {disturbed['rate_error']:.3f}",
                f"{disturbed['frequency']:.3f} ± {disturbed['frequency_error']:.3f}",
                behaviour(point),
            )
        )
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(prog="comparison.report", description=__doc__)
    parser.add_argument("--results", type=pathlib.Path, required=True)
    parser.add_argument("--quick", action="store_true", help="print tables of the quick jobs, write nothing")
    arguments = parser.parse_args()
    results = load(arguments.results, arguments.quick)
    if arguments.quick:
        print(onset_table(results), grid_table(results), sep="\n\n")
        return
    matplotlib.rcParams["svg.hashsalt"] = "three_growth_models"
    for draw in (draw_behaviours, draw_onsets, draw_righting, draw_orbits):
        draw(results)
    text = TEMPLATE.read_text(encoding="utf-8")
    text = text.replace("<!-- onsets -->", onset_table(results)).replace("<!-- grid -->", grid_table(results))
    PAGE.write_text(text, encoding="utf-8")
    print(PAGE)


if __name__ == "__main__":
    main()
