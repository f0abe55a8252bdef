#!/usr/bin/python3
"""Runs the moored platform on several meshes, and the flume without it, and writes its table.

    cases/floating_platform/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/floating_platform/<name>; delete the folder to run it again).  --only takes
names with wildcards.  --table only prints the table of what has been run, --readme also puts it into README.md, --check exits with 1
when a number is out of its bounds.  A platform's row needs the row of its mesh without it, waves-...  Needs numpy.
"""
import pathlib

from moored import SPEED, Flume, Moored, theory  # puts scripts/ on the path
import phases
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "floating_platform"


def size(le, dt, error):
    return ["fluid.adapt.size_min=%g" % le, "time.dt_max=%g" % dt, "fluid.adapt.velocity_error=%g" % error]


FINE = size(0.009, 0.007, 0.014)
COARSE = size(0.025, 0.02, 0.04)


def piston(speed):
    return ("{shape: rectangle, centre: [0.3, 0.38], width: 0.1, height: 0.75, size: 0.05, material: steel, "
            "prescribed: [{velocity: [%g, 0.0], period: 1.2, rise: 2.4}]}" % speed)


def empty(speed):
    return ["solid.bodies=[%s]" % piston(speed), "solid.springs=[]"]


EMPTY = empty(SPEED)
# name: (keys other than case.yaml's, ranks)
RUNS = {
    "waves-0.025": (COARSE + EMPTY, "1:1:1"),
    "waves-0.0125": (EMPTY, "1:1:1"),
    "waves-0.009": (FINE + EMPTY, "1:1:1"),
    "le-0.025": (COARSE, "1:1:1"),
    "le-0.0125": ([], "1:1:1"),
    "le-0.009": (FINE, "1:1:1"),
    "waves-half": (empty(0.5 * SPEED), "1:1:1"),
    "half": (["solid.bodies[0]=" + piston(0.5 * SPEED)], "1:1:1"),
    "ranks-2": ([], "2:1:2"),
}


def run(name):
    validation.run(HERE, OUT / name, *RUNS[name])


def waves_of(name):
    return "waves-" + (name.split("-")[1] if name.startswith("le-") else "half" if name == "half" else "0.0125")


def results(names):
    there = phases.results(OUT, [name for name in names if name.startswith("waves")], Flume)
    for name in names:
        if not name.startswith("waves") and waves_of(name) in there:
            there.update(phases.results(OUT, [name], lambda folder: Moored(folder, there[waves_of(folder.name)])))
    return there


def flume(there):
    expected = theory()
    columns = ("wave's amplitude at the platform's place [mm]", "of that of the piston by theory", "wave length [m]", "by theory", "reflected by the beach")
    return phases.table({name: r for name, r in there.items() if name.startswith("waves")}, columns,
                        lambda r: ["%.2f" % (1000.0 * abs(r.incident)), "%.3f" % (abs(r.incident) / r.piston), "%.3f" % r.length,
                                   "%.3f" % expected.length, "%.1f %%" % (100.0 * r.reflected)])


MOTIONS = ("sway", "heave", "roll")


def platform(there):
    def polar(r):
        return ["%.3f, %+.0f" % r.polar(m) for m in MOTIONS]
    columns = (*("%s, degrees" % m for m in MOTIONS), "drift [m]", "tension, windward [N/m]", "lee [N/m]")
    lines = list(phases.table({name: r for name, r in there.items() if not name.startswith("waves")}, columns,
                              lambda r: [*polar(r), "%.3f" % r.drift, *("%.1f to %.1f" % r.tension[line] for line in ("windward", "lee"))]))
    blank = " |" * (lines[0].count("|") - 2 - len(MOTIONS))
    return [*lines[:2], "| **potential theory** | " + " | ".join(polar(theory())) + " |" + blank, *lines[2:]]


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    expected = theory()
    for name, r in there.items():
        yield from phases.claims(name, r)
        if name.startswith("waves"):
            yield name + ": wave length, relative", abs(r.length / expected.length - 1.0), 0.02
            yield name + ": reflected by the beach", r.reflected, 0.05
        elif name not in ("le-0.025", "half"):
            for m, bound in zip(MOTIONS, (0.05, 0.05, 0.15)):  # roll: it has not yet lost its free oscillation, README.md
                yield "%s: %s, relative" % (name, m), abs(r.polar(m)[0] / expected.polar(m)[0] - 1.0), bound


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"flume": flume, "runs": platform}, claims)
