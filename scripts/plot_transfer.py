#!/usr/bin/env python3
"""Kinetic energy of a vortex against the number of transfers between random meshes.

Reads the table of bench_vortex (vortex.csv) and writes a PNG beside it.  Needs numpy and matplotlib.
"""
import argparse
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def draw(table, path):
    figure, (energy, loss) = plt.subplots(1, 2, figsize=(11, 4.2))
    for cells in np.unique(table["cells"]):
        rows = table[table["cells"] == cells]
        label = f"{2 * int(cells) ** 2} triangles"
        energy.plot(rows["transfers"], rows["energy"], label=label)
        loss.loglog(rows["transfers"][1:], 1.0 - rows["energy"][1:], label=label)
    energy.set_ylabel("energy / energy at the start")
    loss.set_ylabel("energy lost / energy at the start")
    for axes in energy, loss:
        axes.set_xlabel("transfers")
        axes.grid(True, alpha=0.3)
        axes.legend()
    figure.suptitle("A Taylor vortex transferred between random meshes")
    figure.tight_layout()
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", nargs="?", default="vortex.csv", help="what bench_vortex wrote (vortex.csv)")
    parser.add_argument("-o", "--output", help="the picture (the table's name with .png)")
    arguments = parser.parse_args()
    table = np.genfromtxt(arguments.table, delimiter=",", names=True)
    path = arguments.output or os.path.splitext(arguments.table)[0] + ".png"
    draw(table, path)
    print(path)


if __name__ == "__main__":
    main()
