"""Snapshots of a run (fluid.h5, solid.h5) and how they are painted; needs numpy, h5py and matplotlib."""
import os
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # the run may still be writing: read beside it, never in its way

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.tri import Triangulation

ROUND_OFF = 1e-6  # of the largest value: what volume fractions have below 0
SAME_TIME = 1e-6  # s, and of the time
# A six-node triangle (midpoints of 01, 12, 20 are 3, 4, 5) as four straight ones.
QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


class Grid:
    """A grid of one snapshot: points [n, 2], cells [ne, k], fields by name."""

    def __init__(self, group):
        self.points = group["points"][()]
        self.cells = group["cells"][()]
        self.node = {name: values[()] for name, values in group["node"].items()}
        self.cell = {name: values[()] for name, values in group["cell"].items()}

    def triangles(self):
        """Corners [nt, 3] of its straight triangles."""
        return self.cells[:, QUARTERS].reshape(-1, 3) if self.cells.shape[1] == 6 else self.cells

    def node_areas(self):
        """The part of the area that belongs to each point, m2."""
        triangles = self.triangles()
        a, b, c = self.points[triangles].transpose(1, 0, 2)
        thirds = abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 6.0
        return np.bincount(triangles.ravel(), np.repeat(thirds, 3), len(self.points))


class Window:
    """A rectangle of the plane between two opposite corners, m."""

    def __init__(self, one, other):
        self.lower, self.upper = np.sort(np.array([one, other], float), axis=0)

    @classmethod
    def around(cls, points):
        return cls(np.nanmin(points, axis=0), np.nanmax(points, axis=0))

    @property
    def centre(self):
        return 0.5 * (self.lower + self.upper)

    @property
    def size(self):
        return self.upper - self.lower

    def frame(self, axes):
        axes.set(xlim=(self.lower[0], self.upper[0]), ylim=(self.lower[1], self.upper[1]), aspect="equal")

    def cut(self, other):
        """The part of the window that lies in the other; the other where they have nothing in common."""
        lower, upper = np.maximum(self.lower, other.lower), np.minimum(self.upper, other.upper)
        return Window(lower, upper) if (upper > lower).all() else other

    def triangulation(self, grid, cells=None):
        """The grid's triangles that reach into the window, only those of `cells` (bool [ne]) where there are any; LookupError where there is none."""
        triangles = grid.triangles()
        corners = grid.points[triangles]
        inside = ((corners.max(axis=1) >= self.lower) & (corners.min(axis=1) <= self.upper)).all(axis=1)
        if not inside.any() or not (self.size > 0.0).all():
            low, high = (f"({x:g}, {y:g})" for x, y in (np.nanmin(grid.points, axis=0), np.nanmax(grid.points, axis=0)))
            raise LookupError(f"there is nothing in the window {(*self.lower, *self.upper)}: all lies from {low} to {high}")
        if cells is not None:
            chosen = inside & np.repeat(cells, len(triangles) // len(cells))
            inside = chosen if chosen.any() else inside
        return Triangulation(*grid.points.T, triangles[inside])

    def percentiles(self, grid, values, *percents, cells=None):
        """Percentiles of nodal values over the points of triangulation(grid, cells)."""
        return np.percentile(values[np.unique(self.triangulation(grid, cells).triangles)], percents)


def whole_snapshots(file, path):
    """Groups of the snapshots of this open file, and their times; LookupError where there is none."""
    snapshots = [file["snapshot"][name] for name in sorted(file["snapshot"])]
    snapshots = [s for s in snapshots if len(s) and len(s) == len(snapshots[0])]  # a running case's last may be in the making
    if not snapshots:
        raise LookupError(f"{path} has no snapshot yet")
    return snapshots, np.array([s.attrs["time"] for s in snapshots])


def read_times(path):
    with h5py.File(path, "r") as file:
        return whole_snapshots(file, path)[1]


def common_times(*paths):
    """Times of the snapshots that all of a run's files have: of a run that goes on, or was stopped, one may have a snapshot more."""
    times, *others = (read_times(path) for path in paths)
    times = [t for t in times if all(abs(other - t).min() <= SAME_TIME * max(1.0, abs(t)) for other in others)]
    if not times:
        raise LookupError(f"{' and '.join(map(str, paths))} have no snapshot of the same time")
    return np.array(times)


def nearest(times, time):
    """The one of these times that is nearest to `time`, or the last."""
    return times[-1] if time is None else times[int(np.argmin(abs(times - time)))]


def read_snapshot(path, time=None):
    """Time and grids of the snapshot nearest to `time`, or of the last one; LookupError where there is none."""
    with h5py.File(path, "r") as file:
        snapshots, times = whole_snapshots(file, path)
        found = nearest(times, time)
        return found, {name: Grid(group) for name, group in snapshots[list(times).index(found)].items()}


def run_files(folder):
    """fluid.h5 and, where the run has a solid, solid.h5."""
    fluid, solid = (os.path.join(folder, name) for name in ("fluid.h5", "solid.h5"))
    return (fluid, solid) if os.path.exists(solid) else (fluid,)


def read_run(folder, time=None):
    """Time, the fluid's grids and the solid's (None where the run has no bodies) of the snapshot nearest to `time`, or of the last one, of those that
    both have."""
    files = run_files(folder)
    found = nearest(common_times(*files), time)
    bodies = read_snapshot(files[1], found)[1]["solid"] if len(files) > 1 else None
    return found, read_snapshot(files[0], found)[1], bodies if bodies is not None and len(bodies.points) else None


def outline(grid):
    """The edges of one triangle only, as a line broken by nan."""
    edges = np.sort(np.concatenate([grid.cells[:, [0, 1]], grid.cells[:, [1, 2]], grid.cells[:, [2, 0]]]), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    ends = grid.points[edges[count == 1]]
    return np.concatenate([ends, np.full((len(ends), 1, 2), np.nan)], axis=1).reshape(-1, 2)


def without_hydrostatic(grid, weight):
    """p + weight y less its mean over the domain; the weight rho g, N/m3, comes from a fit along the side walls if None."""
    x, y = grid.points.T
    p = grid.node["pressure"]
    if weight is None:
        margin = 0.05 * np.ptp(x)
        wall = (x < x.min() + margin) | (x > x.max() - margin)
        weight = -np.polyfit(y[wall], p[wall], 1)[0]
    p = p + weight * y
    return p - np.average(p, weights=grid.node_areas()), weight


def vertices(grid):
    """The points where triangles meet, each once, and the triangles' numbers of them: elements of the fluid have points of their own."""
    points, place = np.unique(np.round(grid.points[:, :2], 9), axis=0, return_inverse=True)
    return points, place.reshape(-1)[grid.cells]


def vorticity(grid):
    """At the vertices, dv/dx - du/dy: mean over the triangles there by their areas; and the triangulation of the vertices."""
    x, u, cells = grid.points[:, :2], grid.node["velocity"][:, :2], grid.cells
    points, triangles = vertices(grid)
    corner, speed = x[cells], u[cells]
    d1, d2 = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    twice = d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]
    u1, u2 = speed[:, 1] - speed[:, 0], speed[:, 2] - speed[:, 0]
    dvdx = (u1[:, 1] * d2[:, 1] - u2[:, 1] * d1[:, 1]) / twice
    dudy = (u2[:, 0] * d1[:, 0] - u1[:, 0] * d2[:, 0]) / twice
    at, weight = triangles.ravel(), np.repeat(abs(twice), 3)
    values = np.bincount(at, weight * np.repeat(dvdx - dudy, 3)) / np.bincount(at, weight)
    return Triangulation(*points.T, triangles), values


def centred(low, high, even=True):
    """A diverging colour map for low < 0 < high, neutral at 0: equally steep on both sides, or (not even) full at both ends."""
    below, above = (max(-low, high),) * 2 if even else (-low, high)
    place = np.interp(np.linspace(low, high, 256), [-below, 0.0, above], [0.0, 0.5, 1.0])
    return LinearSegmentedColormap.from_list("centred", matplotlib.colormaps["RdBu_r"](place))


def colours(low, high):
    """A colour map of values from low to high: a diverging one if they have both signs, but for round-off."""
    return centred(low, high, even=False) if min(-low, high) > ROUND_OFF * max(-low, high) else "viridis"


class Panel:
    """Axes of this box of a figure, and a colour bar below them or, of what is not wide, on their right; lengths in inches."""

    def __init__(self, figure, left, bottom, width, height, wide):
        bar = (left, bottom - 0.75, width, 0.15) if wide else (left + width + 0.15, bottom, 0.15, height)
        scale = np.tile(figure.get_size_inches(), 2)
        self.axes = figure.add_axes(np.array([left, bottom, width, height]) / scale)
        self.bar = figure.add_axes(np.array(bar) / scale)
        self.orientation = "horizontal" if wide else "vertical"

    def colour_bar(self, shade, label, ticks=None, extend="both"):
        return self.axes.figure.colorbar(shade, cax=self.bar, orientation=self.orientation, label=label, ticks=ticks, extend=extend, extendfrac=0.02)


def panels(*windows, beside=False):
    """A figure and its Panels, one below the other or beside it, each filled by its window.

    A window more than eleven times as long as wide is stretched across.
    """
    edge = 7.5 / np.sqrt(len(windows))
    sizes = [np.maximum(1.0, w.size * min(edge / np.sqrt(w.size.prod()), 11.0 / w.size.max())) for w in windows]
    wide = [width > 1.5 * height for width, height in sizes]
    boxes = np.array(sizes) + [(1.3, 1.8) if w else (2.2, 1.1) for w in wide]  # with labels and colour bar
    extent = np.where([beside, not beside], boxes.sum(axis=0), boxes.max(axis=0))
    corner, made, figure = np.array([0.0, extent[1]]), [], plt.figure(figsize=extent)  # upper left
    for size, w, box in zip(sizes, wide, boxes):
        middle = 0.5 * (extent[1] - box[1]) if beside else 0.0
        made.append(Panel(figure, corner[0] + 0.9, corner[1] - middle - 0.4 - size[1], *size, w))
        corner += (box[0], 0.0) if beside else (0.0, -box[1])
    return figure, made


def paint_field(axes, grid, values, window, limits, colour_map):
    """Gouraud shading of nodal values in the window."""
    return axes.tripcolor(window.triangulation(grid), values, shading="gouraud", cmap=colour_map, vmin=limits[0], vmax=limits[1])


def paint_bodies(axes, body, cover=False):
    """The bodies' outline; their inside grey if `cover`."""
    if cover and len(body.cells):
        axes.tripcolor(Triangulation(*body.points.T, body.cells), np.zeros(len(body.points)), cmap="Greys", vmin=-0.3, vmax=1.0, zorder=2)
    axes.plot(*outline(body).T, "k", linewidth=0.8)


def paint(axes, grid, values, window, limits, colour_map, label, body=None, ticks=None, cover=False):
    """A field in the window, a colour bar above, the bodies."""
    shade = paint_field(axes, grid, values, window, limits, colour_map)
    axes.figure.colorbar(shade, ax=axes, label=label, location="top", fraction=0.03, pad=0.01, shrink=0.85, extend="both", ticks=ticks)
    if body is not None:
        paint_bodies(axes, body, cover)
    window.frame(axes)


def paint_mesh(axes, grid, window, body=None, linewidth=0.4, inside=False):
    """The fluid's triangles (if any: grid) in the window and the bodies' outline; their own triangles too if `inside`."""
    if grid is not None:
        axes.triplot(window.triangulation(grid), color="0.35", linewidth=linewidth)
    if body is not None:
        if inside:
            axes.triplot(Triangulation(*body.points.T, body.cells), color="C3", linewidth=linewidth, alpha=0.6)
        axes.plot(*outline(body).T, "C3", linewidth=1.2)
    window.frame(axes)


def write_figure(figure, path):
    figure.savefig(path, dpi=150, bbox_inches="tight")


def save(draw, arguments, path, name, write=write_figure):
    """What draw(arguments) makes into arguments.out, or else `path`; what is not there or cannot be read ends the script called `name`."""
    try:
        made = draw(arguments)
    except (LookupError, OSError) as error:
        sys.exit(f"{name}: {error}")
    path = arguments.out or path
    try:
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        write(made, path)
    except (OSError, ValueError) as error:  # of the folder, and of what the name ends with
        sys.exit(f"{name}: {path}: {error}")
    print(path)
