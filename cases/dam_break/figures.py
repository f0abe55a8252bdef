#!/usr/bin/env python3
"""Pictures of a run of the dam break: figures.py OUTPUT_FOLDER [--still]

Writes front.png (the front beside Martin and Moyce and potential flow), dam_break.png (water at eight times) and dam_break.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt

from front import Comparison, experiment, front, potential  # puts scripts/ on the path
import phases

TIMES = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5)  # s


def main():
    folder = sys.argv[1]
    t, z = front(folder)
    figure, axes = plt.subplots(figsize=(6.5, 4.5), layout="constrained")
    axes.plot(t, z, label="computed")
    if t[-1] > 5.0:  # else there is too little to compare
        shift = Comparison(folder).shift
        axes.plot(t + shift, z, "--", label="later by %.2f" % shift)
    axes.plot(*potential(), "k:", label="potential flow")
    axes.plot(*experiment(), "ko", markersize=4, label="Martin and Moyce 1952")
    axes.set(xlabel="T = t sqrt(2 g/a)", ylabel="Z = x/a", xlim=(0.0, 10.0), ylim=(1.0, 15.0))
    axes.legend(frameon=False)
    figure.savefig(os.path.join(folder, "front.png"), dpi=150)
    phases.draw_times(folder, TIMES, "water", os.path.join(folder, "dam_break.png"), size=(6.5, 1.6))
    if "--still" not in sys.argv:
        phases.animate(folder, "water", os.path.join(folder, "dam_break.gif"), size=(9.0, 2.2))


main()
