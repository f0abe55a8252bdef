"""Of entry.sh: keys of a run (entry.py DEADRISE DEPTH), or what runs differ from entry_reference.py by (entry.py FOLDER)."""
import os
import sys
import numpy as np
from entry_reference import Entry
from results import column, rows, snapshots

LEAST, MOST = (0.98, 0.93, 0.96), (1.11, 1.07, 1.04)  # force, pressure, place of the jet's root, over theory
RHO, GAP, PLACES = 1000.0, 0.005, 0.02 * np.arange(1, 13)  # kg/m3; m, from the apex to the water at the start; m, x of the gauges


def keys(deadrise, depth):
    print("time.end=%g" % (depth + GAP))
    print("fluid.probes=[%s]" % ", ".join(
        "{name: g%d, solid_point: [%.9f, %.9f]}" % (i, x, GAP + x * np.tan(np.radians(deadrise))) for i, x in enumerate(PLACES)))


def inside(label):
    """The largest part of the wedge that is filled with water."""
    largest = 0.0
    for _, _, area, velocity in snapshots(label):
        solid = velocity["cell/alpha"][:]
        if solid.any(): largest = max(largest, (area * np.maximum(velocity["cell/water"][:] + solid - 1.0, 0.0)).sum() / (area * solid).sum())
    return largest


def gauges(label, deadrise, theory, depth):
    """Over theory: the pressure where the largest one has passed, mean over gauges and time; the largest one, mean over gauges, and its rms deviation; the
    depth at which half of it comes, mean over gauges."""
    series = rows(label, "fluid_probes")
    found = np.array([[row["g%d_p [Pa]" % i] for row in series] for i in range(len(PLACES))]) / RHO
    place = PLACES[:, None] / np.cos(deadrise)
    exact = np.interp(place / np.maximum(depth, 1e-9), theory.s, theory.pressure, right=0.0)
    after = depth > 1.2 * place / theory.s[theory.pressure > 0.5 * theory.pressure.max()][-1]
    largest, first = [], []
    for p, e, wet in zip(found[1:], exact[1:], after[1:]):  # the first one is an element's size from the apex
        if not wet.any(): continue
        largest.append(p[depth > 0.0].max() / theory.pressure.max())
        first.append(depth[(p > 0.5 * theory.pressure.max()) & (depth > 0.0)][0] / depth[e > 0.5 * theory.pressure.max()][0])
    return found[after].sum() / exact[after].sum(), np.mean(largest), np.std(largest), np.mean(first)


def entry(label):
    deadrise = np.radians(float(label.split()[0]))
    theory = Entry(deadrise, 0.4)
    assert abs(theory.far) < 3e-3 and abs(theory.apex / theory.pressure[0] - 1.0) < 0.02, "theory: surface far off at %g, pressure at the apex %g, %g" % (
        theory.far, theory.pressure[0], theory.apex)
    t, dt, force, aside = (np.array(column(label, "coupler", n)) for n in ("t [s]", "dt [s]", "F_y [N]", "F_x [N]"))
    depth = t - GAP
    exact, late = theory.force * RHO * depth, depth > 0.4 * depth[-1]
    mean = (force * dt)[late].sum() / (exact * dt)[late].sum()
    noise = np.sqrt(((force - mean * exact)[late] ** 2).mean()) / exact[late].mean()
    pressure, largest, scatter, first = gauges(label, deadrise, theory, depth)
    energy, work = column(label, "fluid", "kinetic energy [J/m]")[-1], (force * dt).sum()
    water, imbalance = inside(label), max(column(label, "coupler", "imbalance"))
    report = "%s: force %.3f of theory, rms of steps %.3f, aside %.3f; pressure %.3f, largest %.2f +- %.2f, half of it at %.3f; work %.3f, kinetic energy %.2f of it; " \
        "water inside %.1e, imbalance %.1e, %d steps" % (label, mean, noise, abs(aside[late].mean()) / exact[late].mean(), pressure, largest, scatter, first,
                                                         work / (0.5 * exact[-1] * depth[-1]), energy / work, water, imbalance, len(t))
    print(report)
    assert water < 1e-6 and imbalance < 1e-9, report
    assert label.endswith("tried") or all(a < x < b for a, x, b in zip(LEAST, (mean, pressure, first), MOST)), report


def fall(label):
    """With the momentum of the water, F V t/2 of the constant velocity, the wedge has V = 1/(1 + F z^2/(2 m)) of its first velocity at the depth z."""
    t, y, v, mass = (np.array(column(label, "solid", n)) for n in ("t [s]", "y0 [m]", "v0 [m/s]", "mass0 [kg/m]"))
    z = y[0] - y - GAP + t[0]  # as fast as at the start until the first row
    theory = 1.0 / (1.0 + Entry(np.radians(30.0)).force * RHO * np.maximum(z, 0.0) ** 2 / (2.0 * mass[0]))
    for depth in (0.0, 0.02, 0.04, 0.06, 0.08, 0.1):
        print("%s: at %.2f m %.4f m/s, theory %.4f" % (label, depth, np.interp(depth, z, -v), np.interp(depth, z, theory)))


if len(sys.argv) > 2:
    keys(*map(float, sys.argv[1:]))
else:
    for run in sorted(os.listdir(sys.argv[1])):
        if os.path.exists("%s/%s/summary.json" % (sys.argv[1], run)): (fall if run.endswith("fall") else entry)(run)
