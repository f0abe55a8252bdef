#!/usr/bin/env python3
"""Compares the last rows of coupler.csv of two runs.  Usage: compare.py RUN REFERENCE TOLERANCE [COLUMN]...

TOLERANCE is relative; COLUMN defaults to "u_y [m/s]", the solid's mean velocity.  Exit status 1 if one differs by more.
"""
import csv
import sys


def last(folder):
    with open(folder + "/coupler.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))[-1]


def main():
    run, reference, tolerance = sys.argv[1], sys.argv[2], float(sys.argv[3])
    rows, status = (last(run), last(reference)), 0
    if abs(float(rows[0]["t [s]"]) - float(rows[1]["t [s]"])) > 1e-9:
        sys.exit("the runs end at different times")
    for column in sys.argv[4:] or ["u_y [m/s]"]:
        a, b = (float(row[column]) for row in rows)
        difference = abs(a - b) / abs(b)
        print(f"{column}: {a:g}, reference {b:g}, difference {difference:.2g}")
        if not difference <= tolerance:
            status = 1
    sys.exit(status)


main()
