#!/usr/bin/python3
"""Runs the rising bubble on several meshes, ranks and steps, and writes its tables.

    cases/rising_bubble/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/rising_bubble/<name>; delete the folder to run it again).  --only takes
names with wildcards.  --table only prints the tables of what has been run, --readme also puts them into README.md, --check exits with 1
when a number is out of its bounds.  Needs numpy and h5py.
"""
import json
import pathlib

from bubble import CODES, RANGES, TEST_2, Bubble  # puts scripts/ on the path
import phases
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "rising_bubble"


def cells(n):
    """le = 1/n m, and the velocity's error to it."""
    return ["fluid.adapt.size_min=%.6g" % (1.0 / n)] + ["fluid.adapt.%s=%.3g" % (key, 0.16 / n) for key in ("velocity_error", "light_velocity_error")]


# name: (keys other than case.yaml's, ranks)
RUNS = {
    "1/le-40": (cells(40), "1:1:1"),
    "1/le-80": ([], "1:1:1"),
    "1/le-160": (cells(160), "1:1:1"),
    "ranks-2": (cells(40), "2:1:1"),
    "ranks-3": (cells(40), "3:1:1"),
    "dt-half": (cells(40) + ["fluid.capillary_cfl=0.2", "time.cfl=0.25"], "1:1:1"),
    "test-2-1/le-80": (TEST_2, "1:1:1"),
}
COARSEST, FINEST = "1/le-40", "1/le-160"


def folder(name):
    return OUT / name.replace("/", "")


def run(name):
    validation.run(HERE, folder(name), RUNS[name][0] + ["case=rising_bubble"], RUNS[name][1])


class Result:
    """What a run has left behind."""

    def __init__(self, name):
        path = folder(name)
        self.bubble = Bubble(path)
        fluid = phases.read_series(path / "fluid.csv")
        self.triangles, self.steps = int(fluid["triangles"].max()), len(fluid["t"])
        parts = json.load(open(path / "summary.json"))["participants"].values()
        self.cpu = sum(p["seconds_cpu"] for p in parts)


def results(names):
    return {name: Result(name) for name in names if (folder(name) / "summary.json").exists()}


def table(there):
    yield ("| run | least circularity | greatest rise velocity | at | centre at 3 s | circularity against MooNMD | centre | velocity | area lost | triangles | "
           "steps | cost |")
    yield "|" + "---|" * 12
    yield "| three codes | %s | %s | 0.921 .. 0.931 | %s |%s" % (*("%.4f .. %.4f" % RANGES[key] for key in RANGES), " |" * 7)
    for name, r in there.items():
        if name.startswith("test-2"):
            continue
        b = r.bubble
        yield "| " + " | ".join([name, "%.4f" % b.least, "%.4f" % b.fastest(0, 3)[0], "%.3f" % b.fastest(0, 3)[1], "%.4f" % b.y[-1],
                                 *("%.2f %%" % (100.0 * d) for d in b.differences()), "%.0e" % abs(b.area[-1] / b.area[0] - 1.0),
                                 str(r.triangles), str(r.steps), validation.cost(there, name, COARSEST)]) + " |"


def table_2(there):
    yield "| test 2 | least circularity | greatest rise velocity | at | second maximum | at | centre at 3 s |"
    yield "|" + "---|" * 7
    for code, values in CODES.items():
        yield "| %s | %s |" % (code, " | ".join("%.4f" % v for v in values))
    for name, r in there.items():
        if name.startswith("test-2"):
            b = r.bubble
            values = (b.least, *b.fastest(0.0, 1.3), *b.fastest(1.3, 3.0), b.y[-1])
            yield "| %s | %s |" % (name[7:], " | ".join("%.4f" % v for v in values))


def beyond(value, interval):
    """Relative distance from an interval."""
    low, high = interval
    return max(low / value - 1.0, value / high - 1.0, 0.0)


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    for name, r in there.items():
        yield name + ": area lost, of it", abs(r.bubble.area[-1] / r.bubble.area[0] - 1.0), 1e-9
    for name in ("1/le-80", FINEST):
        if name in there:
            b = there[name].bubble
            for key, value in zip(RANGES, (b.least, b.fastest(0, 3)[0], b.y[-1])):
                yield "%s: %s, from the codes' range" % (name, key), beyond(value, RANGES[key]), 0.01
    if FINEST in there:
        for what, difference in zip(("circularity", "centre", "velocity"), there[FINEST].bubble.differences()):
            yield "%s: %s against MooNMD's, at any time" % (FINEST, what), difference, 0.01
    coarse = there.get(COARSEST)
    for name in ("ranks-2", "ranks-3", "dt-half"):
        if name in there and coarse:
            yield name + ": centre at 3 s as on one rank", abs(there[name].bubble.y[-1] / coarse.bubble.y[-1] - 1.0), 0.002
    for name, r in there.items():
        if name.startswith("test-2"):  # the codes agree on these
            firsts, ends = ([values[k] for values in CODES.values()] for k in (1, 5))
            yield name + ": first maximum of the rise velocity, from the codes' range", beyond(r.bubble.fastest(0, 1.3)[0], (min(firsts), max(firsts))), 0.02
            yield name + ": centre at 3 s, from the codes' range", beyond(r.bubble.y[-1], (min(ends), max(ends))), 0.02


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"test 1": table, "test 2": table_2}, claims)
