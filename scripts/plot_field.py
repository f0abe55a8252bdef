#!/usr/bin/env python3
"""A snapshot of a coupled run: vertical velocity, pressure without its hydrostatic part, and the mesh near the body.

Reads fluid.h5 and, if there, solid.h5 of OUTPUT_FOLDER; writes OUTPUT_FOLDER/field.png.  A domain more than three times as long
as wide is shown around the body and its wake.  Of several phases the pressure is drawn as it is,
with lines at interfaces.  Needs numpy, h5py and matplotlib.
"""
import argparse
import os

import numpy as np

from phases import find_phases
from snapshot import Window, centred, paint_bodies, paint_field, paint_mesh, panels, read_run, save, without_hydrostatic

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
    """A square about the bodies, what of it lies in the window; the window where there are none."""
    if body is None:
        return window
    box = Window.around(body.points)
    return Window(box.centre - box.size.max(), box.centre + box.size.max()).cut(window)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="output folder of the run")
    parser.add_argument("--time", type=float, help="the snapshot nearest to this time, s (default the last)")
    parser.add_argument("--weight", type=float, help="rho g, N/m3 (default: fitted along the side walls; none of several phases)")
    parser.add_argument("--whole", action="store_true", help="the whole domain, however long")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="what to show, m")
    parser.add_argument("--out", help="picture (default FOLDER/field.png)")
    return parser.parse_args()


def symmetric(window, grid, values, cells):
    """Limits of colours on both sides of 0, of these elements where there are any in the window."""
    limit = window.percentiles(grid, abs(values), 99.9, cells=cells)[0]
    limit = limit if limit > 1e-9 * max(abs(field).max() for field in grid.node.values()) else 1.0  # nothing but round-off
    return (-limit, limit), centred(-1.0, 1.0)


def pressure_of(window, grid, phases, weight):
    """Values, label, limits and colour map: as it is of several phases, which have no weight in common, unless one is given."""
    if phases and weight is None:
        p = grid.node["pressure"]
        return p, "p [Pa]", phases.limits(window, grid, p), "viridis"
    p, weight = without_hydrostatic(grid, weight)
    return p, f"p + {weight:.5g} y, mean 0 [Pa]", *symmetric(window, grid, p, None)


def choose(arguments, domain, body):
    """The window to show."""
    if arguments.window:
        return Window(arguments.window[:2], arguments.window[2:])
    return domain if arguments.whole else view(domain, body)


def draw(arguments):
    time, fluid, body = read_run(arguments.folder, arguments.time)
    phases = find_phases(fluid["velocity"])
    velocity, pressure = fluid["velocity"], fluid["pressure"]
    window = choose(arguments, Window.around(velocity.points), body)
    v = velocity.node["velocity"][:, 1]
    v = v, "vertical velocity [m/s]", *symmetric(window, velocity, v, phases.dense()[1] if phases else None)
    p = pressure_of(window, pressure, phases, arguments.weight)
    mesh_window = near(window, body)
    figure, made = panels(window, window, mesh_window, beside=window.size[0] <= 1.5 * window.size[1])
    for panel, grid, (values, label, limits, colour_map) in zip(made, (velocity, pressure), (v, p)):
        panel.colour_bar(paint_field(panel.axes, grid, values, window, limits, colour_map), label)
        if phases:
            phases.paint(panel.axes, pale=False)
        if body:
            paint_bodies(panel.axes, body, cover=bool(phases))
        window.frame(panel.axes)
    paint_mesh(made[2].axes, velocity, mesh_window, body, inside=True)
    made[2].bar.remove()
    for panel, title in zip(made, (f"t = {time:.4g} s", "", "mesh: fluid grey, solid red")):
        panel.axes.set(xlabel="x [m]", ylabel="y [m]", aspect="auto", title=title)
    return figure


def main():
    arguments = parse_arguments()
    save(draw, arguments, os.path.join(arguments.folder, "field.png"), "plot_field")


if __name__ == "__main__":
    main()
