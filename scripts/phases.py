"""Runs of several phases: their probes (fluid_probes.csv, solid_probes.csv), tables of them, and pictures and animations of where
they are.

Needs numpy, h5py, matplotlib; Pillow for animations.
"""
import json
import os

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import PillowWriter
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation

from series import read_series
from snapshot import Window, common_times, outline, read_run, run_files, vertices

AIR, WATER = (0.93, 0.96, 0.98), (0.10, 0.35, 0.65)
INTERFACE = "C3"
DENSE = 0.3  # of the heaviest phase's density, what a dense phase has at least: liquids, not gases
COLOURS = LinearSegmentedColormap.from_list("air to water", [AIR, WATER])


def read_probes(folder):
    """The columns of fluid_probes.csv and, if there, of solid_probes.csv, under their own `t` and `solid t`."""
    probes = read_series(os.path.join(folder, "fluid_probes.csv"))
    path = os.path.join(folder, "solid_probes.csv")
    if os.path.exists(path):
        solid = read_series(path)
        probes.update({"solid t" if name == "t" else name: values for name, values in solid.items()})
    return probes


def crossing(t, values, level):
    """When the values first reach the level from below, linear between rows, nan if they do not; values may be nan, as of a gauge that is dry."""
    k = int(np.argmax(values >= level))
    if not values[k] >= level:
        return float("nan")
    if k == 0 or np.isnan(values[k - 1]):
        return float(t[k])
    return float(t[k - 1] + (level - values[k - 1]) / (values[k] - values[k - 1]) * (t[k] - t[k - 1]))


def snapshot_times(folder):
    """Of the snapshots that have the bodies, too, where there are any."""
    return common_times(*run_files(folder))


def find_phases(grid):
    """Phases of this grid; None where there is one fluid."""
    return Phases(grid) if "density" in grid.cell else None


class Phases:
    """The phases of a grid of the fluid's elements, the lightest first: names, fractions [n, elements]."""

    def __init__(self, grid):
        names = [name for name in grid.cell if name not in ("alpha", "density", "rank")]
        fractions = np.array([grid.cell[name].ravel() for name in names])
        densities = np.linalg.lstsq(fractions.T, grid.cell["density"].ravel(), rcond=None)[0]
        order = np.argsort(densities)
        self.grid, self.names, self.fractions = grid, [names[k] for k in order], fractions[order]
        self.lightest_dense = int(np.argmax(densities[order] >= DENSE * densities.max()))
        self.solid = grid.cell["alpha"].ravel()

    def heavier(self, k):
        """Of the fluid in each element, what is of phase k > 0 or of heavier ones; inside bodies the fluid is of the lightest."""
        return np.minimum(1.0, self.fractions[k:].sum(axis=0) / np.maximum(1e-3, 1.0 - self.solid))

    def shades(self):
        """Of each element: 0 of the lightest phase, 1 of the heaviest, others evenly between."""
        return sum(self.heavier(k) for k in range(1, len(self.names))) / max(1, len(self.names) - 1)

    def dense(self):
        """Names of the dense phases, and elements that are mostly of them and outside of bodies; all where they are of like densities."""
        k = self.lightest_dense
        return self.names[k:], (self.fractions[k:].sum(axis=0) > 0.5) & (self.solid < 0.5)

    def limits(self, window, grid, values):
        """Of colours of a velocity or pressure: percentiles in the dense phases, from or to 0 where hardly any values have the other sign."""
        low, high = window.percentiles(grid, values, 0.5, 99.5, cells=self.dense()[1])
        return (0.0 if -0.05 * high < low < 0.0 else low), (0.0 if 0.0 < high < -0.05 * low else high)

    def paint(self, axes, pale):
        """The interfaces: lines where half of the fluid around a vertex is of heavier phases; `pale`: what is not of the dense phases is paler."""
        points, triangles = vertices(self.grid)
        a, b, c = points[triangles].transpose(1, 0, 2)
        fluid = abs(np.cross(b - a, c - a)) * np.maximum(1e-3, 1.0 - self.solid)
        around = lambda values: np.bincount(triangles.ravel(), np.repeat(values, 3))
        triangulation = Triangulation(*points.T, triangles, mask=self.solid > 0.9)
        for k in range(1, len(self.names)):
            mean = around(fluid * self.heavier(k)) / around(fluid)
            if mean.min() < 0.5 < mean.max():
                if pale and k == self.lightest_dense:
                    axes.tricontourf(triangulation, mean, levels=[-1.0, 0.5], colors="w", alpha=0.6)
                axes.tricontour(triangulation, mean, levels=[0.5], colors=INTERFACE, linewidths=1.2)


COLUMNS = ("water out", "water made", "imbalance", "iterations", "triangles", "steps", "cost")  # of Run.cells


class Run:
    """What any run of several phases has left behind: what became of the water, elements, steps, and what they took; passes: coupling
    iterations of a step, the mean; later_passes: the most after the first step, which is repeated until a body's forces are known."""

    def __init__(self, folder):
        with open(os.path.join(folder, "summary.json")) as file:
            self.summary = json.load(file)
        series = read_series(os.path.join(folder, "fluid.csv"))
        triangles = series["triangles"]
        start = series["water"][0] + series["water out"][0] - series["water made"][0]
        self.out = series["water out"][-1] / start  # through boundaries, of the water at the start
        self.made = abs(series["water made"]).max() / start  # what is neither there nor gone out, or too much
        self.triangles, self.steps = int(triangles.max()), len(triangles)
        parts = self.summary["participants"].values()
        self.cpu = sum(p["seconds_cpu"] for p in parts)
        self.cpu_triangle = self.cpu / float(triangles.sum())  # of a triangle in a step
        self.passes = self.summary.get("iterations", self.steps) / self.summary["steps"]
        self.later_passes = read_series(os.path.join(folder, "coupler.csv"))["iterations"][1:].max()

    def cells(self, first):
        """Of a table's row: COLUMNS; water out and made: of that at the start; cost: processor time over that of the run `first`."""
        return ["%.0e" % self.out, "%.0e" % self.made, "%.0e" % self.summary["largest_momentum_imbalance"], "%.2f" % self.passes,
                str(self.triangles), str(self.steps), "%.2g" % (self.cpu / first.cpu)]


def results(out, names, result):
    """{name: result(folder)}, each with its Run as `run`, of the runs of these names that have come to their end: folders of `out`."""
    there = {name: result(out / name) for name in names if (out / name / "summary.json").exists()}
    for name, r in there.items():
        r.run = Run(out / name)
    return there


def claims(name, r):
    """What must hold of any run of results(): (statement, measured, bound)."""
    yield name + ": water made, of it", r.run.made, 1e-10
    yield name + ": momentum imbalance", r.run.summary["largest_momentum_imbalance"], 1e-10
    yield name + ": coupling iterations of any step after the first less 1", r.run.later_passes - 1.0, 0.0


def table(there, columns, cells):
    """Lines of Markdown, a row a run of results(): its name, cells(result) below `columns`, those of its Run below COLUMNS."""
    columns = ("run", *columns, *COLUMNS)
    yield "| " + " | ".join(columns) + " |"
    yield "|" + "---|" * len(columns)
    for name, r in there.items():
        yield "| " + " | ".join([name, *cells(r), *r.run.cells(next(iter(there.values())).run)]) + " |"


def paint_arrows(axes, grid, spacing):
    """Velocities on a raster: the mean of the nodes in each square of it; the longest arrow is two squares."""
    place = np.floor(grid.points[:, :2] / spacing).astype(int)
    which = np.unique(place, axis=0, return_inverse=True)[1]
    which = which.reshape(-1)
    count = np.bincount(which)
    mean = [np.bincount(which, values) / count for values in (*grid.points[:, :2].T, *grid.node["velocity"][:, :2].T)]
    longest = max(np.hypot(*mean[2:]).max(), 1e-12)
    axes.quiver(*mean, color="0.25", width=0.0012, angles="xy", scale_units="xy", scale=longest / (2.0 * spacing))


def paint_phases(axes, folder, time, phase, arrows=0.0, mesh=False):
    """The fraction of the phase of this name by elements, bodies white; arrows: spacing of velocities, m; returns the time found."""
    found, fluid, body = read_run(folder, time)
    grid = fluid["velocity"]
    triangulation = Triangulation(*grid.points[:, :2].T, grid.cells)
    axes.tripcolor(triangulation, facecolors=grid.cell[phase].ravel(), cmap=COLOURS, vmin=0.0, vmax=1.0,
                   edgecolors="0.6" if mesh else "none", linewidth=0.15 if mesh else 0.0)
    if arrows:
        paint_arrows(axes, grid, arrows)
    if body is not None and len(body.cells):
        axes.tripcolor(Triangulation(*body.points[:, :2].T, body.cells), np.zeros(len(body.points)), cmap="Greys", vmin=0.0, vmax=1.0)
        body.points = body.points[:, :2]
        axes.plot(*outline(body).T, "k", linewidth=0.8)
    Window.around(grid.points[:, :2]).frame(axes)
    axes.set_title("t = %.3f s" % found, fontsize=9)
    return found


def draw_times(folder, times, phase, path, columns=2, arrows=0.0, mesh=False, size=(6.0, 2.3)):
    """A panel a time; times that the run has not reached are left out; its last if it has reached none."""
    last = snapshot_times(folder)[-1]
    times = [t for t in times if t <= last * (1.0 + 1e-9)] or [last]
    rows = -(-len(times) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(columns * size[0], rows * size[1]), squeeze=False, layout="constrained")
    for axis in axes.flat[len(times):]:
        axis.axis("off")
    for axis, time in zip(axes.flat, times):
        paint_phases(axis, folder, time, phase, arrows, mesh)
    figure.savefig(path, dpi=150)
    plt.close(figure)


def animate(folder, phase, path, size=(9.0, 3.4), every=1):
    figure, axes = plt.subplots(figsize=size, layout="constrained")
    writer = PillowWriter(fps=15)
    with writer.saving(figure, path, dpi=90):
        for time in snapshot_times(folder)[::every]:
            axes.clear()
            paint_phases(axes, folder, time, phase)
            writer.grab_frame()
    plt.close(figure)
