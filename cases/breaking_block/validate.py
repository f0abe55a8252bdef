#!/usr/bin/python3
"""Runs the breaking block on several ranks, meshes and steps, and writes its tables.

    cases/breaking_block/validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

A run is skipped when it has ended before (out/validation/breaking_block/<name>; delete the folder to run it again).  --only takes
names with wildcards.  --table only prints the tables of what has been run, --readme also puts them into README.md, --check exits
with 1 when a number is out of its bounds.
"""
import pathlib
import subprocess

import numpy as np

from budget import Budget  # puts scripts/ on the path
from fragments import Elements
from series import read_series
from snapshot import read_snapshot
import validation

HERE = pathlib.Path(__file__).resolve().parent
OUT = validation.OUT / "breaking_block"
TOUGHNESS, TENSILE, SHEAR, YOUNG = 12.8, 8.0e4, 1.6e5, 5.0e7  # J/m2 and Pa, of case.yaml
STREAM, RELEASE, END = 0.55, 0.7, 0.95  # s: the stream is nearly there; the projectile is free; the block is in pieces
# name: (keys, ranks, size of the block's triangles, m); all but the first end at END
RUNS = {
    "base": ([], "1:1:1", 0.016),
    "solid-2": ([], "1:1:2", 0.016),
    "solid-3": ([], "1:1:3", 0.016),
    "ranks-2": ([], "2:1:2", 0.016),
    "ranks-3": ([], "3:2:3", 0.016),
    "le-0.015": (["fluid.adapt.size_min=0.015", "fluid.adapt.velocity_error=0.06"], "1:1:1", 0.016),
    "le-0.005": (["fluid.adapt.size_min=0.005", "fluid.adapt.velocity_error=0.02"], "1:1:1", 0.016),
    "dt-half": (["time.cfl=0.5", "time.dt_max=0.0025"], "1:1:1", 0.016),
    "courant-half": (["solid.courant=0.4"], "1:1:1", 0.016),
    "size-0.022": ([], "1:1:1", 0.022),
    "size-0.011": ([], "1:1:1", 0.011),
}


class Result:
    """What a run has left behind."""

    def __init__(self, name):
        self.name, folder = name, OUT / name
        self.budget, series = Budget(str(folder)), read_series(folder / "solid.csv")
        self.message = (folder / "message.txt").read_text()  # empty: it has come to its end
        self.t, self.projectile, self.on_block = self.budget.t, series["mass1"] * series["u1"], series["fx0"]
        self.place = series["x1"]
        fluid = read_series(folder / "fluid.csv")
        self.triangles = int(fluid["triangles"].max())
        self.imbalance = read_series(folder / "coupler.csv")["imbalance"].max()
        self.pieces = self._pieces(folder)

    @staticmethod
    def _pieces(folder):
        """Areas of the block's fragments in the last snapshot, parts of the whole, the largest first."""
        solid = Elements(read_snapshot(folder / "solid.h5")[1]["solid"])
        areas = np.sort(np.bincount(solid.fragment, np.where(solid.body == 0, solid.area, 0.0)))[::-1]
        return areas[areas > 0.0] / areas.sum()

    def at(self, values, t):
        return np.interp(t, self.t, values)

    @property
    def stream(self):
        """Force of the stream on the whole block, N/m."""
        return self.at(self.on_block, STREAM)

    @property
    def lost(self):
        """Momentum that the projectile has lost at END, N s/m."""
        return self.at(self.projectile, RELEASE) - self.at(self.projectile, END)

    @property
    def foot(self):
        """Largest force that holds the foot once the projectile is free, mean over a step, N/m."""
        dt, held = np.diff(self.t), np.diff(self.budget.reaction[0])
        return abs(held / dt)[self.t[1:] > RELEASE + 0.006].max()

    def until(self, other, bound):
        """Time until which the fluid's force on the solids differs from another run's by less than `bound` of its largest."""
        b, o = self.budget, other.budget
        n = int(np.searchsorted(b.t, min(END, o.t[-1])))
        difference = abs(b.force[0][:n] - np.interp(b.t[:n], o.t, o.force[0]))
        apart = np.flatnonzero(difference > bound * abs(o.force[0][o.t < STREAM]).max())
        return b.t[apart[0]] if len(apart) else None


def run(name):
    keys, ranks, size = RUNS[name]
    folder = OUT / name
    if (folder / "message.txt").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["gmsh", "-2", "-format", "msh41", HERE / "block.geo", "-setnumber", "size", str(size), "-o", folder / "block.msh"],
                   check=True, stdout=subprocess.DEVNULL)
    if name != "base":
        keys = ["time.end=%g" % END, "output.every=0.05"] + keys
    keys = ["case=%s" % name, "solid.bodies[0].mesh=%s" % (folder / "block.msh"), *keys]
    failed = validation.launch_coupled(HERE, folder, keys, ranks)
    errors = [line for line in open(folder / "log.txt") if ": error: " in line]
    (folder / "message.txt").write_text((errors[0].split(": error: ")[1] if errors else "failed") if failed else "")
    print("done" if not failed else "stopped", name, flush=True)


def results(names):
    return {name: Result(name) for name in names if (OUT / name / "message.txt").exists()}


def runs_table(there):
    yield "| run | first crack [s] | stream on the block [N/m] | projectile's loss [N s/m] | foot, largest [N/m] | cracks [m] | G_f [J/m2] | pieces " \
          "| largest three | momentum error | energy from nothing | imbalance | triangles | steps |"
    yield "|" + "---|" * 14
    for name, r in there.items():
        b = r.budget
        n = int(np.searchsorted(r.t, END * (1 - 1e-9)))
        n = min(n, len(r.t) - 1)
        if r.message:
            why = "shaken apart" if "alternating sign" in r.message else r.message.strip()
            yield "| %s | stopped at %.3f s: %s |" % (name, r.t[-1], why) + " |" * 12
            continue
        yield "| " + " | ".join([
            name, "%.4f" % b.first_crack(), "%.1f" % r.stream, "%.1f" % r.lost, "%.0f" % r.foot, "%.2f" % b.cracks[n],
            "%.2f" % b.crack_energy(n), "%.0f" % (b.pieces[n] - 1), ", ".join("%.0f %%" % (100 * p) for p in r.pieces[:3]),
            "%.0e" % max(b.momentum_error(0), b.momentum_error(1)), "%.2g" % max(b.excess.max(), 0.0), "%.0e" % r.imbalance,
            str(r.triangles), str(len(r.t))]) + " |"


def ranks_table(there):
    yield "| run | time in the run from which it differs from base by more than 1e-9 | 1e-6 | 1e-3 | 1e-1 of the force | projectile at %g s [mm] |" % END
    yield "|" + "---|" * 6
    for name in ("solid-2", "solid-3", "ranks-2", "ranks-3"):
        if name not in there or "base" not in there:
            continue
        r, base = there[name], there["base"]
        times = [r.until(base, bound) for bound in (1e-9, 1e-6, 1e-3, 1e-1)]
        apart = r.at(r.place, END) - base.at(base.place, END)
        yield "| %s | " % name + " | ".join("%.3f s" % t if t else "never" for t in times) + " | %+.2g |" % (1e3 * apart)


def ramp():
    """What a bent path may cost more or less than G_f, of it (joint.h), with the heights of triangles of 0.016 m."""
    stiffness = 3.0 * YOUNG * 2.0 / (0.016 * 0.866)
    return 0.5 * (SHEAR**2 - TENSILE**2) / stiffness / TOUGHNESS


def claims(there):
    """What must hold of the runs that are there: (statement, measured, bound)."""
    for name, r in there.items():
        b = r.budget
        yield name + ": comes to its end", float(bool(r.message)), 0.0
        for c in range(2):
            yield name + ": momentum of the solids, " + "xy"[c], b.momentum_error(c), 1e-6
        yield name + ": imbalance of fluid and solids", r.imbalance, 1e-10
        yield name + ": energy from nothing, of the thrower's", b.excess.max() / b.reaction_work[-1], 1e-3
        yield name + ": cracks cost G_f", abs(b.crack_energy() / TOUGHNESS - 1.0), ramp()
    if "base" not in there:
        return
    base = there["base"]
    first = base.budget.first_crack()
    for name in ("solid-2", "solid-3"):
        if name in there:
            yield name + ": s before 0.5 at which 1e-6 of the force differs", 0.5 - (there[name].until(base, 1e-6) or END), 0.0
            yield name + ": first crack as in base, s", abs(there[name].budget.first_crack() - first), 0.001
    for name in ("ranks-2", "ranks-3", "le-0.005", "dt-half", "courant-half", "size-0.011"):
        if name in there:
            yield name + ": the stream's force as in base", abs(there[name].stream / base.stream - 1.0), 0.03
            yield name + ": first crack as in base, s", abs(there[name].budget.first_crack() - first), 0.01
            yield name + ": the projectile's loss as in base", abs(there[name].lost / base.lost - 1.0), 0.1


if __name__ == "__main__":
    validation.main(__doc__, HERE, RUNS, run, results, {"runs": runs_table, "ranks": ranks_table}, claims)
