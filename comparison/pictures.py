"""Pictures of the comparison."""

import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from comparison import theory
from comparison.behaviour import BEHAVIOURS, at_rest, behaviour, select, upright_stands
from comparison.job import GRID_G
from comparison.shoot import GREENHILL, LAWS

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "docs" / "pictures" / "three_growth_models"
COLOURS = {"intrinsic": "#3b6ea5", "actual": "#2c7d4f", "relaxation": "#b5482f"}


def save(figure, name):
    FOLDER.mkdir(parents=True, exist_ok=True)
    figure.savefig(FOLDER / f"{name}.svg", metadata={"Date": None}, bbox_inches="tight", dpi=150)
    plt.close(figure)


def draw_behaviours(results):
    figure, panels = plt.subplots(1, 3, figsize=(12, 4.6), sharey=True, constrained_layout=True)
    for axes, law in zip(panels, LAWS):
        for (_, G, S), point in select(results, "point", law):
            marker, colour = BEHAVIOURS[behaviour(law, point)]
            axes.scatter(G, S, marker=marker, color=colour, s=60)
        axes.axhline(GREENHILL, color="0.4", linestyle=":")
        how = "upright (laid, it winds up)" if law == "relaxation" else "laid on its side"
        axes.set(title=f"{law}, {how}", xlabel="G, righting over straightening")
    onsets = np.array([(G, theory.onset(G)[0]) for G in np.linspace(0.2, 3.1, 30)])
    panels[2].plot(*onsets.T, color="k", linewidth=1)
    panels[0].set_ylabel("S, weight over stiffness")
    panels[0].text(
        0.5, GREENHILL + 0.08, "an upright shoot falls over by its weight alone", fontsize="small", color="0.4"
    )
    handles = [plt.Line2D([], [], linestyle="", marker=m, color=c, label=name) for name, (m, c) in BEHAVIOURS.items()]
    handles.append(plt.Line2D([], [], color="k", linewidth=1, label="onset of swings, linear theory"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=3, frameon=False)
    save(figure, "behaviours")


def draw_onset(results):
    onsets = [(G, r) for (_, G, *_), r in select(results, "onset") if r["onset"] is not None]
    balances = np.hstack((np.linspace(0.2, 2.8, 40), np.linspace(2.82, 3.15, 40)))  # steep towards its end
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
        axes.set_xlabel("G, righting over yielding")
    panels[0].axhline(GREENHILL, color="0.4", linestyle=":", label="Greenhill's load")
    panels[0].set_ylabel("S_H, weight at which swings begin to grow")
    panels[1].set_ylabel("angular frequency there, radians per 1/γ")
    panels[0].legend(frameon=False)
    save(figure, "onset")


def draw_righting(results):
    figure, panels = plt.subplots(2, 3, figsize=(12, 7), constrained_layout=True)
    for column, (G, S) in enumerate(((1.0, 1.0), (2.0, 3.0), (4.0, 6.0))):
        for law in LAWS:
            run = results[f"point_{law}_G{G}_S{S}"]["laid"]
            times = run["frame_time"] * np.arange(len(run["angles"]))
            label = law if at_rest(run) else f"{law}, t = {times[-1]:.0f}"
            panels[0, column].plot(*np.array(run["shape"]).T, color=COLOURS[law], label=label)
            panels[1, column].plot(times, run["angles"], color=COLOURS[law])
        panels[0, column].set(title=f"G = {G:.0f}, S = {S:.0f}", xlabel="x / L", aspect="equal")
        panels[0, column].legend(frameon=False, fontsize="small")
        panels[1, column].axhline(0.0, color="0.7", linewidth=0.8)
        panels[1, column].set(xlabel="time, in 1/γ", xlim=(0, 40), ylim=(-190, 190))
    panels[0, 0].set_ylabel("height / L")
    panels[1, 0].set_ylabel("angle of the tip from upright [°]")
    save(figure, "righting")


def draw_settling(results):
    """Overshoot and the time that it takes, over weight, a line per G; under relaxation, where an upright shoot stands,
    the first swing and the end."""
    figure, panels = plt.subplots(2, 3, figsize=(12, 7), sharex=True, constrained_layout=True)
    shades = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(GRID_G)))
    for column, law in zip(panels.T, LAWS):
        relaxing = law == "relaxation"
        names = ("beyond_upright", "end_time") if relaxing else ("overshoot", "settling_time")
        for G, colour in zip(GRID_G, shades):
            points = [(S, point) for (_, g, S), point in select(results, "point", law) if g == G]
            shown = [(S, p["laid"]) for S, p in points if (upright_stands(p) if relaxing else at_rest(p["laid"]))]
            for axes, name in zip(column, names):
                axes.plot(
                    [S for S, _ in shown], [run[name] for _, run in shown], ".-", color=colour, label=f"G = {G:g}"
                )
        column[0].set(
            title=law, ylabel="first swing beyond upright [°]" if relaxing else "overshoot beyond its end [°]"
        )
        column[1].set(ylabel="time until wound up, in 1/γ" if relaxing else "time to stay within 1° of its end, in 1/γ")
        column[1].set(xlabel="S, weight over stiffness")
    panels[1, 2].set_yscale("log")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=len(GRID_G), frameon=False)
    save(figure, "settling")


def draw_orbits(results):
    figure, panels = plt.subplots(2, 2, figsize=(11, 8), constrained_layout=True)
    run = results["orbit_relaxation_G1.0_S2.4_n60_step0.05"]
    tip = np.array(run["tip"])
    times = run["frame_time"] * np.arange(len(tip))
    points = panels[0, 0].scatter(tip[:, 0], tip[:, 1], c=times, s=1.5, cmap="viridis", rasterized=True)
    panels[0, 0].set(xlabel="x / L", ylabel="y / L", aspect="equal", title="tip from above, G = 1, S = 2.4")
    figure.colorbar(points, ax=panels[0, 0], label="time, in 1/γ")
    for name, colour, style in (
        ("G1.0_S2.2_n60", "#2c7d4f", "-"),
        ("G1.0_S2.4_n60", "#e07b39", "-"),
        ("G1.0_S2.6_n60", "#8c2d19", "-"),
        ("G1.0_S2.6_n120", "#8c2d19", ":"),
        ("G2.0_S5.0_n60", "#5b7fb5", "-"),
        ("G2.0_S5.0_n120", "#5b7fb5", ":"),
    ):
        run = results[f"orbit_relaxation_{name}_step0.05"]
        _, G, S, _, _, elements, _ = run["arguments"]
        tip = np.array(run["tip"])
        times = run["frame_time"] * np.arange(len(tip))
        look = {"color": colour, "linestyle": style, "linewidth": 1.2}
        panels[0, 1].plot(times, np.hypot(tip[:, 0], tip[:, 1]), **look)
        panels[1, 0].semilogy(times, run["bending"], **look)
        panels[1, 1].semilogy(times, run["twist"], label=f"G = {G:g}, S = {S:g}, {elements} elements", **look)
    panels[0, 1].set(title="distance of the tip from the vertical / L")
    panels[1, 0].set(title="sharpest bend × L", xlabel="time, in 1/γ", ylim=(1e-2, 300))
    panels[1, 1].set(title="strongest twist × L", xlabel="time, in 1/γ", ylim=(1e-3, 300))
    panels[1, 1].legend(frameon=False, fontsize="small", loc="lower right")
    save(figure, "orbits")


def draw(results):
    matplotlib.rcParams["svg.hashsalt"] = "three_growth_models"
    for picture in (draw_behaviours, draw_onset, draw_righting, draw_settling, draw_orbits):
        picture(results)
