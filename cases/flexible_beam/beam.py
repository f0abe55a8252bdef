"""What a run of the flexible beam says: the tip's displacement and the force on the body; beam.py FOLDER FROM prints it of its periods.

Needs numpy.
"""
import csv
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
from series import periodic, read_series, upward

QUANTITIES = ("x", "y", "drag", "lift")  # mm, mm, N/m, N/m
PERIOD = 0.1827  # s, of the reference's rows
HELD = 1e-9  # m: a tip that moves less is that of a body that is held


def reference():
    """t and QUANTITIES of a period of FSI3 (reference/fsi3.csv)."""
    with open(HERE / "reference" / "fsi3.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    unit = {"x": 1e3, "y": 1e3}
    return {name: unit.get(name, 1.0) * np.array([float(row[name]) for row in rows]) for name in ("t", *QUANTITIES)}


class Run:
    """Series of a run's folder from `start` on: t and QUANTITIES (forces not where the solid is alone).  Forces are means over a step, and
    stand at its middle."""

    def __init__(self, folder, start):
        tip, solid = (read_series(folder / name) for name in ("solid_probes.csv", "solid.csv"))
        self.t, late = tip["t"], tip["t"] > start
        self.t_force = solid["t"] - 0.5 * np.diff(solid["t"], prepend=0.0)
        self.series = {"x": 1e3 * tip["tip_x"], "y": 1e3 * tip["tip_y"], "drag": solid["fx0"], "lift": solid["fy0"]}
        self.late = {"x": late, "y": late, "drag": self.t_force > start, "lift": self.t_force > start}

    def times(self, name):
        """(t, values) of a quantity, late ones."""
        t = self.t if name in ("x", "y") else self.t_force
        return t[self.late[name]], self.series[name][self.late[name]]

    def mean(self, name):
        t, values = self.times(name)
        return np.trapz(values, t) / (t[-1] - t[0])

    def lowest(self, name):
        """Of a parabola through the three lowest values in a row."""
        values = self.times(name)[1]
        k = 1 + int(np.argmin(values[1:-1]))
        bend, slope = values[k - 1] - 2.0 * values[k] + values[k + 1], 0.5 * (values[k + 1] - values[k - 1])
        return values[k] - 0.5 * slope**2 / bend

    def swing(self):
        """{quantity: (mean, amplitude)} over the whole periods that there are, and the frequency, Hz.  A beam that is held has that of
        its lift."""
        moves = np.ptp(self.times("y")[1]) > 1e3 * HELD
        crossings = upward(*self.times("y" if moves else "lift"))
        frequency = (len(crossings) - 1) / (crossings[-1] - crossings[0])
        found = {}
        for name in QUANTITIES:
            t, values = self.times(name)
            whole = (t > crossings[0]) & (t <= crossings[-1])
            found[name] = periodic(t[whole], values[whole], frequency) if moves or name in ("drag", "lift") else (0.0, 0.0)
        return found, frequency


def main():
    swing, frequency = Run(pathlib.Path(sys.argv[1]), float(sys.argv[2])).swing()
    for name, (mean, amplitude) in swing.items():
        print("%-5s %8.3f +- %7.3f %s" % (name, mean, amplitude, "mm" if name in ("x", "y") else "N/m"))
    print("%.4f Hz" % frequency)


if __name__ == "__main__":
    main()
