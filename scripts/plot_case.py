#!/usr/bin/env python3
"""The meshes of a case before its run.  Usage: plot_case.py FOLDER PICTURE, where FOLDER has fluid.h5 and solid.h5 as --draw writes them, or one of
them.

Left the whole domain, of several phases coloured by phase, right the bodies.
"""
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

from phases import COLOURS, find_phases
from snapshot import Window, paint_mesh, read_snapshot


def read_grid(folder, part, name):
    """None where the case has no such part."""
    path = os.path.join(folder, part + ".h5")
    grid = read_snapshot(path)[1][name] if os.path.exists(path) else None
    return grid if grid is not None and len(grid.cells) else None


def around_bodies(solid, domain):
    """The bodies and what is near them."""
    bodies = Window.around(solid.points)
    margin = 0.25 * bodies.size.max()
    lower, upper = bodies.lower - margin, bodies.upper + margin
    return Window(lower, upper) if domain is None else Window(np.maximum(lower, domain.lower), np.minimum(upper, domain.upper))


def paint_phases(axes, phases):
    """The elements' phases, of the colours of view.sh --field phases, and their names."""
    grid, names = phases.grid, phases.names
    shade = axes.tripcolor(*grid.points.T, grid.cells, facecolors=phases.shades(), cmap=COLOURS, vmin=0.0, vmax=1.0)
    bar = axes.figure.colorbar(shade, ax=axes, location="bottom", shrink=0.5, ticks=np.linspace(0.0, 1.0, len(names)))
    bar.set_ticklabels(names)


def paint_domain(axes, fluid, domain, solid):
    phases = find_phases(fluid)
    if phases:
        paint_phases(axes, phases)
    paint_mesh(axes, fluid, domain, solid)


def main(folder, picture):
    fluid, solid = read_grid(folder, "fluid", "velocity"), read_grid(folder, "solid", "solid")
    domain, panels = Window.around(fluid.points) if fluid else None, []  # of a panel: what is painted, its title
    if fluid:
        panels.append((lambda axes: paint_domain(axes, fluid, domain, solid), "fluid: %d triangles" % len(fluid.cells)))
    if solid:
        panels.append((lambda axes: paint_mesh(axes, fluid, around_bodies(solid, domain), solid, inside=True), "bodies: %d triangles" % len(solid.cells)))
    if not panels:
        sys.exit("the case has neither a fluid nor bodies to draw")
    figure, axes = plt.subplots(1, len(panels), figsize=(6 * len(panels), 6), layout="constrained", squeeze=False)
    for axis, (draw, title) in zip(axes[0], panels):
        draw(axis)
        axis.set(title=title, xlabel="x, m", ylabel="y, m")
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
