"""What a run of the floating square says: how much of its surface is wet, and when the water is where the paper says it is."""
import os
import pathlib
import sys

import numpy as np
from matplotlib.tri import Triangulation

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import phases
from snapshot import outline, read_bodies, read_snapshot

WIDTH, HEIGHT = 0.6, 0.4  # m, of the tank
DISTANCE = 0.006  # m, from the square's faces to where they are looked at
# s: half of the square is in the water; the front is at the right wall; and at the top
PAPER = {"half sunk": 0.150, "front at the wall": 0.255, "front at the top": 0.400}


def wet(folder, time):
    """Part of the square's faces with water before them."""
    found, fluid = read_snapshot(os.path.join(folder, "fluid.h5"), time)
    grid, body = fluid["velocity"], read_bodies(folder, found)
    body.points = body.points[:, :2]
    edges = outline(body).reshape(-1, 3, 2)[:, :2]
    middle, along = edges.mean(axis=1), edges[:, 1] - edges[:, 0]
    length = np.hypot(*along.T)
    normal = np.column_stack([along[:, 1], -along[:, 0]]) / length[:, None]
    outward = np.sign(((middle - body.points.mean(axis=0)) * normal).sum(axis=1))
    at = middle + DISTANCE * outward[:, None] * normal
    element = Triangulation(*grid.points[:, :2].T, grid.cells).get_trifinder()(*at.T)
    water = np.where(element >= 0, grid.cell["water"].ravel()[element], 0.0)
    return float((water * length).sum() / length.sum())


class Floating:
    def __init__(self, folder):
        p = phases.read_probes(folder)
        self.t, self.front, self.wall = p["t"], p["front_last"], p["wall_last"]
        self.solid_t, self.x, self.y = p["solid t"], 0.12 + p["middle_x"], 0.22 + p["middle_y"]
        self.times = np.array([t for t in phases.snapshot_times(folder) if t < 0.3])
        self.wet = np.array([wet(folder, t) for t in self.times])
        self.measured = {"half sunk": phases.crossing(self.times, self.wet, 0.5),
                         "front at the wall": phases.crossing(self.t, self.front, 0.999 * WIDTH),
                         "front at the top": phases.crossing(self.t, self.wall, 0.999 * HEIGHT)}

    def at(self, t):
        """The square's middle, m."""
        return float(np.interp(t, self.solid_t, self.x)), float(np.interp(t, self.solid_t, self.y))
