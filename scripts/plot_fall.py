#!/usr/bin/env python3
"""Fall speed against time: a run's solid.csv beside reference curves and terminal speeds.

Writes OUTPUT_FOLDER/fall.png.  Needs numpy and matplotlib.
"""
import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def read_table(path):
    """Columns of a CSV file by name; the names stand in the last line before the numbers, '#' or not."""
    names, rows = None, []
    try:
        with open(path) as file:
            lines = [line for line in file if line.endswith("\n")]  # the last row of a running case may be half written
    except OSError as error:
        sys.exit(f"plot_fall: {path}: {error.strerror}")
    for line in lines:
        fields = line.strip().lstrip("#").split(",")
        try:
            rows.append([float(field) for field in fields])
        except ValueError:
            if not rows and line.strip():
                names = [field.strip() for field in fields]
    if names is None or not rows:
        sys.exit(f"plot_fall: {path} has {'no rows' if names else 'no line with column names'}")
    rows = [row for row in rows if len(row) == len(names)]
    return dict(zip(names, np.array(rows).T))


def column(table, path, *candidates):
    """The first of the candidate names that the table has, with or without its unit."""
    for wanted in candidates:
        for name, values in table.items():
            if name == wanted or name.split("[")[0].strip() == wanted:
                return values
    sys.exit(f"plot_fall: {path} has none of the columns {', '.join(candidates)}: it has {', '.join(table)}")


def fall_speed(path):
    """Time and downward speed of body 0."""
    table = read_table(path)
    t = column(table, path, "t")
    v = column(table, path, "v", "v0", "v 0", "body 0 v")
    first = table["body"] == 0 if "body" in table else np.full(len(t), True)
    return t[first], -v[first]


def terminal(text):
    name, equal, value = text.rpartition("=")
    try:
        return name, float(value if equal else "")
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected NAME=VALUE with a value in m/s, found '{text}'")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="output folder of the run, with solid.csv")
    parser.add_argument("--reference", action="append", default=[], metavar="FILE", help="CSV with columns t and U_fall")
    parser.add_argument("--terminal", action="append", default=[], type=terminal, metavar="NAME=VALUE", help="terminal speed, m/s")
    parser.add_argument("--out", help="picture (default FOLDER/fall.png)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    t, speed = fall_speed(os.path.join(arguments.folder, "solid.csv"))
    for path in arguments.reference:
        table = read_table(path)
        name = os.path.splitext(os.path.basename(path))[0]
        axes.plot(column(table, path, "t"), column(table, path, "U_fall"), "--", color="k", linewidth=1.0, zorder=3,
                  label=f"reference {name}")
    for k, (name, value) in enumerate(arguments.terminal):
        axes.axhline(value, color=f"C{k + 1}", linewidth=0.8, label=f"{name}: {value:.4g} m/s")
    axes.plot(t, speed, color="C0", label=f"Coracle, {speed[-1]:.4f} m/s at {t[-1]:.3g} s")
    axes.set(xlabel="t [s]", ylabel="fall speed [m/s]", xlim=(0.0, 1.05 * max(t[-1], 1e-12)), ylim=(min(0.0, speed.min()), None))
    axes.legend(loc="lower right", frameon=False)
    path = arguments.out or os.path.join(arguments.folder, "fall.png")
    figure.savefig(path, dpi=150)
    print(path)


if __name__ == "__main__":
    main()
