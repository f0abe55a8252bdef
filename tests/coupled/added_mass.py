"""A disc in a closed box of fluid that is at rest and nearly inviscid: its first acceleration and its frequency on a spring, against
potential flow in the same box.  Usage: added_mass.py FOLDER; the runs of added_mass.sh are FOLDER/fall-RATIO, FOLDER/spring-RATIO
and FOLDER/elastic-RATIO.
added_mass.py --stiffness RATIO prints the spring's stiffness, N/m a metre, for one period a second."""
import csv
import math
import sys

import numpy as np

BOX, RADIUS, RHO, GRAVITY = 0.75, 0.125, 1000.0, 9.81
ACCELERATION, FREQUENCY = 0.01, 0.01  # the bounds, relative


def coefficient(n=400):
    """Added mass over displaced mass of a disc of RADIUS in the middle of a square BOX: the potential of fluid between both
    by constant panels (Green's third identity; n panels on each), dphi/dn = n_y on the disc and 0 on the walls."""
    angle = 2.0 * np.pi * np.arange(n) / n
    disc = BOX / 2 + RADIUS * np.c_[np.cos(-angle), np.sin(-angle)]  # fluid on the left of all panels
    corner = BOX * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    walls = np.concatenate([corner[k] + (corner[(k + 1) % 4] - corner[k]) * np.arange(n // 4)[:, None] / (n // 4) for k in range(4)])
    start = np.concatenate([disc, walls])
    along = np.concatenate([np.roll(disc, -1, 0), np.roll(walls, -1, 0)]) - start
    length = np.hypot(along[:, 0], along[:, 1])
    along /= length[:, None]
    normal = np.c_[along[:, 1], -along[:, 0]]
    to = (start + 0.5 * along * length[:, None])[:, None] - start[None]
    x, y = np.einsum("ijk,jk->ij", to, along), np.einsum("ijk,jk->ij", to, normal)
    from_end, away = x - length, np.abs(y)

    def log_integral(s):
        return 0.5 * s * np.log(s * s + y * y) - s + away * np.arctan2(s, away)

    single = log_integral(x) - log_integral(from_end)
    double = -np.sign(y) * (np.arctan2(x, away) - np.arctan2(from_end, away))
    np.fill_diagonal(double, 0.0)
    slope = np.where(np.arange(len(start)) < n, normal[:, 1], 0.0)
    matrix = np.vstack([np.pi * np.eye(len(start)) - double, np.ones(len(start))])  # the potential's mean is free
    phi = np.linalg.lstsq(matrix, np.append(-single @ slope, 0.0), rcond=None)[0]
    return float(np.sum(phi * slope * length)) / (math.pi * RADIUS**2)


def series(folder):
    rows = list(csv.DictReader(open("%s/coupler.csv" % folder)))
    return [float(r["t [s]"]) for r in rows], [float(r["u_y [m/s]"]) for r in rows]


def main():
    added = coefficient()
    if sys.argv[1] == "--stiffness":
        print(math.pi * RADIUS**2 * RHO * (float(sys.argv[2]) + added) * (2.0 * math.pi) ** 2)
        return
    failed = False
    for ratio in (0.05, 0.5, 2.0):
        t, u = series("%s/fall-%g" % (sys.argv[1], ratio))
        error = u[0] / t[0] / ((1.0 - ratio) * GRAVITY / (ratio + added)) - 1.0
        print("ratio %g: first acceleration %+.2f %%" % (ratio, 100 * error))
        failed |= abs(error) > ACCELERATION
    for disc, ratio in ("spring", 0.5), ("spring", 2.0), ("elastic", 2.0):
        t, u = series("%s/%s-%g" % (sys.argv[1], disc, ratio))
        zero = [a - (b - a) * p / (q - p) for a, b, p, q in zip(t, t[1:], u, u[1:]) if p * q < 0]
        error = (len(zero) - 1) / (2.0 * (zero[-1] - zero[0])) - 1.0
        print("ratio %g: frequency on a spring (%s) %+.2f %% over %g periods" % (ratio, disc, 100 * error, (len(zero) - 1) / 2))
        failed |= abs(error) > FREQUENCY or len(zero) < 3
    sys.exit(failed)


main()
