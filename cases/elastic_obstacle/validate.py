#!/usr/bin/python3
"""Runs the elastic obstacle on several meshes, ranks and floors, and writes its table.

    cases/elastic_obstacle/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/elastic_obstacle/<name>; delete the folder to run it again).  --only
takes names with wildcards.  --table only prints the table of what has been run, --readme also puts it into README.md, --check exits
with 1 when a number is out of its bounds.  Needs numpy and h5py.
"""
import pathlib

from obstacle import CODES, Obstacle, first_swing, reference  # puts scripts/ on the path
import phases
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "elastic_obstacle"
SWING = ["time.end=0.4"]  # the first swing
NO_SLIP = ["fluid.boundaries.%s=no_slip" % side for side in ("left", "right", "bottom")]
# name: (keys other than case.yaml's, ranks)
RUNS = {
    "le-0.006": ([], "1:1:1"),
    "le-0.009": (SWING + ["fluid.adapt.size_min=0.009", "fluid.adapt.velocity_error=0.12"], "1:1:1"),
    "le-0.004": (SWING + ["fluid.adapt.size_min=0.004", "fluid.adapt.velocity_error=0.053"], "1:1:1"),
    "no-slip": (SWING + NO_SLIP, "1:1:1"),
    "solid-0.002": (SWING + ["solid.bodies[0].size=0.002"], "1:1:1"),
    "solid-three-0.001": (SWING + ["solid.bodies[0].order=1", "solid.bodies[0].size=0.001"], "1:1:1"),
    "dt-half": (SWING + ["time.dt_max=0.0005", "time.cfl=0.25"], "1:1:1"),
    "ranks-2": (SWING, "2:1:2"),
}


def run(name):
    validation.run(HERE, OUT / name, *RUNS[name])


def results(names):
    return phases.results(OUT, names, Obstacle)


def cells(front, swing):
    return ["%.3f" % front if front else "", "%.1f" % (1e3 * swing[0]), *("%.3f" % t for t in swing[1:])]


def table(there):
    columns = ("front 12 mm before the wall [s]", "largest displacement [mm]", "at [s]", "half of it from [s]", "to [s]")
    lines = list(phases.table(there, columns, lambda r: cells(r.front, r.swing)))
    codes = reference()
    published = ["| " + " | ".join([name.capitalize(), *cells(None, first_swing(codes["t"], codes[name])), *[""] * 7]) + " |" for name in CODES]
    return lines[:2] + published + lines[2:]


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    codes = reference()
    swings = [first_swing(codes["t"], codes[name]) for name in CODES]
    for name, r in there.items():
        yield from phases.claims(name, r)
        if name == "le-0.009":  # 1.3 elements of the fluid through the wall
            continue
        for k, what in enumerate(("largest displacement", "its time", "half of it from", "half of it to")):
            low, high = min(s[k] for s in swings), max(s[k] for s in swings)
            yield "%s: %s, out of the published curves', of it" % (name, what), max(low / r.swing[k], r.swing[k] / high) - 1.0, 0.05


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"runs": table}, claims)
