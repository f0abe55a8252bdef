#!/usr/bin/env python3
"""Mean, amplitude and frequency of the beam's tip: swing.py SOLID_PROBES_CSV [FROM_SECOND].  Needs nothing but Python.

Extremes are those of parabolas through the three largest (smallest) values in a row, so that they do not depend on the rows' spacing.
"""
import csv
import sys


def extremes(t, y):
    """(highest, lowest) of the record, refined by a parabola."""
    found = []
    for sign in (1.0, -1.0):
        k = max(range(1, len(y) - 1), key=lambda i: sign * y[i])
        a, b = y[k - 1] - 2.0 * y[k] + y[k + 1], 0.5 * (y[k + 1] - y[k - 1])
        found.append(y[k] - 0.5 * b * b / a if a else y[k])
    return found


def frequency(t, y, middle):
    """Of upward crossings of the middle, linear between rows."""
    cross = [t[i - 1] + (middle - y[i - 1]) / (y[i] - y[i - 1]) * (t[i] - t[i - 1]) for i in range(1, len(y)) if y[i - 1] < middle <= y[i]]
    return (len(cross) - 1) / (cross[-1] - cross[0]) if len(cross) > 1 else float("nan")


def main():
    start = float(sys.argv[2]) if len(sys.argv) > 2 else 0.0
    with open(sys.argv[1]) as file:
        rows = [r for r in csv.DictReader(file) if float(r["t [s]"]) >= start]
    t = [float(r["t [s]"]) for r in rows]
    for name in ("tip_x [m]", "tip_y [m]"):
        y = [1e3 * float(r[name]) for r in rows]
        high, low = extremes(t, y)
        print("%-10s %8.3f +- %7.3f mm, %.4f Hz" % (name[:5], 0.5 * (high + low), 0.5 * (high - low), frequency(t, y, 0.5 * (high + low))))


main()
