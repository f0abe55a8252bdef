"""The benchmark's quantities of a run of the rising bubble, and its references."""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
from phases import read_probes

# Hysing et al. 2009, test 1: the ranges of the three codes on their finest meshes
RANGES = {"least circularity": (0.9011, 0.9013), "greatest rise velocity": (0.2417, 0.2421), "centre at 3 s": (1.0799, 1.0819)}
# test 2, from memory, not checked against the paper: least circularity, first and second maximum of the rise velocity, m/s, and their times, s, centre at 3 s, m
CODES = {"TP2D": (0.5869, 0.2524, 0.7332, 0.2434, 2.0705, 1.1380),
         "FreeLIFE": (0.4647, 0.2514, 0.7281, 0.2440, 1.9844, 1.1249),
         "MooNMD": (0.5144, 0.2502, 0.7317, 0.2393, 2.0600, 1.1376)}
TEST_2 = ["fluid.phases[0].density=1.0", "fluid.phases[0].viscosity=0.1", "fluid.surface_tension=1.96"]


def reference(code):
    """t, circularity, y of the centre, rise velocity of test 1."""
    return np.loadtxt(HERE / "reference" / ("test1_%s.csv" % code), delimiter=",").T


class Bubble:
    """t, circularity (perimeter of the circle of its area over its own), centre and speed of a run, by steps."""

    def __init__(self, folder):
        probes = read_probes(folder)
        self.t, self.area, self.y, self.speed = (probes[name] for name in ("t", "bubble_area", "bubble_y", "bubble_v"))
        self.circularity = 2.0 * np.sqrt(np.pi * self.area) / probes["bubble_interface"]

    def fastest(self, begin, end):
        """The greatest rise velocity between two times, and when."""
        among = np.flatnonzero((self.t >= begin) & (self.t <= end))
        k = among[self.speed[among].argmax()]
        return float(self.speed[k]), float(self.t[k])

    @property
    def least(self):
        """The least circularity, of means over 0.02 s: a step's depends on how the interface lies in the mesh."""
        edges = np.arange(0.0, self.t[-1], 0.02)
        place = np.digitize(self.t, edges)
        return float(min(self.circularity[place == k].mean() for k in np.unique(place)))

    def differences(self, code="moonmd"):
        """Of circularity, centre and speed from a code's, at its times: the largest over the largest value."""
        t, *curves = reference(code)
        mine = (self.circularity, self.y, self.speed)
        return [float(abs(np.interp(t, self.t, own) - other).max() / other.max()) for own, other in zip(mine, curves)]
