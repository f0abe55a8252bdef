#!/usr/bin/python3
"""Runs the floating square on several meshes and ranks, and writes its table.

    cases/floating_square/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/floating_square/<name>; delete the folder to run it again).  --only takes
names with wildcards.  --table only prints the table of what has been run, --readme also puts it into README.md, --check exits with 1
when a number is out of its bounds.  Needs numpy, h5py and matplotlib.
"""
import pathlib

from floating import PAPER, Floating  # puts scripts/ on the path
import phases
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "floating_square"


def size(le, dt, error):
    return ["fluid.adapt.size_min=%g" % le, "time.dt_max=%g" % dt, "fluid.adapt.velocity_error=%g" % error]


COARSE = size(0.008, 0.001, 0.1) + ["time.end=0.5"]
# name: (keys other than case.yaml's, ranks)
RUNS = {
    "le-0.008": (COARSE, "1:1:1"),
    "le-0.004": ([], "1:1:1"),
    "le-0.002": (size(0.002, 0.00025, 0.03), "2:1:1"),
    "ranks-2": (COARSE, "2:1:2"),
}


def run(name):
    validation.run(HERE, OUT / name, *RUNS[name])


def results(names):
    return phases.results(OUT, names, Floating)


def table(there):
    columns = ("wet at 0.150 s", "afloat [s]", *("%s, %.3f s" % (what, t) for what, t in PAPER.items()), "square at 0.35 s [m]")
    return phases.table(there, columns, lambda r: ["%.2f" % r.sinking, "%.3f" % r.afloat, *("%.3f" % r.measured[what] for what in PAPER),
                                                   "(%.3f, %.3f)" % r.at(0.35)])


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    for name, r in there.items():
        yield from phases.claims(name, r)
    for name in ("le-0.004", "le-0.002"):
        if name in there:
            for what, t in PAPER.items():
                yield name + ": " + what + ", relative", abs(there[name].measured[what] / t - 1.0), 0.05


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"runs": table}, claims)
