#!/usr/bin/env python3
"""Pictures of a run of the breaking block: figures.py OUTPUT_FOLDER [--still]

Writes breaking.png (vorticity, fragments and cracks at six times), budget.png (momentum and energy of the solids) and breaking.gif
(all snapshots; not with --still).  An element has the colour of the fragment to which it belongs in the end, the same at all times.
Needs numpy, h5py, matplotlib and Pillow.
"""
import argparse
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.colors import ListedColormap
from matplotlib.tri import Triangulation

from budget import Budget
from snapshot import Window, outline, read_snapshot, read_times, vorticity

STRONGEST = 40.0  # 1/s, end of the colour scale of the vorticity
SERIES = (0.4, 0.7, 0.76, 0.86, 1.1, 1.4, 1.8, 2.2)  # s
SMALL = 2  # triangles: fragments of no more are all of one colour
COLOURS = [plt.colormaps["Set2"](k) for k in range(7)] + [plt.colormaps["Set3"](k) for k in (0, 2, 3, 4, 5, 6, 9, 11)]
SAND, STEEL = (0.80, 0.72, 0.55, 1.0), (0.35, 0.35, 0.38, 1.0)


def element_colours(folder, end):
    """A colour for each element: of its fragment in the end, the largest ones first; the projectile's its own."""
    _, grids = read_snapshot(os.path.join(folder, "solid.h5"), end)
    solid = grids["solid"]
    fragment, body = (solid.cell[name].ravel().astype(int) for name in ("fragment", "body"))
    colours = np.tile(np.array(SAND), (len(fragment), 1))
    count = np.bincount(fragment)
    for k, f in enumerate(np.argsort(-count, kind="stable")):
        if count[f] > SMALL:
            colours[fragment == f] = COLOURS[k % len(COLOURS)]
    colours[body == 1] = STEEL
    return colours


def draw(axes, folder, time, colours):
    """One instant; returns the vorticity's shading."""
    found, fluid = read_snapshot(os.path.join(folder, "fluid.h5"), time)
    solid = read_snapshot(os.path.join(folder, "solid.h5"), time)[1]["solid"]
    triangulation, values = vorticity(fluid["velocity"])
    shade = axes.tripcolor(triangulation, values, shading="gouraud", cmap="RdBu_r", vmin=-STRONGEST, vmax=STRONGEST)
    axes.tripcolor(Triangulation(*solid.points[:, :2].T, solid.cells), np.arange(len(solid.cells), dtype=float),
                   cmap=ListedColormap(colours), vmin=-0.5, vmax=len(colours) - 0.5)
    solid.points = solid.points[:, :2]
    axes.plot(*outline(solid).T, "k", linewidth=0.6)
    Window.around(triangulation_points(triangulation)).frame(axes)
    pieces = len(np.unique(solid.cell["fragment"]))
    axes.set_title(f"t = {found:.2f} s, {pieces} pieces", fontsize=10)
    return shade


def triangulation_points(triangulation):
    return np.column_stack([triangulation.x, triangulation.y])


def draw_series(folder, colours):
    figure, axes = plt.subplots(4, 2, figsize=(13, 8.2), sharex=True, sharey=True, layout="constrained")
    for axis, time in zip(axes.flat, SERIES):
        shade = draw(axis, folder, time, colours)
    for axis in axes[:, 0]:
        axis.set_ylabel("y [m]")
    for axis in axes[-1]:
        axis.set_xlabel("x [m]")
    figure.colorbar(shade, ax=axes, label="vorticity [1/s]", location="right", fraction=0.02, pad=0.01, extend="both")
    return figure


def draw_budget(folder):
    b = Budget(folder)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(14, 4.2), layout="constrained")
    left.plot(b.t, b.momentum[0] - b.momentum[0][0], "k", linewidth=2, label="change of the solids' momentum")
    for given, label in ((b.fluid[0], "impulse of the fluid"), (b.reaction[0], "of foot and thrower"), (b.walls[0], "of the walls")):
        left.plot(b.t, given, label=label)
    left.plot(b.t, b.fluid[0] + b.reaction[0] + b.walls[0], "--", color="0.7", linewidth=1, label="sum of the impulses")
    left.set(ylabel="along the channel [N s/m]")
    middle.plot(b.t, b.kinetic, label="kinetic")
    middle.plot(b.t, -b.work, label="given to the fluid")
    middle.plot(b.t, -b.excess, label="to damping, friction, contact")
    middle.plot(b.t, b.fracture, label="fracture")
    middle.set(ylabel="energy [J/m]")
    right.plot(b.t, b.pieces, label=f"pieces, {b.pieces[-1]:.0f} in the end")
    right.plot(b.t, b.broken, label=f"broken joints, {b.broken[-1]:.0f} in the end")
    first = min(b.first_crack(), b.t[-1])
    for axis, span, place in ((left, (0.0, b.t[-1]), (1.0, 0.31)), (middle, (0.0, b.t[-1]), (1.0, 0.5)),
                              (right, (max(first - 0.01, 0.0), first + 0.05), (1.0, 0.5))):
        axis.set(xlabel="t [s]", xlim=span)
        axis.legend(frameon=False, fontsize=9, loc="center right", bbox_to_anchor=place)
    return figure


def animate(folder, times, colours, path):
    figure, axes = plt.subplots(figsize=(9.6, 3.0), layout="constrained")
    shade = draw(axes, folder, times[0], colours)
    figure.colorbar(shade, ax=axes, label="vorticity [1/s]", fraction=0.02, pad=0.01, extend="both")
    writer = PillowWriter(fps=12)
    with writer.saving(figure, path, dpi=90):
        for time in times:
            axes.clear()
            draw(axes, folder, time, colours)
            axes.set(xlabel="x [m]", ylabel="y [m]")
            writer.grab_frame()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="output folder of the run")
    parser.add_argument("--still", action="store_true", help="no animation")
    arguments = parser.parse_args()
    folder = arguments.folder
    times = read_times(os.path.join(folder, "solid.h5"))
    colours = element_colours(folder, times[-1])
    for figure, name in ((draw_series(folder, colours), "breaking.png"), (draw_budget(folder), "budget.png")):
        path = os.path.join(folder, name)
        figure.savefig(path, dpi=120)
        print(path)
    if not arguments.still:
        path = os.path.join(folder, "breaking.gif")
        animate(folder, times, colours, path)
        print(path)


if __name__ == "__main__":
    main()
