"""What a run of the moored platform says, and the flume without it; and what linear theory expects."""
import functools
import os
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scripts"))
import phases
import waves
from potential import motion
from series import read_series

PERIOD, SPEED, DEPTH, SURFACE = 1.2, 0.0738, 0.5, 0.5  # s, m/s: of the piston; m
PLACE, WIDTH, HEIGHT, DENSITY = 3.2, 0.5, 0.2, 500.0  # m, kg/m3
LINES = (((2.95, 0.45), (2.15, 0.0)), ((3.45, 0.45), (4.25, 0.0)))  # m
STIFFNESS, LENGTH = 60.0, 0.87  # N/m, m
GAUGES = {"first": 2.2, "second": 2.6, "middle": 3.2, "third": 4.2, "fourth": 4.6}  # m
OMEGA = 2.0 * np.pi / PERIOD
WINDOW = (6.4, 6.4 + 3.0 * PERIOD)  # s: after the waves have come, before what the platform and the piston reflect has come back


def harmonic(t, values):
    """The complex amplitude X of Re(X e^{-i omega t}) over the window, beside its first overtone and what changes slowly; nan if the run has
    not come to its end."""
    there = (t >= WINDOW[0]) & (t <= WINDOW[1])
    if t[-1] < WINDOW[1] - 0.1 * PERIOD:
        return complex("nan")
    return waves.harmonic(t[there], np.asarray(values)[there], OMEGA)[0]


class Motion:
    """Sway and heave over the wave's amplitude, roll over its slope; complex, of Re(... e^{-i omega t})."""

    def __init__(self, sway, heave, roll):
        self.motion = {"sway": sway, "heave": heave, "roll": roll}

    def polar(self, name):
        """Amplitude, and by how many degrees it is behind the wave's crest in the platform's middle."""
        return abs(self.motion[name]), float(np.degrees(np.angle(self.motion[name])))


def line_stiffness():
    """[3][3] of both lines for sway, heave, roll about the platform's centre."""
    total = np.zeros((3, 3))
    for point, anchor in LINES:
        arm, along = np.subtract(point, (PLACE, SURFACE)), np.subtract(anchor, point)
        length = np.hypot(*along)
        along = along / length
        across, tension = np.array([-along[1], along[0]]), STIFFNESS * (length - LENGTH)
        for direction, stiffness in ((along, STIFFNESS), (across, tension / length)):
            lever = np.array([*direction, arm[0] * direction[1] - arm[1] * direction[0]])
            total += stiffness * np.outer(lever, lever)
    return total


class Theory(Motion):
    def __init__(self):
        response, k = motion(WIDTH, HEIGHT, DENSITY, DEPTH, OMEGA, line_stiffness())
        super().__init__(response[0], response[1], response[2] / k)
        self.length = 2.0 * np.pi / k
        height_over_stroke = 2.0 * (np.cosh(2.0 * k * DEPTH) - 1.0) / (np.sinh(2.0 * k * DEPTH) + 2.0 * k * DEPTH)
        self.piston = height_over_stroke * SPEED / OMEGA  # amplitude of its waves, m


@functools.cache
def theory():
    return Theory()


class Flume:
    """Without the platform: the wave that it is going to meet."""

    def __init__(self, folder):
        p = phases.read_probes(folder)
        self.piston = theory().piston * (0.5 if folder.name == "waves-half" else 1.0)
        elevation = {name: harmonic(p["t"], p[name + "_last"] - SURFACE) for name in GAUGES}
        self.incident = elevation["middle"]
        place = np.array(list(GAUGES.values()))
        values = np.array(list(elevation.values()))
        best = np.inf
        for k in np.linspace(0.8, 1.2, 401) * 2.0 * np.pi / theory().length:
            incident, reflected, left = waves.split(place - PLACE, values, k)
            if np.abs(left).sum() < best:
                best, self.length, self.reflected = np.abs(left).sum(), 2.0 * np.pi / k, abs(reflected / incident)


class Moored(Motion):
    def __init__(self, folder, flume):
        s, wave = read_series(os.path.join(folder, "solid.csv")), flume.incident
        self.t, self.x, self.y, turn = s["t"], s["x1"] - PLACE, s["y1"] - SURFACE, s["omega1"]
        k = 2.0 * np.pi / flume.length
        super().__init__(harmonic(self.t, self.x) / wave, harmonic(self.t, self.y) / wave, harmonic(self.t, turn) / (-1j * OMEGA) / (k * wave))
        self.drift = float(self.x[self.t > self.t[-1] - PERIOD].mean())
        p = phases.read_probes(folder)
        self.line = {name: p[name + "_tension"] for name in ("windward", "lee")}
        self.line_t = p["solid t"]
        there = (self.line_t >= WINDOW[0]) | (self.line_t[-1] < WINDOW[0])
        self.tension = {name: (values[there].min(), values[there].max()) for name, values in self.line.items()}
        self.angle = np.concatenate([[0.0], np.cumsum(np.diff(self.t) * turn[1:])])
