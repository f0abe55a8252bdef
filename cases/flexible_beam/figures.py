#!/usr/bin/env python3
"""Pictures of a run of the flexible beam: figures.py OUTPUT_FOLDER [--still]

Writes tip.png (the tip in time), period.png (tip and force over a period; beside the reference, that of FSI3, where the beam is as dense as the
fluid), field.png (speed, at the end) and beam.gif (not with --still).
"""
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import PillowWriter

import beam  # puts scripts/ on the path
import phases
from series import upward
from snapshot import Window, paint, read_run

LABELS = {"x": "x of the tip [mm]", "y": "y of the tip [mm]", "drag": "drag [N/m]", "lift": "lift [N/m]"}
PERIODS = 4  # that are shown
WINDOW = Window((0.1, 0.0), (1.3, 0.41))
FRAMES = 60  # of the animation, the last ones


def draw_tip(run, path):
    figure, axes = plt.subplots(2, 1, figsize=(8.0, 5.0), sharex=True, layout="constrained")
    for axis, name in zip(axes, ("y", "x")):
        axis.plot(run.t, run.series[name], linewidth=0.8)
        axis.set_ylabel(LABELS[name])
    axes[1].set_xlabel("t [s]")
    figure.savefig(path, dpi=150)


def draw_period(run, path):
    """Time in periods since the tip passed its middle upwards.  Nothing where it has not swung often enough."""
    crossings = upward(run.t, run.series["y"])[-PERIODS - 1:]
    if len(crossings) <= PERIODS or np.ptp(run.series["y"]) < 1.0:
        return
    frequency = PERIODS / (crossings[-1] - crossings[0])
    known = beam.reference()
    start = upward(*(np.concatenate([known[name], known[name] + shift]) for name, shift in (("t", beam.PERIOD), ("y", 0.0))))[0]
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 5.5), sharex=True, layout="constrained")
    for axis, name in zip(axes.flat, ("y", "x", "lift", "drag")):
        t, values = run.times(name)
        late = (t > crossings[0]) & (t <= crossings[-1])
        phase = ((t[late] - crossings[0]) * frequency) % 1.0
        axis.plot(phase, values[late], ".", markersize=1.5, label="computed, %d periods" % PERIODS)
        axis.plot(((known["t"] - start) / beam.PERIOD) % 1.0, known[name], "k+", markersize=5.0, label="reference, FSI3")
        axis.set_ylabel(LABELS[name])
    for axis in axes[1]:
        axis.set_xlabel("t in periods")
    axes[0, 0].legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=150)


def draw_field(folder, time, axes, limits):
    found, fluid, body = read_run(folder, time)
    grid = fluid["velocity"]
    speed = np.hypot(*grid.node["velocity"][:, :2].T)
    paint(axes, grid, speed, WINDOW, limits or (0.0, speed.max()), "viridis", "speed [m/s], t = %.3f s" % found, body, cover=True)
    return speed.max()


def main():
    folder = pathlib.Path(sys.argv[1])
    run = beam.Run(folder, 0.0)
    draw_tip(run, folder / "tip.png")
    draw_period(run, folder / "period.png")
    figure, axes = plt.subplots(figsize=(8.0, 3.6), layout="constrained")
    fastest = draw_field(folder, None, axes, None)
    figure.savefig(folder / "field.png", dpi=150)
    if "--still" not in sys.argv:
        writer = PillowWriter(fps=15)
        with writer.saving(figure, folder / "beam.gif", dpi=80):
            for time in phases.snapshot_times(folder)[-FRAMES:]:
                figure.clear()
                draw_field(folder, time, figure.subplots(), (0.0, fastest))
                writer.grab_frame()


main()
