#!/usr/bin/env python3
"""Pictures of a run of the elastic obstacle: figures.py OUTPUT_FOLDER [--still]

Writes tip.png (the tip beside two published curves), obstacle.png (water and wall at eight times) and obstacle.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt

from obstacle import CODES, Obstacle, reference  # puts scripts/ on the path
import phases

TIMES = (0.0, 0.1, 0.15, 0.2, 0.25, 0.35, 0.5, 0.7)  # s


def draw_tip(run, path):
    codes = reference()
    figure, axes = plt.subplots(figsize=(6.5, 4.0), layout="constrained")
    axes.plot(run.t, 1e3 * run.x, label="computed")
    for name, style in zip(CODES, ("k--", "k:")):
        axes.plot(codes["t"], 1e3 * codes[name], style, linewidth=1.0, label=name.capitalize() + " et al.")
    axes.set(xlabel="t [s]", ylabel="displacement of the tip [mm]", xlim=(0.0, 1.0))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main():
    folder = sys.argv[1]
    draw_tip(Obstacle(folder), os.path.join(folder, "tip.png"))
    phases.draw_times(folder, TIMES, "water", os.path.join(folder, "obstacle.png"), columns=4, size=(3.0, 3.1))
    if "--still" not in sys.argv:
        phases.animate(folder, "water", os.path.join(folder, "obstacle.gif"), size=(5.0, 5.2))


main()
