"""The programs under test, run as a user runs them, and what they leave behind."""

import json
import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import yaml


@dataclass(frozen=True)
class State:
    """One recorded state of an organ; vectors are rows."""

    time: float
    positions: np.ndarray
    arc_length: np.ndarray
    frames: np.ndarray  # quaternions x, y, z, w of the elements
    curvature: np.ndarray
    rest_curvature: np.ndarray
    strain: np.ndarray
    tip: np.ndarray
    tip_frame: np.ndarray  # rotation matrix, columns d1, d2, d3
    rest_length: float
    lowest_eigenvalue: float

    @property
    def tangent(self):
        return self.tip_frame[:, 2]

    @property
    def tangents(self):
        """Of the elements."""
        return np.array([rotation(*frame)[:, 2] for frame in self.frames])


def _row(message, *names):
    return np.array([getattr(message, name) for name in names])


def _rows(messages):
    return np.array([[m.x, m.y, m.z] for m in messages])


def rotation(x, y, z, w):
    """Matrix of a unit quaternion."""
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _state(message):
    return State(
        time=message.growth_time,
        positions=_rows(message.positions),
        arc_length=np.array(message.rest_arc_length),
        frames=np.array([[q.x, q.y, q.z, q.w] for q in message.frames]),
        curvature=_rows(message.curvature),
        rest_curvature=_rows(message.rest_curvature),
        strain=_rows(message.strain),
        tip=_row(message.tip.position, "x", "y", "z"),
        tip_frame=rotation(*_row(message.tip.orientation, "x", "y", "z", "w")),
        rest_length=message.rest_length,
        lowest_eigenvalue=message.relaxation.lowest_eigenvalue,
    )


def read_bag(path, last=False):
    """States of every organ in order of time, or the last of each alone, which takes no time."""
    import genpy
    import rosbag

    states = {}
    with rosbag.Bag(str(path)) as bag:
        start = genpy.Time.from_sec(bag.get_end_time() - 1e-6) if last else None
        types = bag.get_type_and_topic_info().topics
        topics = [name for name, info in types.items() if info.msg_type == "sensory_growth/OrganState"]
        for _, message, _ in bag.read_messages(topics=topics, start_time=start):
            states.setdefault(message.organ, []).append(_state(message))
    return states


DEADLINE = 300.0  # wall seconds for any one program; the longest takes a tenth of that


class RunFailed(Exception):
    """A program ended with another exit code than it should have, or not at all."""


def run_program(name, command):
    """What it prints."""
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, timeout=DEADLINE)
    except subprocess.TimeoutExpired as late:
        raise RunFailed(f"{name} did not end within {DEADLINE:.0f} s") from late
    if done.returncode != 0:
        raise RunFailed(f"{name} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


@dataclass(frozen=True)
class Picture:
    name: str
    caption: str


class Bench:
    """Runs scenarios of one case in a folder of its own, whose files are numbered in order of their runs."""

    def __init__(self, programs, folder, pictures=None):
        self.programs = pathlib.Path(programs)
        self.folder = pathlib.Path(folder)
        self.pictures = pictures
        self.drawn = []
        self._runs = 0
        self.folder.mkdir(parents=True, exist_ok=True)

    def write(self, content):
        self._runs += 1
        path = self.folder / f"{self._runs:03}.yaml"
        path.write_text(yaml.safe_dump(content, sort_keys=False, width=120), encoding="utf-8")
        return path

    def call(self, program, *arguments):
        return run_program(program, [self.programs / program, *arguments])

    def _record(self, content):
        path = self.write(content)
        bag = path.with_suffix(".bag")
        bag.unlink(missing_ok=True)
        self.call("sensory_growth_batch", "run", path, "--bag", bag, "--marker-every", 0, "--threads", 1, "--quiet")
        return bag

    def states(self, content):
        """Runs a scenario into a bag: states of every organ by its id."""
        return read_bag(self._record(content))

    def centrelines(self, content, every=1):
        """Runs a scenario without a bag, which is faster: positions of the only organ, a matrix per frame."""
        path = self.write(content)
        folder = path.with_suffix(".csv")
        shutil.rmtree(folder, ignore_errors=True)
        self.call("sensory_growth_batch", "run", path, "--csv", folder, "--every", every, "--threads", 1, "--quiet")
        (table,) = folder.glob("*.csv")
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        starts = np.flatnonzero(np.diff(rows[:, 0])) + 1
        return np.split(rows[:, 1:], starts)

    def live(self, content, steps, lights=(), growth_time_scale=60):
        """Lets the live node run a scenario under lights sent on its topic: states of every organ from the bag."""
        path = self.write(content)
        bag = path.with_suffix(".bag")
        command = [sys.executable, "-m", "validation.live_run", path, bag, steps, "--lights", json.dumps(lights)]
        command += ["--growth-time-scale", growth_time_scale, "--deadline", DEADLINE / 2]
        run_program("the live run", command)
        return read_bag(bag)

    def last(self, content):
        """State of the only organ of a scenario at its end."""
        (states,) = read_bag(self._record(content), last=True).values()
        return states[-1]

    def picture(self, name, caption, draw, panels=1):
        """Lets draw(*axes) make a picture, if pictures are wanted."""
        if self.pictures is None:
            return
        import matplotlib

        matplotlib.use("Agg")
        matplotlib.rcParams["svg.hashsalt"] = name  # the same file from the same data
        import matplotlib.pyplot as plt

        width = 6.0 if panels == 1 else 3.6 * panels
        figure, axes = plt.subplots(1, panels, figsize=(width, 4.0), constrained_layout=True, squeeze=False)
        draw(*axes[0])
        self.pictures.mkdir(parents=True, exist_ok=True)
        figure.savefig(self.pictures / f"{name}.svg", metadata={"Date": None})
        plt.close(figure)
        self.drawn.append(Picture(name, caption))
