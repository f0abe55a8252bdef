"""What a run of the vibrating cylinder says over its last periods; cylinder.py FOLDER prints it.

Diameter, speed and density of the fluid are 1: y is in diameters, the frequency in speeds over diameters, forces over rho U^2 D/2 are coefficients.
Needs numpy.
"""
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
from series import harmonics, periodic, read_series, upward

QUANTITIES = ("amplitude", "frequency", "drag", "lift")  # of y, of y or of the lift where y does not move; the mean, the amplitude
PERIODS = 4  # that count
HELD = 1e-6  # an amplitude below is that of a cylinder that is held


class Run:
    """Series of a run's folder: t, y, and forces' coefficients, which are means over a step and stand at its middle, t_force."""

    def __init__(self, folder):
        probe, solid = (read_series(pathlib.Path(folder) / name) for name in ("solid_probes.csv", "solid.csv"))
        self.t, self.y = probe["t"], probe["centre_y"]
        self.t_force = solid["t"] - 0.5 * np.diff(solid["t"], prepend=0.0)
        self.drag, self.lift = 2.0 * solid["fx0"], 2.0 * solid["fy0"]
        self.work, self.mass = np.cumsum(solid["fy0"] * np.diff(solid["y0"], prepend=solid["y0"][0])), solid["mass0"][-1]

    def periodic(self, end=np.inf):
        """{quantity: value} over the last PERIODS before `end`, nan where it does not swing; damping: the ratio with which a spring's damper would
        take the fluid's work."""
        late, late_force = ((t > 0.4 * t[-1]) & (t <= end) for t in (self.t, self.t_force))
        moves = np.ptp(self.y[late]) > HELD
        crossings = (upward(self.t[late], self.y[late]) if moves else upward(self.t_force[late_force], self.lift[late_force]))[-PERIODS - 1:]
        if len(crossings) < 2:
            return dict.fromkeys((*QUANTITIES, "damping"), np.nan)
        frequency = (len(crossings) - 1) / (crossings[-1] - crossings[0])
        whole, whole_force = ((t > crossings[0]) & (t <= crossings[-1]) for t in (self.t, self.t_force))
        forces = {name: (self.t_force[whole_force], values[whole_force], frequency) for name, values in (("drag", self.drag), ("lift", self.lift))}
        amplitude = periodic(self.t[whole], self.y[whole], frequency)[1] if moves else 0.0
        work = np.diff(self.work[whole_force][[0, -1]])[0] / (len(crossings) - 1)
        return {"amplitude": amplitude, "frequency": frequency, "drag": harmonics(*forces["drag"])[0].real, "lift": periodic(*forces["lift"])[1],
                "damping": work / (self.mass * (2.0 * np.pi * frequency * amplitude)**2 * 2.0 * np.pi) if moves else 0.0}


def main():
    run = Run(sys.argv[1])
    for end in (0.9 * run.t[-1], run.t[-1]):
        print("%6.1f  " % end + "  ".join("%s %.4f" % item for item in run.periodic(end).items()))


if __name__ == "__main__":
    main()
