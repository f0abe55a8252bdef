"""What the runs of a test have left; sys.argv[1] is the folder in which each has its own (run.sh)."""
import csv
import json
import sys


def rows(label, name):
    """The rows of a series by the names of its columns: rows("one", "fluid")[-1]["t [s]"]."""
    with open("%s/%s/%s.csv" % (sys.argv[1], label, name)) as file:
        return [{column: float(value) for column, value in row.items()} for row in csv.DictReader(file)]


def column(label, name, key):
    """One column of it."""
    return [row[key] for row in rows(label, name)]


def summary(label):
    with open("%s/%s/summary.json" % (sys.argv[1], label)) as file:
        return json.load(file)


def snapshots(label):
    """Of each snapshot of the fluid: its name, corners [n][3][2] and areas [n] of its elements, and the grid, of which
    ["cell/alpha"][:] is what a solid has of them."""
    import h5py
    grid = h5py.File("%s/%s/fluid.h5" % (sys.argv[1], label))["snapshot"]
    for key in sorted(grid):
        velocity = grid[key]["velocity"]
        if "points" in velocity:
            corners = velocity["points"][:][velocity["cells"][:]]
        b, c = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        yield key, corners, 0.5 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]), velocity
