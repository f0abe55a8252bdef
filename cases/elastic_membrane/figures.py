#!/usr/bin/env python3
"""Counterparts of the paper's Figs. 9 to 12, and the membrane's shape in time.

    cases/elastic_membrane/figures.py FOLDER [--rows DIR]

FOLDER: the output of a run.  Writes there figure9.png (the fluid's mesh), figure10.png (speed), figure11.png (pressure), each at 0.19, 0.80 and
1.47 s or what there is of them, and shape.png (half axes and area).  With --rows, the folder of validate.py's runs, also figure12.png
(pressure along y = 0 of the rows y1, y2, y3) and line.png (the line membrane against the interface-fitted reference).
Needs numpy, h5py and matplotlib.
"""
import argparse
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import membrane  # puts scripts/ on the path
from snapshot import Window, centred, paint, paint_mesh, read_run

TIMES = (0.19, 0.80, 1.47)  # s, the paper's
ROWS = (("y1", "dr 0.0005 m", "C0", "-"), ("y2", "dr 0.001 m", "C1", "--"), ("y3", "dr 0.002 m", "C2", ":"))


def snapshots(folder):
    """Time, fluid and body at the paper's times that the run has reached."""
    for t in TIMES:
        time, fluid, body = read_run(folder, t)
        if abs(time - t) < 0.03:
            yield time, fluid, body


def panels(times, draw):
    """One panel a time, side by side."""
    figure, axes = plt.subplots(1, len(times), figsize=(5.2 * len(times), 5.6), layout="constrained", squeeze=False)
    for axis, (time, fluid, body) in zip(axes[0], times):
        draw(axis, fluid, body)
        axis.set(xlabel="x [m]", ylabel="y [m]", title="t = %.2f s" % time)
    return figure


def draw_mesh(axis, fluid, body):
    paint_mesh(axis, fluid["velocity"], Window.around(fluid["velocity"].points), body, linewidth=0.25)


def draw_speed(axis, fluid, body):
    grid = fluid["velocity"]
    speed = np.hypot(*grid.node["velocity"][:, :2].T)
    paint(axis, grid, speed, Window.around(grid.points), (0.0, max(speed.max(), 1e-9)), "viridis", "speed [m/s]", body)


def draw_pressure(axis, fluid, body):
    grid = fluid["pressure"]
    p = grid.node["pressure"]
    paint(axis, grid, p, Window.around(grid.points), (p.min(), p.max()), centred(min(p.min(), -1e-9), max(p.max(), 1e-9), even=False),
          "pressure [Pa]", body)


def close_up(folder, times):
    """The mesh at the membrane's right end, its own triangles in red."""
    time, fluid, body = times[0]
    figure, axis = plt.subplots(figsize=(6.0, 6.0), layout="constrained")
    right = body.points[np.argmax(body.points[:, 0])]
    paint_mesh(axis, fluid["velocity"], Window(right - 0.06, right + 0.06), body, inside=True)
    axis.set(xlabel="x [m]", ylabel="y [m]", title="t = %.2f s: fluid grey, membrane red" % time)
    figure.savefig(folder / "mesh_near.png", dpi=150)


def draw_shape(folder):
    shape = membrane.history(folder)
    figure, (axes, area) = plt.subplots(2, 1, figsize=(8.0, 7.0), height_ratios=(3, 1), sharex=True, layout="constrained")
    axes.plot(shape["t"], shape["rx"], label="half axis in x")
    axes.plot(shape["t"], shape["ry"], label="half axis in y")
    axes.axhline(membrane.EQUILIBRIUM, color="0.5", linewidth=0.8, label="radius of the circle with the starting area")
    axes.set(ylabel="[m]")
    axes.legend(frameon=False)
    area.plot(shape["t"], 100.0 * (shape["area"] / shape["area"][0] - 1.0), "k")
    area.set(xlabel="t [s]", ylabel="change of area [%]")
    figure.savefig(folder / "shape.png", dpi=150)


def draw_profiles(rows, folder):
    """Fig. 12."""
    figure, axes = plt.subplots(1, len(TIMES), figsize=(15.0, 4.6), sharey=True, layout="constrained")
    for axis, t in zip(axes, TIMES):
        for name, label, colour, style in ROWS:
            if (rows / name / "summary.json").exists():
                axis.plot(*membrane.profile(rows / name, t), color=colour, linestyle=style, label=label)
        axis.set(xlabel="x [m]", title="t = %.2f s" % t, xlim=(-1.5, 1.5))
    axes[0].set(ylabel="pressure along y = 0 [Pa]")
    axes[0].legend(frameon=False)
    figure.savefig(folder / "figure12.png", dpi=150)


def draw_line(rows, folder):
    reference = membrane.reference()
    figure, axis = plt.subplots(figsize=(8.0, 5.0), layout="constrained")
    for key, colour in (("rx", "C0"), ("ry", "C1")):
        axis.plot(reference["t"], reference[key], "o", color=colour, markersize=3, markevery=4, fillstyle="none",
                  label="half axis in %s, interface-fitted" % key[1])
        shape = membrane.history(rows / "line")
        axis.plot(shape["t"], shape[key], color=colour, label="half axis in %s" % key[1])
    axis.set(xlabel="t [s]", ylabel="[m]", title="massless line membrane, 10 N/m (stretch - 1)", xlim=(0.0, 2.0))
    axis.legend(frameon=False)
    figure.savefig(folder / "line.png", dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rows", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.folder
    times = list(snapshots(folder))
    for name, draw in (("figure9", draw_mesh), ("figure10", draw_speed), ("figure11", draw_pressure)):
        if times:
            panels(times, draw).savefig(folder / (name + ".png"), dpi=150)
    if times:
        close_up(folder, times)
    draw_shape(folder)
    if arguments.rows and (arguments.rows / "y1" / "summary.json").exists():
        draw_profiles(arguments.rows, folder)
    if arguments.rows and (arguments.rows / "line" / "summary.json").exists():
        draw_line(arguments.rows, folder)
    print("figures in %s" % folder)


if __name__ == "__main__":
    main()
