"""The elastic membrane's shape and pressure, measured from a run's output; needs numpy and h5py (and what scripts/snapshot.py needs)."""
import csv
import functools
import pathlib
import sys

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
from snapshot import read_snapshot, whole_snapshots

RADIUS, THICKNESS = 0.5, 0.005  # m, of the middle line and of the wall at rest
REST_LENGTH = 2.0 * np.pi * RADIUS
EQUILIBRIUM = np.sqrt(0.375)  # m
YOUNG, POISSON = 1380.0, 0.205  # Pa, of Table 5
FAR = 1.4  # m, where the pressure outside is read
SKIN = 0.01  # m: half of the wall, an element of le = 0.004 m and the shell on either side


def ring_tension(stretch):
    """N/m of depth: the plane-strain neo-Hookean wall with both faces free, at this stretch of its middle line."""
    mu, lame = YOUNG / (2.0 * (1.0 + POISSON)), YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON))
    across = np.sqrt((mu + 0.5 * lame) / (mu + 0.5 * lame * stretch**2))
    j = stretch * across
    return THICKNESS * across * (mu / j * (stretch**2 - 1.0) + 0.5 * lame * (j - 1.0 / j))


def closed_area(x):
    return 0.5 * np.sum(x[:, 0] * np.roll(x[:, 1], -1) - x[:, 1] * np.roll(x[:, 0], -1))


def middle_line(group):
    """The wall's middle line [n, 2], counter-clockwise, from the ring's inner and outer nodes."""
    x = group["points"][()]
    rest = x - group["node/displacement"][()][:, :2]
    angle, radius = np.arctan2(rest[:, 1], rest[:, 0]), np.hypot(*rest.T)
    inner, outer = (np.flatnonzero(side)[np.argsort(angle[side])] for side in (radius < radius.mean(), radius > radius.mean()))
    return 0.5 * (x[inner] + x[outer])


def half_axis(x, c):
    """Half of the line's extent along coordinate c: through the parabola of its farthest nodes."""
    ends = []
    for sign in (1.0, -1.0):
        k = int(np.argmax(sign * x[:, c]))
        a, b, d = (sign * x[(k + i) % len(x), c] for i in (-1, 0, 1))
        ends.append(b + (a - d) ** 2 / (8.0 * (2.0 * b - a - d)) if 2.0 * b - a - d > 0.0 else b)
    return 0.5 * sum(ends)


@functools.lru_cache(None)
def history(folder):
    """Arrays t, rx, ry, area, length (of the middle line), radius (of the circle with that area)."""
    rows = []
    with h5py.File(folder / "solid.h5", "r") as file:
        for group, time in zip(*whole_snapshots(file, folder / "solid.h5")):
            x = middle_line(group["solid"])
            rows.append((time, half_axis(x, 0), half_axis(x, 1), closed_area(x),
                         np.sum(np.hypot(*(np.roll(x, -1, axis=0) - x).T))))
    shape = dict(zip(("t", "rx", "ry", "area", "length"), np.array(rows).T))
    shape["radius"] = np.sqrt(shape["area"] / np.pi)
    return shape


def reference():
    """The interface-fitted line membrane's t, rx, ry, drop = p(0) - p(FAR, 0)."""
    table = np.loadtxt(HERE / "reference" / "line_T0_10.csv", delimiter=",", comments="#")
    return {"t": table[:, 0], "rx": table[:, 1], "ry": table[:, 2], "drop": table[:, 4] - table[:, 5]}


def at(shape, key, t):
    return float(np.interp(t, shape["t"], shape[key]))


def crossings(shape):
    """When rx = ry."""
    d = shape["rx"] - shape["ry"]
    k = np.flatnonzero(d[:-1] * d[1:] < 0.0)
    return [float(shape["t"][i] - d[i] * (shape["t"][i + 1] - shape["t"][i]) / (d[i + 1] - d[i])) for i in k]


def barycentric(corners, points):
    """[np, nt, 3] of points [np, 2] on triangles [nt, 3, 2]."""
    a, b, c = corners.transpose(1, 0, 2)
    turn = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    p = points[:, None]
    return np.stack((turn(b - p, c - p), turn(c - p, a - p), turn(a - p, b - p)), axis=2) / turn(b - a, c - a)[:, None]


def pressure(folder, t, points):
    """The pressure (P2) nearest to t at points [n, 2]."""
    _, grids = read_snapshot(folder / "fluid.h5", t)
    grid, points = grids["pressure"], np.asarray(points, float)
    corners, values = grid.points[grid.cells[:, :3]], grid.node["pressure"].ravel()[grid.cells]
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = []
    for some in np.array_split(points, 1 + len(points) // 100):
        near = ((high >= some.min(axis=0)) & (low <= some.max(axis=0))).all(axis=1)
        l = barycentric(corners[near], some)
        k = np.argmax(l.min(axis=2), axis=1)
        l, v = l[np.arange(len(some)), k], values[near][k]
        shapes = np.column_stack((l * (2.0 * l - 1.0), 4.0 * l[:, [0, 1, 2]] * l[:, [1, 2, 0]]))
        found.append(np.sum(shapes * v, axis=1))
    return np.concatenate(found)


def drop(folder, t):
    inside, outside = pressure(folder, t, [(0.0, 0.0), (FAR, 0.0)])
    return float(inside - outside)


def jump(folder, t):
    """Across the wall at the end of a run, mean over directions: 0.1 m inside less 0.1 m outside."""
    angle = np.arange(64) * np.pi / 32.0
    inside, outside = (pressure(folder, t, r * np.column_stack((np.cos(angle), np.sin(angle)))).mean()
                       for r in (EQUILIBRIUM - 0.1, EQUILIBRIUM + 0.1))
    return float(inside - outside)


def profile(folder, t):
    x = np.linspace(-1.5, 1.5, 3001)[1:-1]
    return x, pressure(folder, t, np.column_stack((x, 0.0 * x)))


def profile_difference(one, other, t):
    """RMS and largest difference of two runs' pressures along y = 0, over the drop from centre to outside; SKIN away from the wall, where the
    pressure jumps within an element that lies elsewhere in another mesh."""
    x, p = profile(one, t)
    away = abs(abs(x) - at(history(one), "rx", t)) > SKIN
    difference = abs(p - profile(other, t)[1])[away] / drop(one, t)
    return float(np.sqrt(np.mean(difference**2))), float(np.max(difference))


def last_row(path):
    rows = list(csv.DictReader(line for line in open(path) if not line.startswith("#")))
    return rows[-1]
