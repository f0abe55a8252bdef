#!/usr/bin/env python3
"""Pictures of a run of the floating square: figures.py OUTPUT_FOLDER [--still]

Writes floating.png (at the times of the paper's Figs. 15 and 16), motion.png (the square's path, how much of it is wet, the water at
the wall) and floating.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt

from floating import PAPER, Floating  # puts scripts/ on the path
import phases

TIMES = (0.0, 0.15, 0.255, 0.4, 0.705, 0.91, 1.2, 1.4)  # s


def draw_motion(run, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.0), layout="constrained")
    left.plot(run.solid_t, run.x, label="square's middle, x")
    left.plot(run.solid_t, run.y, label="y")
    left.plot(run.t, run.wall, color="0.6", linewidth=0.8, label="water at the right wall")
    right.plot(run.times, run.wet, "o-", markersize=3, label="part of the faces that is wet")
    right.axhline(0.5, color="0.7")
    right.axvline(PAPER["half sunk"], color="0.7", linestyle="--", label="half sunk, paper")
    left.set(xlabel="t [s]", ylabel="[m]")
    right.set(xlabel="t [s]", ylim=(0.0, 1.0))
    for axis in (left, right):
        axis.legend(frameon=False, fontsize=9)
    figure.savefig(path, dpi=150)


def main():
    folder = sys.argv[1]
    draw_motion(Floating(folder), os.path.join(folder, "motion.png"))
    phases.draw_times(folder, TIMES, "water", os.path.join(folder, "floating.png"), columns=4, arrows=0.015, size=(4.2, 3.0))
    if "--still" not in sys.argv:
        phases.animate(folder, "water", os.path.join(folder, "floating.gif"), size=(7.0, 4.8))


main()
