#!/usr/bin/env python3
"""A picture of any field of a run: fluid or solid, at any time.

Reads fluid.h5 and solid.h5 of the output folder RUN; without --field lists what there is and draws the speed of the fluid with the bodies'
outline.  A vector is drawn as its length, or one component with --field velocity.x; a stress likewise, with xx, yy and xy.  Needs numpy, h5py and matplotlib.
"""
import argparse
import os

import matplotlib.pyplot as plt
import numpy as np

from snapshot import Window, colours, paint, read_snapshot, save

COMPONENTS = {3: {"x": 0, "y": 1}, 6: {"xx": 0, "yy": 3, "xy": 1}}  # by the number of a field's columns: those in the plane


def parse_arguments():
    parser = argparse.ArgumentParser(prog="view.sh", description=__doc__)
    parser.add_argument("run", help="output folder")
    parser.add_argument("--field", help="e.g. velocity, velocity.y, pressure, solid:stress.xx")
    parser.add_argument("--time", type=float, help="the snapshot nearest to this time, s (default the last)")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="what to show: two opposite corners, m")
    parser.add_argument("--out", help="picture (default RUN/view.png); its folder is made if missing")
    return parser.parse_args()


def read_grids(run, time):
    """Time and {"fluid velocity": Grid, ..., "solid": Grid} of what the run has."""
    grids, found = {}, time
    for part in ("fluid", "solid"):
        path = os.path.join(run, part + ".h5")
        if os.path.exists(path):
            found, parts = read_snapshot(path, found)
            grids.update({part if part == name else f"{part} {name}": grid for name, grid in parts.items()})
    if not grids:
        raise LookupError(f"{run} has no fluid.h5 and no solid.h5")
    return found, grids


def fields(grids):
    """{(part, field name): (grid, values at its nodes or cells)}"""
    found = {}
    for name, grid in grids.items():
        for place in (grid.node, grid.cell):
            for field, values in place.items():
                found.setdefault((name.split()[0], field), (grid, values))
    return found


def select(found, wanted):
    """Grid, values [n] and a label of what --field means."""
    part, _, name = wanted.rpartition(":")
    name, _, component = name.partition(".")
    keys = [key for key in found if key[1] == name and (not part or key[0] == part)]
    if not keys:
        there = ", ".join(f"{p}:{n}" for p, n in found)
        raise LookupError(f"there is no field '{wanted}': {there}")
    grid, values = found[keys[0]]
    if not len(values):
        raise LookupError(f"there is nothing to draw of '{wanted}': the run has no bodies")
    if values.ndim == 1:
        return grid, values, f"{keys[0][0]}: {name}"
    if component:
        columns = COMPONENTS[values.shape[1]]
        if component not in columns:
            raise LookupError(f"{name} has the components {', '.join(columns)}")
        return grid, values[:, columns[component]], f"{keys[0][0]}: {name}, {component}"
    return grid, np.linalg.norm(values, axis=1), f"{keys[0][0]}: |{name}|"


def at_nodes(grid, values):
    """Values of cells as the mean over the cells around a node."""
    if len(values) == len(grid.points):
        return values
    corners = grid.cells.shape[1]
    total = np.bincount(grid.cells.ravel(), np.repeat(values, corners), len(grid.points))
    return total / np.maximum(1, np.bincount(grid.cells.ravel(), minlength=len(grid.points)))


def draw(arguments):
    time, grids = read_grids(arguments.run, arguments.time)
    found = fields(grids)
    if not arguments.field:
        print("fields:", ", ".join(f"{part}:{name}" for part, name in found))
    grid, values, label = select(found, arguments.field or "velocity")
    values = at_nodes(grid, values)
    window = Window(arguments.window[:2], arguments.window[2:]) if arguments.window else Window.around(grid.points)
    low, high = window.percentiles(grid, values, 0.5, 99.5)
    high = high if high > low else low + 1.0
    width = 8.0 * np.sqrt(window.size[0] / window.size[1])
    figure, axes = plt.subplots(figsize=(width, 1.0 + width * window.size[1] / window.size[0]), layout="constrained")
    paint(axes, grid, values, window, (low, high), colours(low, high), label, grids.get("solid"))
    axes.set(xlabel="x [m]", ylabel="y [m]", title=f"t = {time:.4g} s")
    return figure


def main():
    arguments = parse_arguments()
    save(draw, arguments, os.path.join(arguments.run, "view.png"), "view.sh")


main()
