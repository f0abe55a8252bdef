#!/usr/bin/env python3
"""The fragments of a run's solids: how large they are, where they are and how they move, from the snapshots of solid.h5.

Usage: scripts/fragments.py FOLDER [--out FILE.csv] [--png]
Writes FOLDER/fragments.csv (or FILE.csv), a row for each fragment of each snapshot, by time and number:

    t [s], fragment, parent, body, elements, area [m2], size [m], x [m], y [m], u [m/s], v [m/s], omega [rad/s], damage

A fragment keeps its number while it is whole; of one that breaks the largest part keeps it, and the others are new: `parent` is the number that
they had before (their own otherwise).  Area is that at rest, size the diameter of the circle of that area; velocity and rate of turning are
those of the rigid motion with the fragment's momentum and angular momentum; damage is the largest of its elements.  With --png also
fragments.png: the part of the area in fragments smaller than a size, at the end, and the number of fragments in time.  Needs numpy and h5py.
"""
import argparse
import csv
import os
import sys

import numpy as np

from snapshot import Grid, plt, whole_snapshots
import h5py

COLUMNS = ("t [s]", "fragment", "parent", "body", "elements", "area [m2]", "size [m]", "x [m]", "y [m]", "u [m/s]", "v [m/s]", "omega [rad/s]", "damage")
NEAR = 1e-6  # of the bodies' extent: the same element in two snapshots


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class Elements:
    """The triangles of a snapshot in an order that is the same in all: by where they are at rest."""

    def __init__(self, grid):
        points, displacement = grid.points[:, :2], grid.node["displacement"][:, :2]
        rest = (points - displacement)[grid.cells]
        # centres of regular meshes have round numbers: none is where round-off would decide between two keys
        key = np.floor(rest.mean(axis=1) / (NEAR * np.ptp(rest.reshape(-1, 2), axis=0).max()) + np.sqrt(0.5))
        order = np.lexsort(key.T)
        corner = grid.cells[order]
        self.rest, self.x, self.u = rest[order], points[corner], grid.node["velocity"][corner][:, :, :2]
        self.area = 0.5 * cross(self.rest[:, 1] - self.rest[:, 0], self.rest[:, 2] - self.rest[:, 0])
        self.fragment, self.body = (grid.cell[name].ravel()[order].astype(int) for name in ("fragment", "body"))
        self.damage = grid.cell["damage"].ravel()[order]

    def same_as(self, other):
        return len(self.area) == len(other.area) and np.allclose(self.rest.mean(axis=1), other.rest.mean(axis=1), rtol=0.0, atol=NEAR * np.ptp(self.rest))


def numbers(elements, before):
    """The number of each element's fragment, and which one it had before ([elements] both); before: numbers of the last snapshot, or None."""
    _, index = np.unique(elements.fragment, return_inverse=True)
    count = index.max() + 1
    area = np.bincount(index, elements.area)
    first = np.full(count, len(index))
    np.minimum.at(first, index, np.arange(len(index)))
    if before is None:
        number = np.argsort(np.argsort(first))
        return number[index], number[index]
    parent, number, free = before[first], np.full(count, -1), before.max() + 1
    for k in np.lexsort((first, -area)):  # the largest part of each parent first
        if parent[k] not in number:
            number[k] = parent[k]
        else:
            number[k], free = free, free + 1
    return number[index], parent[index]


def rows(t, elements, number, parent):
    """A row of COLUMNS for each fragment."""
    weight = elements.area / 3.0
    for n in np.unique(number):
        mine = number == n
        m = np.repeat(weight[mine], 3)  # of the corners
        x, u = elements.x[mine].reshape(-1, 2), elements.u[mine].reshape(-1, 2)
        area = elements.area[mine].sum()
        centre, velocity = m @ x / area, m @ u / area
        arm = x - centre
        omega = (m * cross(arm, u - velocity)).sum() / (m * (arm**2).sum(axis=1)).sum()
        k = np.flatnonzero(mine)[0]
        yield (t, n, parent[k], elements.body[k], mine.sum(), area, np.sqrt(4.0 * area / np.pi), *centre, *velocity, omega, elements.damage[mine].max())


def fragments(path):
    """All rows; LookupError where there is nothing to tell."""
    table, before, last = [], None, None
    with h5py.File(path, "r") as file:
        snapshots, times = whole_snapshots(file, path)
        for t, group in zip(times, snapshots):
            grid = Grid(group["solid"])
            if len(grid.cells) == 0:
                raise LookupError(f"{path}: the run has no bodies")
            elements = Elements(grid)
            if last is not None and not elements.same_as(last):
                raise LookupError(f"{path}: the elements at t = {t:g} s are not those of the snapshot before")
            before, parent = numbers(elements, before)
            table += rows(t, elements, before, parent)
            last = elements
    return table


def draw(table, path):
    t, number, size, area = (np.array([row[k] for row in table]) for k in (0, 1, 6, 5))
    end = t == t.max()
    order = np.argsort(size[end])
    smaller = np.cumsum(area[end][order]) / area[end].sum()
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    left.step(size[end][order], smaller, where="post")
    left.set(xscale="log", xlabel="size, m", ylabel="part of the area in fragments no larger", ylim=(0.0, 1.02), title=f"t = {t.max():g} s, {end.sum()} fragments")
    times, count = np.unique(t, return_counts=True)
    right.step(times, count, where="post")
    right.set(xlabel="t, s", ylabel="fragments")
    figure.savefig(path, dpi=150)
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--out")
    parser.add_argument("--png", action="store_true")
    options = parser.parse_args()
    try:
        table = fragments(os.path.join(options.folder, "solid.h5"))
    except (LookupError, OSError) as error:
        sys.exit(f"fragments.py: {error}")
    path = options.out or os.path.join(options.folder, "fragments.csv")
    with open(path, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(COLUMNS)
        out.writerows([f"{value:.10g}" for value in row] for row in table)
    print(path)
    if options.png:
        draw(table, os.path.splitext(path)[0] + ".png")


if __name__ == "__main__":
    main()
