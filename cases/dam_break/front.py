"""The front of a run of the dam break beside the experiment of Martin and Moyce, and beside potential flow."""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
from phases import read_probes

A, GRAVITY = 0.05715, 9.81  # m, m/s2


def experiment():
    """T and Z."""
    return np.loadtxt(HERE / "reference" / "martin_moyce.csv", delimiter=",", comments="#", skiprows=3).T


def potential():
    """T and Z of potential flow (potential.py), for a floor without friction and no gate."""
    return np.loadtxt(HERE / "reference" / "potential.csv", delimiter=",", comments="#", skiprows=2).T


def front(folder):
    """T and Z of every step."""
    probes = read_probes(folder)
    return probes["t"] * np.sqrt(2.0 * GRAVITY / A), probes["front_last"] / A


class Comparison:
    """shift: the experiment's times less the run's at the same Z, T, the median over its points; difference: of Z at the experiment's
    times less the shift, relative; potential: largest relative difference of Z from potential flow, from T = 1 on; speed: dZ/dT of
    the run from T = 4 on."""

    def __init__(self, folder):
        t, z = front(folder)
        reference_t, reference_z = experiment()
        reached = reference_z <= z.max()
        self.lag = reference_t[reached] - np.interp(reference_z[reached], z, t)
        self.z = reference_z[reached]
        self.shift = float(np.median(self.lag))
        self.difference = np.interp(reference_t[reached] - self.shift, t, z) / reference_z[reached] - 1.0
        self.mean = float(abs(self.difference).mean())
        self.second, self.largest = (float(d) for d in np.sort(abs(self.difference))[-2:])
        potential_t, potential_z = potential()
        there = (potential_t >= 1.0) & (potential_t <= t[-1])
        self.potential = float(abs(np.interp(potential_t[there], t, z) / potential_z[there] - 1.0).max())
        late = (t > 4.0) & (z < 14.0)
        self.speed = float(np.polyfit(t[late], z[late], 1)[0])
