#!/usr/bin/python3
"""Runs the cylinder held and on springs, each with two sizes of elements, and writes its table.

    cases/vibrating_cylinder/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/vibrating_cylinder/<name>; delete the folder to run it again); one with
the smaller elements resumes from that with the larger ones, which is run first.  --only takes names with wildcards.  --table only prints
the table of what has been run, --readme also puts it into README.md, --check exits with 1 when a number is out of its bounds.  Needs numpy.
"""
import csv
import json
import pathlib

from cylinder import QUANTITIES, Run  # puts scripts/ on the path
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "vibrating_cylinder"
# A push aside that the wake of a cylinder that is held needs to begin to swing
HELD = ["solid.bodies[0].velocity=[0, 0]",
        "solid.bodies[0].prescribed=[{table: [[0, 0, 0], [0.75, 0, 0.3], [1.5, 0, 0], [2.25, 0, -0.3], [3, 0, 0]]}]"]
# {cylinder: (mass over that of the displaced fluid, stiffness, N/m)}; light: that with which the effective stiffness is that of u5
SPRINGS = {"held": None, "u5": (2.0, 2.4807), "light": (0.5, 0.958), "zero": (3.1831, 2.37), "u6": (2.0, 1.7227)}
SIZES = {"0.05": [], "0.025": ["fluid.adapt.size_min=0.025", "coupler.shell_thickness=0.00125", "fluid.adapt.velocity_error=0.01"]}
ENDS = {"0.05": 70.0, "0.025": 110.0, "zero-0.025": 150.0}  # D/U; zero still grows at 110
RUNS = ["%s-%s" % (cylinder, size) for size in SIZES for cylinder in SPRINGS]


def run(name):
    cylinder, size = name.split("-")
    if size != "0.05":
        run(cylinder + "-0.05")
    spring = SPRINGS[cylinder]
    keys = ["solid.materials.cylinder.density=%g" % spring[0], "solid.springs[0].stiffness=%g" % spring[1]] if spring else HELD
    validation.run(HERE, OUT / name, ["time.end=%g" % ENDS.get(name, ENDS[size]), *SIZES[size], *keys], "1:1:1",
                   None if size == "0.05" else OUT / (cylinder + "-0.05"))


def references():
    """{cylinder: {quantity: value}} of reference/body_fitted.csv, extrapolated from its two grids: their error goes with the square of the
    spacing."""
    found = {}
    with open(HERE / "reference" / "body_fitted.csv") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            values = {q: float(row[q]) for q in QUANTITIES}
            found.setdefault(row["cylinder"], []).append((int(row["points"]) - 1, values))
    return {cylinder: {q: b[q] + (b[q] - a[q]) / ((fine / coarse)**2 - 1.0) for q in QUANTITIES}
            for cylinder, ((coarse, a), (fine, b)) in found.items()}


class Result:
    def __init__(self, name):
        self.cylinder, self.size = name.split("-")
        self.found = Run(OUT / name).periodic()
        with open(OUT / name / "summary.json") as file:
            self.summary = json.load(file)
        self.cpu = sum(p["seconds_cpu"] for p in self.summary["participants"].values())


def results(names):
    return {name: Result(name) for name in names if (OUT / name / "summary.json").exists()}


def table(there):
    """A row a run, those of each cylinder under its reference; cost: processor time over that of held-0.05."""
    yield "| run | m* | k [N/m] | amplitude [D] | frequency [U/D] | drag | lift | iterations a step | steps | cost |"
    yield "|" + "---|" * 10
    known = references()
    for cylinder in SPRINGS:
        expected = known["u5" if cylinder == "light" else cylinder]
        spring = ["%g" % value for value in SPRINGS[cylinder]] if SPRINGS[cylinder] else ["", ""]
        yield "| " + " | ".join(["**%s**" % cylinder, *spring, *("%.3f" % expected[q] for q in QUANTITIES), "", "", ""]) + " |"
        for name, r in there.items():
            if r.cylinder == cylinder:
                cells = ["%.3f" % r.found[q] + (" (%s)" % validation.percent(r.found[q], expected[q]) if expected[q] else "") for q in QUANTITIES]
                yield "| " + " | ".join([name, "", "", *cells, "%.2f" % (r.summary["iterations"] / r.summary["steps"]),
                                         str(r.summary["steps"]), validation.cost(there, name, "held-0.05")]) + " |"


BOUNDS = {"amplitude": 0.05, "frequency": 0.02, "drag": 0.05}


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound); of numbers against the reference with the smaller elements."""
    expected = references()
    expected["light"] = expected["u5"]
    for name, r in there.items():
        yield name + ": momentum imbalance", r.summary["largest_momentum_imbalance"], 1e-10
        yield name + ": coupling iterations a step", r.summary["iterations"] / r.summary["steps"], 4.0
        if r.size == "0.025":
            for q, bound in BOUNDS.items():
                if expected[r.cylinder][q]:
                    yield "%s: %s" % (name, q), abs(r.found[q] / expected[r.cylinder][q] - 1.0), bound
    for cylinder in SPRINGS:  # the error goes with the size of the elements
        one, half = (there.get("%s-%s" % (cylinder, size)) for size in SIZES)
        if SPRINGS[cylinder] and one and half:
            amplitude = 2.0 * half.found["amplitude"] - one.found["amplitude"]
            yield cylinder + ": amplitude, extrapolated", abs(amplitude / expected[cylinder]["amplitude"] - 1.0), 0.03
    if {"u5-0.025", "light-0.025"} <= set(there):
        for q in ("amplitude", "frequency"):
            yield "light-0.025: %s as of u5" % q, abs(there["light-0.025"].found[q] / there["u5-0.025"].found[q] - 1.0), 0.02


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"runs": table}, claims)
