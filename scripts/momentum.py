#!/usr/bin/env python3
"""The momentum of a run, fluid and solids together, step by step, from fluid_forces.csv, solid.csv and coupler.csv; of a solid alone, from
solid.csv.

Usage: scripts/momentum.py FOLDER [--bound NUMBER]
Prints, for each component, the largest of what each term has given in a step, N s/m, and what is left over.  With --bound it fails where
more than that part of the step's terms is left over.
"""
import argparse
import os
import sys

import numpy as np

from series import bodies_of, has_every_step, of_same_steps, read_series

SERIES = ("fluid_forces", "solid", "coupler")
FLUID_TERMS = ("weight", "divergence", "interface", "absorption", "adaptation", "correction")  # of fluid_forces.csv, but for `solid` and `rest`
BOUNDARY_PARTS = ("pressure", "viscous", "convection")


def boundaries(forces):
    """The names of the boundaries in fluid_forces.csv."""
    return [name[:-len(" pressure x")] for name in forces if name.endswith(" pressure x")]


def change(start, end):
    """From the end of one step to that of the next; of the first one, from its start."""
    return end - np.concatenate([start[:1], end[:-1]])


def vector(series, name, between="_"):
    return np.stack([series[name + between + axis] for axis in "xy"], axis=1)


def need_every_step(folder, t, dt):
    if not has_every_step(t, dt):
        sys.exit(f"{folder}: the series do not have every step, which the budget needs: run without output.series_every")


def terms_of_solids(folder):
    """{term: [steps][2]} of a solid alone, the budget that solid/budget.c keeps."""
    solid = read_series(os.path.join(folder, "solid.csv"))
    if not len(solid["t"]):
        sys.exit(f"{folder}: solid.csv has no step")
    need_every_step(folder, solid["t"], solid["dt"])
    dt = solid["dt"][:, None]
    parts = {"solids' weight": dt * vector(solid, "weight"), "solids' load": dt * vector(solid, "load"),
             "solids' walls": vector(solid, "walls"), "solids' supports": vector(solid, "reaction")}
    terms = {"change": change(vector(solid, "start_momentum"), vector(solid, "momentum")), **parts}
    terms["rest"] = terms["change"] - sum(parts.values())
    # what bodies have and bear may cancel in the sum, as of two platens
    parts.update({k: solid[f"mass{k}"][:, None] * np.stack([solid[f"{u}{k}"] for u in "uv"], axis=1) for k in bodies_of(solid)})
    terms["scale"] = sum(np.linalg.norm(part, axis=1) for part in parts.values())
    return terms


def terms_of(folder):
    """{term: [steps][2]}: the impulses of all steps, N s/m.

    `change` of the momentum of fluid and solids is the sum of all other terms but `scale`, and of `rest`.  Of these, `inside` is what
    the coupler adds to the reaction: the inertia and the weight of the fluid that fills the solids, which the solids have in place
    of it; with `correction` it is the change of that fluid's momentum less its weight.  `uplift` is what walls beneath solids give back
    (coupler/force/uplift.h).  What fluid and solids exchange cancels:
    `exchange`, the fluid's gain and the coupler's reaction, and `load`, the coupler's force and the solids' load, are left over."""
    fluid, solid, coupler = of_same_steps(folder, *(read_series(os.path.join(folder, name + ".csv")) for name in SERIES))
    need_every_step(folder, fluid["t"], fluid["dt"])
    dt = fluid["dt"][:, None]
    of_fluid = lambda name: vector(fluid, name, " ")
    terms = {"change": change(of_fluid("start momentum"), of_fluid("momentum")) +
                       change(vector(solid, "start_momentum"), vector(solid, "momentum"))}
    for name in FLUID_TERMS:
        terms[name] = dt * of_fluid(name)
    for name in boundaries(fluid):
        terms[name] = -dt * sum(of_fluid(name + " " + part) for part in BOUNDARY_PARTS)
    terms["solids' weight"] = dt * vector(solid, "weight")
    terms["solids' walls"], terms["solids' supports"] = vector(solid, "walls"), vector(solid, "reaction")
    terms["uplift"] = dt * vector(coupler, "uplift")
    terms["inside"] = dt * (vector(coupler, "F") - vector(coupler, "R"))
    terms["rest"] = terms["change"] - sum(value for name, value in terms.items() if name != "change")
    terms["exchange"] = dt * (of_fluid("solid") + vector(coupler, "R"))
    terms["load"] = dt * (vector(solid, "load") - vector(coupler, "F") - vector(coupler, "uplift"))
    parts = [dt * of_fluid(name + " " + part) for name in boundaries(fluid) for part in BOUNDARY_PARTS]
    parts += [dt * of_fluid("solid"), dt * vector(solid, "load")]
    parts += [terms[name] for name in (*FLUID_TERMS, "solids' weight", "solids' walls", "solids' supports", "uplift")]
    terms["scale"] = sum(np.linalg.norm(part, axis=1) for part in parts)
    return terms


def defect(terms):
    """[steps]: what is left over, of the sum of the absolute values of all terms."""
    return np.linalg.norm(terms["rest"], axis=1) / np.maximum(terms["scale"], 1e-300)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--bound", type=float)
    options = parser.parse_args()
    has = [name for name in SERIES if os.path.exists(os.path.join(options.folder, name + ".csv"))]
    if "solid" not in has or len(has) == 2:
        missing = ", ".join(name + ".csv" for name in SERIES if name not in has)
        sys.exit(f"{options.folder}: there is no {missing}; of fluid and solids all three are needed, of a solid alone solid.csv")
    terms = terms_of(options.folder) if len(has) == 3 else terms_of_solids(options.folder)
    for name, value in terms.items():
        if name != "scale":
            print("%-20s %11.3e %11.3e" % (name, *abs(value).max(axis=0)))
    largest = defect(terms).max()
    print("left over, of %sall terms of a step: %.1e" % ("" if len(has) == 3 else "the bodies' momenta and ", largest))
    return options.bound is not None and not largest < options.bound


if __name__ == "__main__":
    sys.exit(main())
