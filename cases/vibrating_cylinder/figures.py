#!/usr/bin/env python3
"""Pictures of a run of the vibrating cylinder: figures.py OUTPUT_FOLDER

Writes wake.png (vorticity, at the end) and motion.png (y and both forces in time).
"""
import pathlib
import sys

import matplotlib.pyplot as plt

from cylinder import Run  # puts scripts/ on the path
from snapshot import Window, outline, read_run, vorticity

WINDOW, STRONGEST = Window((-3.0, -4.0), (17.0, 4.0)), 2.0  # D; U/D, end of the colour scale


def draw_wake(folder, path):
    _, fluid, body = read_run(folder)
    body.points = body.points[:, :2]
    figure, axes = plt.subplots(figsize=(8.0, 3.6), layout="constrained")
    shade = axes.tripcolor(*vorticity(fluid["velocity"]), shading="gouraud", cmap="RdBu_r", vmin=-STRONGEST, vmax=STRONGEST)
    axes.fill(*body.points[body.cells].transpose(2, 1, 0), color="0.8", linewidth=0.0)
    axes.plot(*outline(body).T, "k", linewidth=0.8)
    WINDOW.frame(axes)
    axes.set(xlabel="x/D", ylabel="y/D")
    figure.colorbar(shade, ax=axes, label="vorticity D/U", extend="both", shrink=0.8)
    figure.savefig(path, dpi=100)


def draw_motion(run, path):
    figure, axes = plt.subplots(2, 1, figsize=(8.0, 5.0), sharex=True, layout="constrained")
    axes[0].plot(run.t, run.y)
    axes[0].set_ylabel("y/D")
    for values, label in ((run.drag, "drag"), (run.lift, "lift")):
        axes[1].plot(run.t_force, values, linewidth=0.8, label=label)
    axes[1].set(xlabel="t U/D", ylabel="coefficients", ylim=(-1.5, 3.5))
    axes[1].legend(frameon=False)
    figure.savefig(path, dpi=100)


def main():
    folder = pathlib.Path(sys.argv[1])
    draw_wake(folder, folder / "wake.png")
    draw_motion(Run(folder), folder / "motion.png")


main()
