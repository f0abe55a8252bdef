#!/usr/bin/env python3
"""Pictures of a run of the moored platform: figures.py OUTPUT_FOLDER [--still]

Writes platform.png (water and air), motion.png (sway, heave, roll and the lines' tensions) and platform.gif (not with --still).
"""
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

from moored import Moored, theory  # puts scripts/ on the path
import phases

TIMES = (4.0, 6.0, 8.0, 10.0)  # s


class Still:
    """In place of the flume without the platform: the wave as theory has it."""
    incident, length = theory().piston, theory().length


def draw_motion(run, path):
    figure, axes = plt.subplots(4, 1, figsize=(8.0, 8.0), sharex=True, layout="constrained")
    for axis, (name, values) in zip(axes, (("sway [m]", run.x), ("heave [m]", run.y), ("roll [degrees]", np.degrees(run.angle)))):
        axis.plot(run.t, values)
        axis.set(ylabel=name)
    for name, values in run.line.items():
        axes[3].plot(run.line_t, values, label=name)
    axes[3].set(xlabel="t [s]", ylabel="tension [N/m]")
    axes[3].legend(frameon=False)
    figure.savefig(path, dpi=150)


def main():
    folder = sys.argv[1]
    draw_motion(Moored(folder, Still), os.path.join(folder, "motion.png"))
    phases.draw_times(folder, TIMES, "water", os.path.join(folder, "platform.png"), columns=1, size=(12.0, 1.8))
    if "--still" not in sys.argv:
        phases.animate(folder, "water", os.path.join(folder, "platform.gif"), size=(12.0, 1.8))


main()
