"""A tank whose left side is open to water of a level that depends on time, by linear potential theory, and a run beside it.

    level.py FOLDER LENGTH LEVEL MOST   checks the run's gauges: root mean square of the difference over that of the waves, at most MOST

LENGTH of the tank, m; LEVEL: rows of time and height, as in the case.  Water of depth D at rest between x = 0, where the pressure is that of
water at rest up to the level, and a wall at L:

    eta = level - D + sum b_n sin k_n x,    k_n = (n + 1/2) pi/L,    b_n'' + w_n^2 b_n = -2/(k_n L) level'',    w_n^2 = g k_n tanh k_n D

level'' is the sum over the rows of the change of slope there.
"""
import csv
import json
import sys

import numpy as np

DEPTH, G = 0.3, 9.81  # m, m/s2
GAUGES = {"near": 0.25, "far": 0.75}  # over the length


def elevation(t, x, length, rows, modes=400):
    """eta at x, m, at the times t[], s."""
    k = (np.arange(modes) + 0.5) * np.pi / length
    w = np.sqrt(G * k * np.tanh(k * DEPTH))
    slope = np.concatenate([[0.0], np.diff(rows[:, 1]) / np.diff(rows[:, 0]), [0.0]])
    eta = np.interp(t, *rows.T) - DEPTH
    for start, change in zip(rows[:, 0], np.diff(slope)):
        since = np.maximum(t - start, 0.0)
        eta -= change * (np.sin(np.outer(since, w)) / w * 2.0 / (k * length) * np.sin(k * x)).sum(1)
    return eta


def main():
    folder, length, rows, most = sys.argv[1], float(sys.argv[2]), np.array(json.loads(sys.argv[3])), float(sys.argv[4])
    with open(folder + "/fluid_probes.csv") as file:
        series = list(csv.DictReader(file))
    t = np.array([float(row["t [s]"]) for row in series])
    third = []  # when the elevation has a third of its last value: in an infinite tank that of a step moves with sqrt(g D) (the integral of Airy's function)
    for name, place in GAUGES.items():
        expected = elevation(t, place * length, length, rows)
        found = np.array([float(row[name + "_last [m]"]) for row in series]) - DEPTH
        error = np.sqrt(((found - expected) ** 2).mean() / (expected ** 2).mean())
        report = "gauge %s: elevations of %.4f to %.4f m, theory %.4f to %.4f, differ by %.1f %%" % (
            name, found.min(), found.max(), expected.min(), expected.max(), 100.0 * error)
        print(report)
        assert error < most, report
        third.append(np.interp((rows[-1, 1] - DEPTH) / 3.0, found, t) if rows[-1, 1] > DEPTH else 0.0)
    if third[0] > 0.0:  # a front, on its way to the wall
        speed = 0.5 * length / (third[1] - third[0]) / np.sqrt(G * DEPTH)
        print("the front's speed is %.3f sqrt(g D)" % speed)
        assert abs(speed - 1.0) < 0.03, "the front's speed is %g sqrt(g D)" % speed


main()
