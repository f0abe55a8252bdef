#!/usr/bin/python3
"""Runs the collapsing column on several meshes, ranks and floors, and writes its table.

    cases/collapsing_column/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/collapsing_column/<name>; delete the folder to run it again).  --only
takes names with wildcards.  --table only prints the table of what has been run, --readme also puts it into README.md, --check exits
with 1 when a number is out of its bounds.  Needs numpy and h5py.
"""
import pathlib

from column import GAUGES, PAPER, Column  # puts scripts/ on the path
import phases
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "collapsing_column"


def size(le, dt, error):
    return ["fluid.adapt.size_min=%g" % le, "time.dt_max=%g" % dt, "fluid.adapt.velocity_error=%g" % error]


COARSE = size(0.008, 0.001, 0.1) + ["time.end=0.65"]


def gate(speed):
    """A plate 12 mm thick beside the column, 1 mm above the floor, drawn up through the open top at this speed, m/s."""
    return ["solid.bodies[1]={shape: rectangle, centre: [0.156, 0.2], width: 0.012, height: 0.398, size: 0.012, material: square, "
            "prescribed: [{velocity: [0, %g]}]}" % speed]


# name: (keys other than case.yaml's, ranks)
RUNS = {
    "le-0.008": (COARSE, "1:1:1"),
    "le-0.004": (["time.end=0.65"], "1:1:1"),
    "le-0.002": (size(0.002, 0.00025, 0.03) + ["time.end=0.65"], "2:1:1"),
    "ranks-2": (COARSE, "2:1:2"),
    "ranks-3": (COARSE, "3:2:3"),
    "gate-2": (COARSE + gate(2.0), "1:1:1"),
    "gate-1.5": (COARSE + gate(1.5), "1:1:1"),
    "gate-1.5-0.004": (["time.end=0.65"] + gate(1.5), "1:1:1"),
    "gate-1.25": (COARSE + gate(1.25), "1:1:1"),
    "gate-1": (COARSE + gate(1.0), "1:1:1"),
    "gate-0.75": (COARSE + gate(0.75), "1:1:1"),
    "friction-0.1": (COARSE + ["solid.materials.square.friction=0.1"], "1:1:1"),
    "friction-0.2": (COARSE + ["solid.materials.square.friction=0.2"], "1:1:1"),
}


def run(name):
    validation.run(HERE, OUT / name, *RUNS[name])


def results(names):
    return phases.results(OUT, names, Column)


def table(there):
    columns = ("front at the square [s]", "square at the wall [s]", "its speed [m/s]", *("%s, at" % g for g in GAUGES))
    return phases.table(there, columns, lambda r: ["%.3f" % r.reaches_square, "%.3f" % r.reaches_wall, "%.3f" % r.speed,
                                                   *("%.1f, %.3f s" % r.peak(g) for g in GAUGES)])


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    for name, r in there.items():
        yield from phases.claims(name, r)
    for name in ("le-0.004", "le-0.002"):
        if name in there:
            yield name + ": front at the square, s off 0.36 without gate", abs(there[name].reaches_square - 0.36), 0.01
    for name in ("gate-1.5", "gate-1"):
        if name in there:
            yield name + ": front at the square, s off the paper's", abs(there[name].reaches_square - PAPER["front"]), 0.01
            yield name + ": square at the wall, s off 0.61 .. 0.64", abs(there[name].reaches_wall - 0.625), 0.015
    coarse = there.get("le-0.008")
    for name in ("ranks-2", "ranks-3"):
        if name in there and coarse:
            yield name + ": front at the square as on one rank, s", abs(there[name].reaches_square - coarse.reaches_square), 0.002


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"runs": table}, claims)
