"""What a run of the collapsing column says: when the front reaches the square, when the square reaches the wall, and the gauges of Fig. 14."""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import phases

LEFT, RIGHT, WALL = 0.85, 0.89, 1.15  # m: the square's faces at the start, the tank's right wall
DEPTH, WEIGHT = 0.2, 1060.0 * 9.80665  # m, the column's; rho g of water, N/m3
PAPER = {"front": 0.390, "wall": 0.627}  # s; without a gate other codes have 0.360 to 0.365 s, and 0.60 to 0.67 s
GAUGES = ("P1", "P2", "P3")  # 0.01, 0.02, 0.03 m above the square's bottom


class Column:
    def __init__(self, folder):
        p = phases.read_probes(folder)
        self.t, self.front, self.solid_t = p["t"], p["front_last"], p["solid t"]
        self.motion = p["right_x"]
        self.pressure = {name: p[name + "_p"] / (WEIGHT * DEPTH) for name in GAUGES}
        self.reaches_square = phases.crossing(self.t, self.front, LEFT)
        self.reaches_wall = self._impact(p["right_u"])

    def _impact(self, u):
        """When the right face has lost half of its largest speed: air before the wall stops it less than an element away."""
        fastest = int(np.argmax(u))
        if self.motion[fastest] < 0.9 * (WALL - RIGHT):
            return float("nan")
        return phases.crossing(self.solid_t[fastest:], -u[fastest:], -0.5 * u[fastest])

    def peak(self, name):
        """The largest p/(rho g H) of a gauge before the square comes near the wall, and when."""
        before = self.t < (self.reaches_wall - 0.01 if np.isfinite(self.reaches_wall) else np.inf)
        k = int(np.nanargmax(np.where(before, self.pressure[name], np.nan)))
        return self.pressure[name][k], self.t[k]

    @property
    def speed(self):
        """Of the square between a quarter and three quarters of its way, m/s."""
        way = WALL - RIGHT
        first, last = (phases.crossing(self.solid_t, self.motion, part * way) for part in (0.25, 0.75))
        return 0.5 * way / (last - first)
