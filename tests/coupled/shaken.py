"""Water in a tank in the frame of its ground, which is shaken, by linear potential theory, and a run beside it.

    shaken.py surface FOLDER LENGTH GRAVITY MOST   the run's gauges: root mean square of the difference over that of the waves, at most MOST
    shaken.py dam FOLDER LENGTH GRAVITY MOST       likewise the force on the body 0 at the water's right end, less that before gravity has an x

LENGTH of the water, m; GRAVITY: rows of time, x and y, as in the case.  Of water of depth D at rest between walls at x = 0 and L, with
gravity (q(t), -G) and x - L/2 = sum X_n cos k_n x:

    eta = sum b_n cos k_n x,    k_n = n pi/L, n odd,    b_n'' + w_n^2 b_n = k_n tanh(k_n D) X_n q,    w_n^2 = G k_n tanh k_n D,    X_n = - 4 L/(n pi)^2
    force on the wall at L, less D^2/2 rho G:    rho (q D L/2 - sum (G b_n - q X_n) tanh(k_n D)/k_n)

at first, for L >> D, 0.543 rho q D^2 (Westergaard, incompressible).
"""
import csv
import json
import sys

import numpy as np

DEPTH, G, RHO = 0.3, 9.81, 1000.0  # m, m/s2, kg/m3
GAUGES = {"wall": 0.01, "opposite": 0.99}  # over the length
MODES, SUBSTEP = 100, 1e-3


def modes(length):
    n = 2 * np.arange(MODES) + 1
    k = n * np.pi / length
    return k, -4.0 * length / (n * np.pi) ** 2, np.sqrt(G * k * np.tanh(k * DEPTH))


def amplitudes(t, length, rows):
    """b_n at the times t[], by exact steps with q linear in each."""
    k, x_n, w = modes(length)
    end, b, rate, now, found = t[-1], np.zeros(MODES), np.zeros(MODES), 0.0, np.zeros((len(t), MODES))
    times = np.unique(np.concatenate([t, rows[:, 0], np.arange(0.0, end, SUBSTEP)]))
    load = k * np.tanh(k * DEPTH) * x_n
    for to in times[(times > 0.0) & (times <= end)]:
        h, q = to - now, [np.interp(s, rows[:, 0], rows[:, 1]) for s in (now + 1e-12, to - 1e-12)]
        slope = load * (q[1] - q[0]) / (h * w ** 2)
        c = b - load * q[0] / w ** 2
        s = (rate - slope) / w
        b = c * np.cos(w * h) + s * np.sin(w * h) + load * q[1] / w ** 2
        rate = w * (s * np.cos(w * h) - c * np.sin(w * h)) + slope
        now = to
        found[np.isclose(t, to, atol=1e-12)] = b
    return found


def compare(name, expected, found, most, unit):
    error = np.sqrt(((found - expected) ** 2).mean() / (expected ** 2).mean())
    report = "%s: from %.4g to %.4g %s, theory %.4g to %.4g, differ by %.1f %%" % (
        name, found.min(), found.max(), unit, expected.min(), expected.max(), 100.0 * error)
    print(report)
    assert error < most, report


def column(folder, file, name):
    with open("%s/%s.csv" % (folder, file)) as series:
        return np.array([float(row[name]) for row in csv.DictReader(series)])


def main():
    what, folder, length, most = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[5])
    rows = np.array(json.loads(sys.argv[4]))
    k, x_n, w = modes(length)
    if what == "surface":
        t = column(folder, "fluid_probes", "t [s]")
        b = amplitudes(t, length, rows)
        for name, place in GAUGES.items():
            compare("gauge " + name, (b * np.cos(k * place * length)).sum(1), column(folder, "fluid_probes", name + "_last [m]") - DEPTH, most, "m")
        return
    t = column(folder, "solid", "t [s]")
    middle = 0.5 * (t + np.concatenate([[0.0], t[:-1]]))  # a step has its mean
    b, q = amplitudes(middle, length, rows), np.interp(middle, rows[:, 0], rows[:, 1])
    expected = RHO * (0.5 * q * DEPTH * length - ((G * b - q[:, None] * x_n) * np.tanh(k * DEPTH) / k).sum(1))
    acts = q > 0.0
    found = column(folder, "solid", "fx0 [N/m]")
    found -= found[~acts][-1]
    first, wanted = (f[acts][0] / (RHO * q[acts][0] * DEPTH ** 2) for f in (found, expected))
    print("at first %.3f rho q D^2, of %.3f" % (first, wanted))
    assert abs(first / wanted - 1.0) < 0.02
    compare("force", expected[acts], found[acts], most, "N/m")


main()
