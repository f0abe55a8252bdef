#!/usr/bin/python3
"""Runs the elastic membrane's rows and variants, and writes their tables.

    cases/elastic_membrane/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when its summary.json is there (out/validation/elastic_membrane/<name>; delete the folder to run it again).  --only
takes names with wildcards.  --table only prints the tables of what has been run, --readme also puts them into README.md, --check
exits with 1 when a number is out of its bounds.  Needs numpy and h5py.
"""
import functools
import json
import pathlib

import numpy as np

import membrane  # puts scripts/ on the path
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "elastic_membrane"
percent = functools.partial(validation.percent, digits=2)
# A massless line T = T0 (stretch - 1), T0 = 10 N/m: as dense as the fluid, law linear in the stretch, E h = T0.
LINE = ["solid.materials.membrane={law: corotated, density: 1, youngs_modulus: 2000, poisson_ratio: 0, damping: 0.2}",
        "time.dt_max=0.0004"]


def sizes(le, size):
    """le, and the elements along the wall."""
    return ["fluid.adapt.size_min=%g" % le, "solid.bodies[0].size=%g" % size]


# name: (keys other than case.yaml's, ranks)
RUNS = {
    "y1": (sizes(0.004, 0.005) + ["time.end=4"], "1:1:1"),
    "y2": (sizes(0.004, 0.005) + ["time.end=1.5", "coupler.shell_thickness=0.001"], "1:1:1"),
    "y3": (sizes(0.004, 0.005) + ["time.end=1.5", "coupler.shell_thickness=0.002"], "1:1:1"),
    "y1-le-0.008": (["time.end=6"], "1:1:1"),  # until it rests
    "y1-le-0.016": (sizes(0.016, 0.01), "1:1:1"),
    "y1-dt-half": (["time.dt_max=0.0005"], "1:1:1"),
    "ranks-1": (sizes(0.016, 0.01) + ["time.end=0.5"], "1:1:1"),
    "ranks-2": (sizes(0.016, 0.01) + ["time.end=0.5"], "2:1:1"),
    "ranks-3": (sizes(0.016, 0.01) + ["time.end=0.5"], "3:2:2"),
    "line": (LINE + sizes(0.004, 0.005), "1:1:1"),
    "line-le-0.008": (LINE, "1:1:1"),
    "line-le-0.016": (LINE + sizes(0.016, 0.01), "1:1:1"),
}
ROWS = ("y1", "y2", "y3")


def run(name):
    validation.run(HERE, OUT / name, *RUNS[name])


class Result:
    """What a run has left behind."""

    def __init__(self, name):
        self.name, self.folder = name, OUT / name
        self.summary = json.load(open(self.folder / "summary.json"))
        self.shape = membrane.history(self.folder)
        parts = self.summary["participants"].values()
        self.cpu = sum(p["seconds_cpu"] for p in parts)
        self.le = next((float(k.split("=")[1]) for k in RUNS[name][0] if "size_min" in k), 0.008)
        self.triangles = int(membrane.last_row(self.folder / "fluid.csv")["triangles"])

    @property
    def area_change(self):
        """The largest, of the starting area."""
        return max(abs(self.shape["area"] / self.shape["area"][0] - 1.0))


def results(names):
    return {name: Result(name) for name in names if (OUT / name / "summary.json").exists()}


def rows_table(there):
    yield "| run | le | dr | triangles | steps | cost | area | t | rx | ry | mean radius | jump | thin shell | error |"
    yield "|" + "---|" * 14
    for name, r in there.items():
        if name.startswith("line"):
            continue
        s, t = r.shape, r.shape["t"][-1]
        jump, shell = membrane.jump(r.folder, t), membrane.ring_tension(s["length"][-1] / membrane.REST_LENGTH) / s["radius"][-1]
        thickness = next((k.split("=")[1] for k in RUNS[name][0] if "shell_thickness" in k), "0.0005")
        yield "| %s | %g | %s | %d | %d | %s | %+.2f %% | %g | %.4f | %.4f | %.5f | %.4f | %.4f | %s |" % (
            name, r.le, thickness, r.triangles, r.summary["steps"], validation.cost(there, name, "y1"), 100.0 * (s["area"][-1] / s["area"][0] - 1.0), t, s["rx"][-1],
            s["ry"][-1], s["radius"][-1], jump, shell, percent(jump, shell))


def line_table(there):
    reference = membrane.reference()
    times = (0.1, 0.19, 0.3, 0.5, 0.8, 1.2, 1.47, 2.0)
    crossings = membrane.crossings(reference)
    yield "| run | " + " | ".join("rx(%g)" % t for t in times) + " | rx = ry at | area | p(0) - p(1.4, 0) | cost |"
    yield "|" + "---|" * (len(times) + 5)
    yield "| body-fitted | " + " | ".join("%.4f" % membrane.at(reference, "rx", t) for t in times) + " | %s | | %.3f | |" % (
        ", ".join("%.4f" % c for c in crossings), membrane.at(reference, "drop", 2.0))
    for name, r in there.items():
        if not name.startswith("line"):
            continue
        cells = []
        for t in times:
            rx = membrane.at(r.shape, "rx", t)
            cells.append("%.4f (%s)" % (rx, percent(rx, membrane.at(reference, "rx", t))))
        found = membrane.crossings(r.shape)
        yield "| %s | %s | %s | %+.2f %% | %.3f | %s |" % (
            name, " | ".join(cells), ", ".join("%.4f (%s)" % (a, percent(a, b)) for a, b in zip(found, crossings)),
            100.0 * (r.shape["area"][-1] / r.shape["area"][0] - 1.0), membrane.drop(r.folder, 2.0), validation.cost(there, name, "y1"))


def profiles_table(there):
    """How far apart the rows' pressures along y = 0 are."""
    times = (0.19, 0.80, 1.47)
    yield "| dr | " + " | ".join("t %g: rms, largest" % t for t in times) + " |"
    yield "|" + "---|" * (len(times) + 1)
    for name in ROWS[1:]:
        if name not in there or "y1" not in there:
            continue
        cells = ["%.2f %%, %.2f %%" % tuple(100.0 * v for v in membrane.profile_difference(there["y1"].folder, there[name].folder, t))
                 for t in times]
        yield "| %s against y1 | %s |" % (name, " | ".join(cells))


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    reference = membrane.reference()
    for name, r in there.items():
        yield name + ": momentum imbalance", r.summary["largest_momentum_imbalance"], 1e-10
        if r.le <= 0.004:
            yield name + ": change of area", r.area_change, 0.005
    if "line" in there:
        s = there["line"].shape
        yield "line: rx(t), largest error", max(abs(s["rx"] / np.interp(s["t"], reference["t"], reference["rx"]) - 1.0)[1:]), 0.015
        found, known = membrane.crossings(s), membrane.crossings(reference)
        yield "line: crossings", max(abs(a / b - 1.0) for a, b in zip(found, known)) if len(found) == len(known) else np.inf, 0.02
    if "y1-le-0.008" in there:
        shape = there["y1-le-0.008"].shape
        for key in ("rx", "ry"):
            yield "y1-le-0.008: %s at the end" % key, abs(shape[key][-1] / membrane.EQUILIBRIUM - 1.0), 0.005
    if "y1" in there:
        r = there["y1"]
        t, shell = r.shape["t"][-1], membrane.ring_tension(r.shape["length"][-1] / membrane.REST_LENGTH) / r.shape["radius"][-1]
        yield "y1: radius at the end", abs(r.shape["radius"][-1] / membrane.EQUILIBRIUM - 1.0), 0.005
        yield "y1: jump of thin-shell theory", abs(membrane.jump(r.folder, t) / shell - 1.0), 0.02
        for name in ROWS[1:]:
            for t in (0.19, 0.80, 1.47):
                if name in there:
                    yield name + ": pressure along y = 0 at %g s, rms" % t, membrane.profile_difference(r.folder, there[name].folder, t)[0], 0.02
    for name in ("ranks-2", "ranks-3"):
        if name in there and "ranks-1" in there:
            yield name + ": rx as on 1", abs(there[name].shape["rx"][-1] / there["ranks-1"].shape["rx"][-1] - 1.0), 0.002


if __name__ == "__main__":
    tables = {"rows": rows_table, "line": line_table, "profiles": profiles_table}
    validation.main(__doc__, HERE, RUNS, run, results, tables, claims)
