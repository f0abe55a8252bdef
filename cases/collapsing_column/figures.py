#!/usr/bin/env python3
"""Pictures of a run of the collapsing column: figures.py OUTPUT_FOLDER [--still]

Writes column.png (at the times of the paper's Fig. 13), gauges.png (in the axes of its Fig. 14), motion.png (front and square) and
column.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt

from column import GAUGES, LEFT, PAPER, WALL, Column  # puts scripts/ on the path
import phases

TIMES = (0.0, 0.2, 0.3, 0.39, 0.5, 0.627, 0.7, 0.8)  # s


def draw_gauges(run, path):
    figure, axes = plt.subplots(len(GAUGES), 1, figsize=(6.0, 8.0), sharex=True, layout="constrained")
    for axis, name in zip(axes, GAUGES):
        axis.plot(run.t, run.pressure[name], linewidth=1.0)
        for time in PAPER.values():
            axis.axvline(time, color="0.7", linestyle="--", linewidth=0.8)
        axis.set(ylabel="%s: p/(rho g H)" % name, xlim=(0.0, 0.8), ylim=(-1.0, 20.0))
    axes[0].set_title("dashed: the paper's front at the square (0.390 s) and square at the wall (0.627 s)", fontsize=9)
    axes[-1].set_xlabel("t [s]")
    figure.savefig(path, dpi=150)


def draw_motion(run, path):
    figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
    axes.plot(run.t, run.front, label="front on the floor")
    axes.plot(run.solid_t, LEFT + run.motion, label="square's left face")
    axes.axhline(WALL, color="0.7")
    for name, place in (("front", LEFT), ("wall", WALL - 0.04)):
        axes.plot(PAPER[name], place, "k*", label="paper" if name == "front" else None)
    axes.set(xlabel="t [s]", ylabel="x [m]", xlim=(0.0, 0.8))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main():
    folder = sys.argv[1]
    run = Column(folder)
    draw_gauges(run, os.path.join(folder, "gauges.png"))
    draw_motion(run, os.path.join(folder, "motion.png"))
    phases.draw_times(folder, TIMES, "water", os.path.join(folder, "column.png"), arrows=0.02)
    if "--still" not in sys.argv:
        phases.animate(folder, "water", os.path.join(folder, "column.gif"))


main()
