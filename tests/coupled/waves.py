"""Waves that a piston makes in a tank, by linear potential theory, and those of a run beside it.

    waves.py               the piston's prescribed motion, as a value for --set
    waves.py FOLDER MOST   checks the run's gauges: root mean square of the difference over that of the waves, at most MOST

Water of depth D between a piston at x = 0, which moves with U(t), and a wall at L:

    phi = U ((L - x)^2 - y^2)/(-2 L) + sum a_n cos k_n x cosh k_n y/cosh k_n D,    k_n = n pi/L
    on the surface d2 phi/dt2 + g dphi/dy = 0,    eta = -1/g dphi/dt

The first term has the piston's velocity at x = 0 and none at L and on the floor.  b_n = a_n plus the n-th coefficient of U times the first
term obeys an equation without derivatives of U, which is marched.
"""
import csv
import sys

import numpy as np

STROKE, PERIOD, END = 0.01, 1.0, 2.4  # m, s
FACE, WALL, DEPTH, G = 0.35, 3.0, 0.5, 9.81  # m, m/s2
GAUGES = {"near": 0.9, "far": 1.5}  # m


def piston():
    """Rows of time and velocity: a sine that begins within a period."""
    t = np.linspace(0.0, END, 97)
    return t, np.minimum(t / PERIOD, 1.0) * STROKE * np.pi / PERIOD * np.sin(2.0 * np.pi * t / PERIOD)


def waves(dt=0.0005, modes=200):
    """Times and elevations at the gauges."""
    length = WALL - FACE
    k = np.arange(modes) * np.pi / length
    squared = G * k * np.tanh(k * DEPTH)
    x = np.linspace(0.0, length, 20001)
    first = ((length - x) ** 2 - DEPTH ** 2) / (-2.0 * length)
    product = np.cos(np.outer(k, x)) * first
    part = (product[:, 1:] + product[:, :-1]).sum(1) * 0.5 * (x[1] - x[0]) * np.where(k > 0.0, 2.0, 1.0) / length
    t = np.arange(0.0, END, dt)
    b, rate, eta = np.zeros(modes), np.zeros(modes), np.zeros((len(t), len(GAUGES)))
    shape = np.cos(np.outer([at - FACE for at in GAUGES.values()], k))
    for i, u in enumerate(np.interp(t, *piston())):
        change = -squared * (b - u * part)
        change[0] -= G * u * DEPTH / length
        rate += (0.5 if i == 0 else 1.0) * dt * change
        eta[i] = -shape @ rate / G
        b += dt * rate
    return t + 0.5 * dt, eta


def main():
    if len(sys.argv) == 1:
        print("[%s]" % ", ".join("[%.6f, %.6f, 0]" % row for row in zip(*piston())))
        return
    with open(sys.argv[1] + "/fluid_probes.csv") as file:
        rows = list(csv.DictReader(file))
    time = [float(row["t [s]"]) for row in rows]
    t, theory = waves()
    t, theory = t[t <= time[-1]], theory[t <= time[-1]]
    for name, expected in zip(GAUGES, theory.T):
        found = np.interp(t, time, [float(row[name + "_last [m]"]) for row in rows]) - DEPTH
        error = np.sqrt(((found - expected) ** 2).mean() / (expected ** 2).mean())
        report = "gauge %s: elevations of %.4f to %.4f m, theory %.4f to %.4f, differ by %.1f %%" % (
            name, found.min(), found.max(), expected.min(), expected.max(), 100.0 * error)
        print(report)
        assert error < float(sys.argv[2]), report


main()
