"""What a run of the elastic obstacle says: the displacement of the wall's tip beside two published curves."""
import csv
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import phases

CODES = ("meduri", "ryzhakov")
GAUGE = 0.28  # m: where the front is timed, 12 mm before the wall


def reference():
    """t and the columns CODES of reference/tip.csv."""
    with open(HERE / "reference" / "tip.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: np.array([float(row[name]) for row in rows]) for name in ("t", *CODES)}


def first_swing(t, x):
    """The largest displacement, m, when, s, and when half of it is reached and left again, s."""
    k = int(np.argmax(x))
    rise = phases.crossing(t[:k + 1], x[:k + 1], 0.5 * x[k])
    fall = phases.crossing(t[k:], -x[k:], -0.5 * x[k])
    return x[k], t[k], rise, fall


class Obstacle:
    def __init__(self, folder):
        p = phases.read_probes(folder)
        self.t, self.x = p["solid t"], p["tip_x"]
        self.front = phases.crossing(p["t"], p["front_last"], GAUGE)
        self.swing = first_swing(self.t, self.x)
