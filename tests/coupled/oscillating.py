"""The force on a cylinder that swings in a fluid at rest, beside the experiment and computation of H. Duetsch, F. Durst, S. Becker and
H. Lienhart, Low-Reynolds-number flow around an oscillating circular cylinder at low Keulegan-Carpenter numbers, J. Fluid Mech. 360
(1998) 249-271 (quoted from memory): KC 5, Re 100, and in Morison's equation

    F = -1/2 rho D C_d |U| U - 1/4 pi rho D^2 C_i dU/dt        C_d = 2.09, C_i = 1.45

    oscillating.py               the prescribed motion, as a value for --set
    oscillating.py FOLDER        checks the run's second period
"""
import csv
import sys

import numpy as np

D, SPEED, PERIOD, RHO = 0.1, 0.1, 5.0, 1000.0
OMEGA = 2.0 * np.pi / PERIOD


def main():
    if len(sys.argv) == 1:
        t = np.linspace(0.0, 2.0 * PERIOD, 201)
        print("[%s]" % ", ".join("[%.6f, %.8f, 0]" % row for row in zip(t, -SPEED * np.cos(OMEGA * t))))
        return
    with open(sys.argv[1] + "/solid.csv") as file:
        rows = list(csv.DictReader(file))
    t, force = (np.array([float(row[name]) for row in rows]) for name in ("t [s]", "fx0 [N/m]"))
    t, force = t[t > PERIOD], force[t > PERIOD]
    u, rate = -SPEED * np.cos(OMEGA * t), SPEED * OMEGA * np.sin(OMEGA * t)
    terms = np.stack([-0.5 * RHO * D * abs(u) * u, -0.25 * np.pi * RHO * D * D * rate], 1)
    weight = np.sqrt(np.gradient(t))
    drag, inertia = np.linalg.lstsq(terms * weight[:, None], force * weight, rcond=None)[0]
    rest = np.sqrt(((terms @ (drag, inertia) - force) ** 2).mean()) / abs(force).max()
    report = "C_d %.3f of 2.09, C_i %.3f of 1.45, Morison's equation within %.1f %% of the largest force" % (drag, inertia, 100.0 * rest)
    print(report)
    assert abs(drag / 2.09 - 1.0) < 0.03 and abs(inertia / 1.45 - 1.0) < 0.06 and rest < 0.1, report


main()
