#!/usr/bin/env python3
"""Pictures of a run of the rising bubble: figures.py OUTPUT_FOLDER [--still]

Writes bubble.png (circularity, centre and rise velocity beside the references of test 1), rising_bubble.png (the gas at six times) and
rising_bubble.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt

from bubble import Bubble, reference  # puts scripts/ on the path
import phases

TIMES = (0.0, 0.6, 1.2, 1.8, 2.4, 3.0)  # s
NAMES = ("circularity", "centre, m", "rise velocity, m/s")


def main():
    folder = sys.argv[1]
    bubble = Bubble(folder)
    figure, axes = plt.subplots(1, 3, figsize=(11.0, 3.4), layout="constrained")
    for k, (axis, mine, name) in enumerate(zip(axes, (bubble.circularity, bubble.y, bubble.speed), NAMES)):
        axis.plot(bubble.t, mine, label="computed")
        for code, style, label in (("moonmd", "k--", "MooNMD, test 1"), ("freelife", "k:", "FreeLIFE, test 1")):
            values = reference(code)
            axis.plot(values[0], values[1 + k], style, linewidth=1.0, label=label)
        axis.set(xlabel="t, s", ylabel=name, xlim=(0.0, 3.0))
    axes[0].legend(frameon=False)
    figure.savefig(os.path.join(folder, "bubble.png"), dpi=150)
    phases.draw_times(folder, TIMES, "gas", os.path.join(folder, "rising_bubble.png"), columns=6, size=(1.8, 3.5))
    if "--still" not in sys.argv:
        phases.animate(folder, "gas", os.path.join(folder, "rising_bubble.gif"), size=(3.0, 5.6))


main()
