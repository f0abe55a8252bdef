#!/usr/bin/env python3
"""A snapshot of a coupled run: vertical velocity, pressure without its hydrostatic part, and the mesh near the body.

Reads fluid.h5 and, if there, solid.h5 of OUTPUT_FOLDER; writes OUTPUT_FOLDER/field.png.  A domain more than three times as long
as wide is shown around the body and its wake.  Needs numpy, h5py and matplotlib.
"""
import argparse
import os

import matplotlib.pyplot as plt
import numpy as np

from snapshot import Window, centred, paint, paint_mesh, read_bodies, read_snapshot, save, without_hydrostatic

LENGTH, AHEAD = 1.8, 0.3  # of the window along a long domain: its length in widths, the part of it ahead of the body


def view(domain, body):
    """The domain; or, where that is long, its part around the bodies, more of it behind them than ahead."""
    along = int(np.argmax(domain.size))
    width, long = domain.size[1 - along], domain.size[along]
    if body is None or long < 3.0 * width or Window.around(body.points).size[along] > width:
        return domain
    behind = -1.0 if body.node["velocity"][:, along].mean() > 0.0 else 1.0
    middle = Window.around(body.points).centre[along] + behind * (0.5 - AHEAD) * LENGTH * width
    start = np.clip(middle - 0.5 * LENGTH * width, domain.lower[along], domain.upper[along] - LENGTH * width)
    lower, upper = domain.lower.copy(), domain.upper.copy()
    lower[along], upper[along] = start, start + LENGTH * width
    return Window(lower, upper)


def near(window, body):
    """A square about the bodies, or the window where there is none."""
    if body is None:
        return window
    box = Window.around(body.points)
    return Window(box.centre - box.size.max(), box.centre + box.size.max())


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="output folder of the run")
    parser.add_argument("--time", type=float, help="the snapshot nearest to this time, s (default the last)")
    parser.add_argument("--weight", type=float, help="rho g, N/m3 (default: fitted along the side walls)")
    parser.add_argument("--whole", action="store_true", help="the whole domain, however long")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="what to show, m")
    parser.add_argument("--out", help="picture (default FOLDER/field.png)")
    return parser.parse_args()


def panels(window):
    """Figure and axes of two fields in this window and the mesh: side by side, or one above the other where it is wide."""
    if window.size[0] > 1.5 * window.size[1]:
        return plt.subplots(3, 1, figsize=(9, 13), layout="constrained")
    width = 7.0 * window.size[0] / window.size[1]
    return plt.subplots(1, 3, figsize=(2.0 * width + 8.5, 8.0), width_ratios=[width + 0.6, width + 0.6, 6.2], layout="constrained")


def draw(arguments):
    time, fluid = read_snapshot(os.path.join(arguments.folder, "fluid.h5"), arguments.time)
    body = read_bodies(arguments.folder, time)
    velocity, pressure = fluid["velocity"], fluid["pressure"]
    domain = Window.around(velocity.points)
    window = domain if arguments.whole else view(domain, body)
    if arguments.window:
        window = Window(arguments.window[:2], arguments.window[2:])
    figure, axes = panels(window)
    v = velocity.node["velocity"][:, 1]
    p, weight = without_hydrostatic(pressure, arguments.weight)
    for axis, grid, values, label in ((axes[0], velocity, v, "vertical velocity [m/s]"),
                                      (axes[1], pressure, p, f"p + {weight:.5g} y, mean 0 [Pa]")):
        limit = window.percentiles(grid, abs(values), 99.9)[0]
        if limit < 1e-9 * max(abs(field).max() for field in grid.node.values()) or limit == 0.0:
            limit = 1.0  # nothing but round-off
        paint(axis, grid, values, window, (-limit, limit), centred(-1.0, 1.0), label, body)
    paint_mesh(axes[2], velocity, near(window, body), body, inside=True)
    axes[2].set_title("mesh: fluid grey, solid red")
    for axis in axes:
        axis.set(xlabel="x [m]", ylabel="y [m]")
    figure.suptitle(f"t = {time:.4g} s")
    return figure


def main():
    arguments = parse_arguments()
    save(draw, arguments, os.path.join(arguments.folder, "field.png"), "plot_field")


if __name__ == "__main__":
    main()
