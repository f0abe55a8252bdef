"""What a run of the floating square says: how much of its surface is wet, and when the water is where the paper says it is."""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import phases
from snapshot import outline, read_run

WIDTH, HEIGHT = 0.6, 0.4  # m, of the tank
DISTANCE = 0.006  # m, from the square's faces to where they are looked at
SINKING = 0.150  # s: "near the half of the solid square sinks into water"
AFLOAT = 0.25 + 0.5 * 500.0 / 1060.0  # wet part of the faces at Archimedes' draught, upright
PAPER = {"front at the wall": 0.255, "front at the top": 0.400}  # s


def fraction(grid, phase, x):
    """Of the phase of this name in the element at x; 0 out of the mesh."""
    a, b, c = grid.points[grid.cells][:, :, :2].transpose(1, 0, 2)

    def turn(p, q):
        return (q - p)[:, 0] * (x[1] - p[:, 1]) - (q - p)[:, 1] * (x[0] - p[:, 0])
    inside = (turn(a, b) >= 0.0) & (turn(b, c) >= 0.0) & (turn(c, a) >= 0.0)
    return float(grid.cell[phase].ravel()[inside].mean()) if inside.any() else 0.0


def wet(folder, time):
    """Part of the square's faces with water before them."""
    _, fluid, body = read_run(folder, time)
    grid = fluid["velocity"]
    body.points = body.points[:, :2]
    edges = outline(body).reshape(-1, 3, 2)[:, :2]
    middle, along = edges.mean(axis=1), edges[:, 1] - edges[:, 0]
    length = np.hypot(*along.T)
    normal = np.column_stack([along[:, 1], -along[:, 0]]) / length[:, None]
    outward = np.sign(((middle - body.points.mean(axis=0)) * normal).sum(axis=1))
    at = middle + DISTANCE * outward[:, None] * normal
    water = np.array([fraction(grid, "water", x) for x in at])
    return float((water * length).sum() / length.sum())


class Floating:
    def __init__(self, folder):
        p = phases.read_probes(folder)
        self.t, self.front, self.wall = p["t"], p["front_last"], p["wall_last"]
        self.solid_t, self.x, self.y = p["solid t"], 0.12 + p["middle_x"], 0.22 + p["middle_y"]
        self.times = np.array([t for t in phases.snapshot_times(folder) if t < 0.3])
        self.wet = np.array([wet(folder, t) for t in self.times])
        self.sinking, self.afloat = float(np.interp(SINKING, self.times, self.wet)), phases.crossing(self.times, self.wet, AFLOAT)
        self.measured = {"front at the wall": phases.crossing(self.t, self.front, 0.999 * WIDTH),
                         "front at the top": phases.crossing(self.t, self.wall, 0.999 * HEIGHT)}

    def at(self, t):
        """The square's middle, m."""
        return float(np.interp(t, self.solid_t, self.x)), float(np.interp(t, self.solid_t, self.y))
