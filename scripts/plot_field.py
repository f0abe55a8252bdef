#!/usr/bin/env python3
"""A snapshot of a coupled run: vertical velocity, pressure without its hydrostatic part, and the mesh near the body.

Reads fluid.h5 and, if there, solid.h5 of OUTPUT_FOLDER; writes OUTPUT_FOLDER/field.png.
Needs numpy, h5py and matplotlib.
"""
import argparse
import os
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation

# A six-node triangle (midpoints of 01, 12, 20 are 3, 4, 5) as four straight ones.
QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


class Grid:
    """A grid of one snapshot: points [n, 2], cells [ne, k], fields by name."""

    def __init__(self, group):
        self.points = group["points"][()]
        self.cells = group["cells"][()]
        self.node = {name: values[()] for name, values in group["node"].items()}
        self.cell = {name: values[()] for name, values in group["cell"].items()}

    def triangulation(self):
        cells = self.cells
        if cells.shape[1] == 6:
            cells = cells[:, QUARTERS].reshape(-1, 3)
        return Triangulation(*self.points.T, cells)


def read_snapshot(path, time):
    """Time and grids of the snapshot nearest to `time`; of the last one where time is None."""
    with h5py.File(path, "r") as file:
        snapshots = [file["snapshot"][name] for name in sorted(file["snapshot"])]
        snapshots = [s for s in snapshots if len(s)]
        if not snapshots:
            sys.exit(f"plot_field: {path} has no snapshot yet")
        times = np.array([s.attrs["time"] for s in snapshots])
        k = len(times) - 1 if time is None else int(np.argmin(abs(times - time)))
        return times[k], {name: Grid(group) for name, group in snapshots[k].items()}


def outline(grid):
    """The edges of one triangle only, as a line broken by nan."""
    edges = np.sort(np.concatenate([grid.cells[:, [0, 1]], grid.cells[:, [1, 2]], grid.cells[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    ends = grid.points[edges[count == 1]]
    return np.concatenate([ends, np.full((len(ends), 1, 2), np.nan)], axis=1).reshape(-1, 2)


def without_hydrostatic(grid, weight):
    """p + weight y less its mean; the weight rho g, N/m3, comes from a fit along the side walls if it is not given."""
    x, y = grid.points.T
    p = grid.node["pressure"]
    if weight is None:
        margin = 0.05 * np.ptp(x)
        wall = (x < x.min() + margin) | (x > x.max() - margin)
        weight = -np.polyfit(y[wall], p[wall], 1)[0]
    p = p + weight * y
    return p - p.mean(), weight


def colours(axes, triangulation, values, label, body, divergent):
    """Gouraud shading over the whole domain with a colour bar and the body's outline."""
    if divergent:
        limit = np.percentile(abs(values), 99.9) or 1.0
        shade = axes.tripcolor(triangulation, values, shading="gouraud", cmap="RdBu_r", vmin=-limit, vmax=limit)
    else:
        shade = axes.tripcolor(triangulation, values, shading="gouraud", cmap="viridis",
                               vmin=np.percentile(values, 0.1), vmax=np.percentile(values, 99.9))
    axes.figure.colorbar(shade, ax=axes, label=label, shrink=0.8)
    if body is not None:
        axes.plot(*body.T, "k", linewidth=0.8)
    axes.margins(0.0)
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")


def mesh_near(axes, triangulation, body):
    """The fluid's triangles around the body, or all of them where there is none."""
    if body is not None:
        lower, upper = np.nanmin(body, axis=0), np.nanmax(body, axis=0)
        centre, half = 0.5 * (lower + upper), 0.9 * (upper - lower).max()
        axes.set(xlim=centre[0] + np.array([-half, half]), ylim=centre[1] + np.array([-half, half]))
        corners = np.stack([triangulation.x, triangulation.y], axis=1)[triangulation.triangles]
        near = (abs(corners - centre) < 1.5 * half).all(axis=(1, 2))
        triangulation = Triangulation(triangulation.x, triangulation.y, triangulation.triangles[near])
    axes.triplot(triangulation, color="0.6", linewidth=0.4)
    if body is not None:
        axes.plot(*body.T, "C3", linewidth=1.2)
    axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="mesh")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="output folder of the run")
    parser.add_argument("--time", type=float, help="the snapshot nearest to this time, s (default the last)")
    parser.add_argument("--weight", type=float, help="rho g, N/m3 (default: fitted along the side walls)")
    parser.add_argument("--out", help="picture (default FOLDER/field.png)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    time, fluid = read_snapshot(os.path.join(arguments.folder, "fluid.h5"), arguments.time)
    solid, body = os.path.join(arguments.folder, "solid.h5"), None
    if os.path.exists(solid):
        time_solid, grids = read_snapshot(solid, time)
        if abs(time_solid - time) > 1e-6 * max(1.0, abs(time)):
            print(f"plot_field: the solid is of t = {time_solid:g} s, the fluid of {time:g} s", file=sys.stderr)
        body = outline(grids["solid"])
    velocity, pressure = fluid["velocity"], fluid["pressure"]
    figure, axes = plt.subplots(1, 3, figsize=(13, 6.5), width_ratios=[1, 1, 1.3], layout="constrained")
    colours(axes[0], velocity.triangulation(), velocity.node["velocity"][:, 1], "vertical velocity [m/s]", body, True)
    p, weight = without_hydrostatic(pressure, arguments.weight)
    colours(axes[1], pressure.triangulation(), p, f"p + {weight:.5g} y [Pa]", body, False)
    mesh_near(axes[2], velocity.triangulation(), body)
    figure.suptitle(f"t = {time:.4g} s")
    path = arguments.out or os.path.join(arguments.folder, "field.png")
    figure.savefig(path, dpi=150)
    print(path)


if __name__ == "__main__":
    main()
