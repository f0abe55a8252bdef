#!/usr/bin/env python3
"""A picture of any field of a run, fluid or solid, at any time; or an animation of all times.

Reads fluid.h5 and solid.h5 of the output folder RUN; without --field lists what there is and draws the speed of the fluid with the bodies'
outline.  A vector is drawn as its length, or one component with --field velocity.x; a stress likewise, with xx, yy and xy.

Of several phases the interfaces are drawn as lines, and --field phases draws where each phase is.  The colour bar of velocity and pressure then
has the range of the dense phases (at least 0.3 times as dense as the heaviest: water and oil, not air); the colours of lighter ones are paler.

A window more than eleven times as long as wide is stretched across.  Needs numpy, h5py and matplotlib.
"""
import argparse
import os

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter

from phases import COLOURS, find_phases
from snapshot import Window, colours, common_times, nearest, paint_bodies, paint_field, panels, read_snapshot, save

COMPONENTS = {3: {"x": 0, "y": 1}, 6: {"xx": 0, "yy": 3, "xy": 1}}  # by the number of a field's columns: those in the plane


def parse_arguments():
    parser = argparse.ArgumentParser(prog="view.sh", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", help="output folder")
    parser.add_argument("--field", help="e.g. velocity, velocity.y, pressure, phases, solid:stress.xx")
    moment = parser.add_mutually_exclusive_group()
    moment.add_argument("--time", type=float, help="the snapshot nearest to this time, s (default the last)")
    moment.add_argument("--animate", action="store_true", help="all snapshots as frames of a gif, with the same colours")
    parser.add_argument("--window", type=float, nargs=4, metavar=("X0", "Y0", "X1", "Y1"), help="what to show: two opposite corners, m")
    parser.add_argument("--range", type=float, nargs=2, metavar=("LOW", "HIGH"), help="values at the ends of the colour bar")
    parser.add_argument("--out", help="picture (default RUN/view.png, RUN/view.gif); its folder is made if missing")
    return parser.parse_args()


def find_files(run):
    """{"fluid": path, "solid": path} of what the run has."""
    paths = {part: os.path.join(run, part + ".h5") for part in ("fluid", "solid")}
    paths = {part: path for part, path in paths.items() if os.path.exists(path)}
    if not paths:
        raise LookupError(f"{run} has no fluid.h5 and no solid.h5")
    return paths


def read_grids(run, time):
    """Time and {"fluid velocity": Grid, ..., "solid": Grid} of what the run has."""
    grids, files = {}, find_files(run)
    found = nearest(common_times(*files.values()), time)
    for part, path in files.items():
        _, parts = read_snapshot(path, found)
        grids.update({part if part == name else f"{part} {name}": grid for name, grid in parts.items()})
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
    if component and values.ndim == 1:
        raise LookupError(f"{name} has no components")
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


class View:
    """What is drawn of a run at one time: a field, the bodies, the phases."""

    def __init__(self, run, wanted, time):
        self.time, grids = read_grids(run, time)
        self.body = grids.get("solid")
        self.found = fields(grids)
        self.phases = find_phases(grids["fluid velocity"]) if "fluid velocity" in grids else None
        if self.phases:
            self.found["fluid", "phases"] = self.phases.grid, self.phases.shades()
        self.grid, values, self.label = select(self.found, wanted or "velocity")
        self.values = at_nodes(self.grid, values)
        self.shows_phases = self.label == "fluid: phases"
        self.flows = self.phases is not None and self.label.startswith("fluid") and len(values) == len(self.grid.points)  # velocity or pressure

    def limits(self, window):
        """Of the colours, for the values in the window."""
        if self.shows_phases:
            return 0.0, 1.0
        if self.flows:
            return self.phases.limits(window, self.grid, self.values)
        return window.percentiles(self.grid, self.values, 0.5, 99.5)

    def paint(self, axes, window, limits):
        colour_map = COLOURS if self.shows_phases else colours(*limits)
        shade = paint_field(axes, self.grid, self.values, window, limits, colour_map)
        if self.phases:
            self.phases.paint(axes, self.flows)
        if self.body:
            paint_bodies(axes, self.body, cover=self.flows or self.shows_phases)
        window.frame(axes)
        axes.set(xlabel="x [m]", ylabel="y [m]", aspect="auto", title=f"t = {self.time:.4g} s")
        return shade

    def paint_bar(self, panel, shade):
        """The colour bar, with the names of phases or the field's."""
        if self.shows_phases:
            names = self.phases.names
            panel.colour_bar(shade, "", np.linspace(0.0, 1.0, len(names)), "neither").set_ticklabels(names)
            return
        dense = self.phases.dense()[0] if self.flows else []
        panel.colour_bar(shade, self.label + (f" (range of {', '.join(dense)})" if dense else ""))


def common(views, window, limits):
    """Window and limits for all of these views, where they are not given, and the last view."""
    corners, values = [], []
    for view in views:
        box = Window.around(view.grid.points)
        corners += [box.lower, box.upper]
        values.append(view.limits(window or Window.around(corners)))
    low, high = limits or (min(low for low, _ in values), max(high for _, high in values))
    return window or Window.around(corners), (low, high if high > low else low + 1.0), view


def start(arguments, views):
    """Figure, axes, window and limits for all of the views, and the last of them, which is drawn."""
    window = Window(arguments.window[:2], arguments.window[2:]) if arguments.window else None
    window, limits, view = common(views, window, arguments.range)
    figure, (panel,) = panels(window)
    view.paint_bar(panel, view.paint(panel.axes, window, limits))
    return figure, panel.axes, window, limits, view


def draw(arguments):
    figure, *_, view = start(arguments, [View(arguments.run, arguments.field, arguments.time)])
    if not arguments.field:
        print("fields:", ", ".join(f"{part}:{name}" for part, name in view.found))
    return figure


def animation(arguments):
    times = common_times(*find_files(arguments.run).values())
    view = lambda time: View(arguments.run, arguments.field, time)
    figure, axes, window, limits, _ = start(arguments, map(view, times))

    def frame(time):
        axes.clear()
        view(time).paint(axes, window, limits)

    return FuncAnimation(figure, frame, times, cache_frame_data=False)


def write_animation(animation, path):
    animation.save(path, PillowWriter(fps=12), dpi=90)


def main():
    arguments = parse_arguments()
    if arguments.animate:
        save(animation, arguments, os.path.join(arguments.run, "view.gif"), "view.sh", write_animation)
    else:
        save(draw, arguments, os.path.join(arguments.run, "view.png"), "view.sh")


main()
