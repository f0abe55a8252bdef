#!/usr/bin/env python3
"""The disc's speed beside the body-fitted reference of cases/falling_cylinder.  Usage: compare.py RUN

Exit status 1 if it differs by more than 3 % at the end, or from the terminal speed.
"""
import csv
import os
import sys

REFERENCE = os.path.dirname(os.path.abspath(__file__)) + "/../../falling_cylinder/reference/nu0.017173.csv"
TERMINAL = 1.2326  # m/s, closed sides, Re 20: cases/falling_cylinder/README.md


def interpolate(points, t):
    (a, u), (b, v) = next(pair for pair in zip(points, points[1:]) if pair[1][0] >= t)
    return u + (v - u) * (t - a) / (b - a)


def main():
    with open(REFERENCE, encoding="utf-8") as file:
        reference = [(float(row["t[s]"]), float(row["U_fall"])) for row in csv.DictReader(line for line in file if line[0] != "#")]
    with open(sys.argv[1] + "/coupler.csv", encoding="utf-8") as file:
        speed = [(float(row["t [s]"]), -float(row["u_y [m/s]"])) for row in csv.DictReader(file)]
    for t in (0.2, 0.5, 1.0, 2.0, speed[-1][0]):
        u, expected = interpolate(speed, t), interpolate(reference, t)
        print(f"{t:.1f} s: {u:.4f} m/s, reference {expected:.4f}, {100 * (u / expected - 1):+.1f} %")
    print(f"terminal speed {TERMINAL:.4f} m/s: {100 * (u / TERMINAL - 1):+.1f} %")
    sys.exit(not max(abs(u / expected - 1), abs(u / TERMINAL - 1)) < 0.03)


main()
