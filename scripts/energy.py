#!/usr/bin/env python3
"""The energy of a run, fluid and solids together, and how far its bodies go from where they start; from fluid.csv and solid.csv, of a
solid alone from solid.csv.

Usage: scripts/energy.py FOLDER [--from TIME] [--bound NUMBER]
Prints each kind of energy, J/m: at the first step (from TIME, s), at the last, its change, the least and the most between; what friction and damping of
contact have taken since (of blows within some 2 %, by the substeps' length; with output.series_every it is not known); and of each body the farthest that its
centre has been from its place at the first step, m, and the largest angle by which it has turned since, rad.  `all`, of phases
and solids together or of a solid alone, falls by friction, damping and what flows out, and rises by what loads, springs and prescribed motions
do; what contact stores is not in it: in a blow it falls, and rises again as the bodies part.  One fluid that solids displace has a potential energy that
nothing tells, and no `all`.  With --bound it fails where `all` grows by more than that, J/m.
"""
import argparse
import os
import sys

import numpy as np

from series import bodies_of, has_every_step, of_same_steps, read_series


MOST_BODIES = 1000  # of solid.csv


def gravity_of(solid, bodies):
    """The acceleration by gravity, m/s2, [2]: the weight of all bodies over their mass."""
    mass = sum(solid[f"mass{k}"] for k in bodies)
    gravity = np.stack([solid["weight_x"], solid["weight_y"]], axis=1) / mass[:, None]
    if abs(gravity - gravity[0]).max() > 1e-6 * np.linalg.norm(gravity[0]) + 1e-12:
        sys.exit("gravity changes during the run: there is no potential energy")
    return gravity[0]


def energies(fluid, solid):
    """{kind: [steps]} J/m; fluid: None for a solid alone."""
    bodies = bodies_of(solid)
    kinds = {}
    if fluid is not None:
        kinds["fluid, kinetic"] = fluid["kinetic energy"]
        if "potential energy" in fluid:
            kinds["fluid, potential"] = fluid["potential energy"]
    if bodies:
        gravity = gravity_of(solid, bodies)
        kinds["solids, kinetic"] = sum(solid[f"kinetic{k}"] for k in bodies)
        kinds["solids, strain"] = sum(solid[f"strain{k}"] for k in bodies)
        kinds["solids, potential"] = -sum(solid[f"mass{k}"] * (gravity[0] * solid[f"x{k}"] + gravity[1] * solid[f"y{k}"]) for k in bodies)
        kinds["solids, cracks"] = solid["fracture"]
    if fluid is None or "potential energy" in fluid:
        kinds["all"] = sum(kinds.values())
    return kinds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--from", type=float, default=0.0, dest="begin")
    parser.add_argument("--bound", type=float)
    options = parser.parse_args()
    path = lambda name: os.path.join(options.folder, name + ".csv")
    if not os.path.exists(path("solid")):
        sys.exit(f"{options.folder}: there is no solid.csv")
    series = of_same_steps(options.folder, *(read_series(path(name)) for name in ("solid", "fluid") if os.path.exists(path(name))))
    first = int(np.searchsorted(series[0]["t"], options.begin))
    if len(series[0]["t"]) < first + 2:
        sys.exit(f"{options.folder}: there are fewer than two steps from {options.begin:g} s on")
    solid, *rest = ({name: value[first:] for name, value in one.items()} for one in series)
    fluid = rest[0] if rest else None
    if len(bodies_of(solid)) >= MOST_BODIES:
        sys.exit(f"{options.folder}: solid.csv has no more than {MOST_BODIES} bodies, and there may be others")
    if fluid is None and not bodies_of(solid):
        sys.exit(f"{options.folder}: the run has no bodies")
    kinds = energies(fluid, solid)
    print("%-18s" % "J/m" + "".join("%13s" % name for name in ("first", "last", "change", "least", "most")))
    for name, value in kinds.items():
        print("%-18s" % name + "".join("%13.5g" % x for x in (value[0], value[-1], value[-1] - value[0], value.min(), value.max())))
    if bodies_of(solid) and has_every_step(solid["t"], solid["dt"]):
        print("friction and damping of contact have taken %.5g J/m" % solid["contact loss"][1:].sum())
    for k in bodies_of(solid):
        distance = np.hypot(solid[f"x{k}"] - solid[f"x{k}"][0], solid[f"y{k}"] - solid[f"y{k}"][0])
        turned = np.unwrap(solid[f"angle{k}"])
        print("body %d: at most %.3g m from its place, turned by at most %.3g rad" % (k, distance.max(), abs(turned - turned[0]).max()))
    if "all" not in kinds:
        return options.bound is not None and "no sum of all energies with one fluid"
    gained = (kinds["all"] - np.minimum.accumulate(kinds["all"])).max()
    print("the most that all has grown by: %.3g J/m" % gained)
    return options.bound is not None and not gained < options.bound


if __name__ == "__main__":
    sys.exit(main())
