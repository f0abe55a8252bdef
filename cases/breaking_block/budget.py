"""Momentum and energy of a run of the breaking block, from its solid.csv."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from series import read_series

GRAVITY = (0.0, -9.81)  # m/s2


class Budget:
    """Of all bodies together, per metre of depth; impulses and energies since the first row.

    momentum[c] changes by fluid[c] + walls[c] + reaction[c] + weight[c], cumulative impulses, N s/m;  kinetic, strain, fracture, debonded
    (the part of fracture of what holds no more), J/m;  work of the fluid, of what drives nodes and of gravity, cumulative, J/m."""

    def __init__(self, folder):
        s = read_series(folder + "/solid.csv")
        bodies = [name[4:] for name in s if name.startswith("mass")]
        total = lambda name: sum(s[name + b] for b in bodies)
        self.t, self.cracks, self.pieces, self.broken = s["t"], s["cracks"], s["pieces"], s["broken joints"]
        self.kinetic, self.strain, self.fracture, self.debonded = total("kinetic"), total("strain"), s["fracture"], s["debonded"]
        dt, mass = np.diff(self.t), total("mass")
        self.momentum, self.fluid, self.walls, self.reaction, self.weight = [], [], [], [], []
        for c, (u, f, axis) in enumerate((("u", "fx", "x"), ("v", "fy", "y"))):
            self.momentum.append(sum(s["mass" + b] * s[u + b] for b in bodies))
            self.fluid.append(cumulative(total(f)[1:] * dt))
            self.walls.append(cumulative(s["walls_" + axis][1:]))
            self.reaction.append(cumulative(s["reaction_" + axis][1:]))
            self.weight.append(cumulative(mass[1:] * GRAVITY[c] * dt))
        self.work, self.reaction_work = cumulative(s["work"][1:]), cumulative(s["reaction work"][1:])
        height = sum(s["mass" + b] * s["y" + b] for b in bodies)
        self.gravity = GRAVITY[1] * (height - height[0])
        self.force = [total("fx"), total("fy")]
        self.substeps = s["substeps"]

    def momentum_error(self, c):
        """Largest over the run, of the largest momentum."""
        given = self.fluid[c] + self.walls[c] + self.reaction[c] + self.weight[c]
        return abs(self.momentum[c] - self.momentum[c][0] - given).max() / abs(self.momentum[0]).max()

    @property
    def excess(self):
        """Energy beyond what was there and what fluid, thrower and gravity gave, J/m: minus what damping, friction and contact have, so
        never above 0."""
        energy = self.kinetic + self.strain + self.fracture - self.work - self.reaction_work - self.gravity
        return energy - energy[0]

    def first_crack(self):
        """Time at which the first joint has broken, s; inf: none has."""
        broken = np.flatnonzero(self.broken > 0)
        return self.t[broken[0]] if len(broken) else np.inf

    def crack_energy(self, k=-1):
        """Fracture energy over the length of the cracks at row k, J/m2; nan: there are none."""
        return self.debonded[k] / self.cracks[k] if self.cracks[k] > 0.0 else np.nan


def cumulative(steps):
    return np.concatenate([[0.0], np.cumsum(steps)])
