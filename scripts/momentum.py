#!/usr/bin/env python3
"""The momentum of a run, fluid and solids together, step by step, from fluid_forces.csv, solid.csv and coupler.csv.

Usage: scripts/momentum.py FOLDER [--bound NUMBER]
Prints, for each component, the largest of what each term has given in a step, N s/m, and what is left over.  With --bound it fails where
more than that part of the step's terms is left over.
"""
import argparse
import os
import sys

import numpy as np

from series import read_series

FLUID_TERMS = ("weight", "divergence", "interface", "absorption", "adaptation", "correction")  # of fluid_forces.csv, but for `solid` and `rest`
BOUNDARY_PARTS = ("pressure", "viscous", "convection")


def boundaries(forces):
    """The names of the boundaries in fluid_forces.csv."""
    return [name[:-len(" pressure x")] for name in forces if name.endswith(" pressure x")]


def change(start, end):
    """From the end of one step to that of the next; of the first one, from its start."""
    return end - np.concatenate([start[:1], end[:-1]])


def terms_of(folder):
    """{term: [steps][2]}: the impulses of all steps, N s/m.

    `change` of the momentum of fluid and solids is the sum of all other terms but `scale`, and of `rest`.  Of these, `inside` is what
    the coupler adds to the reaction: the inertia and the weight of the fluid that fills the solids, which the solids have in place
    of it; with `correction` it is the change of that fluid's momentum less its weight.  `uplift` is what walls beneath solids give back
    (coupler/force/uplift.h).  What fluid and solids exchange cancels:
    `exchange`, the fluid's gain and the coupler's reaction, and `load`, the coupler's force and the solids' load, are left over."""
    fluid, solid, coupler = (read_series(os.path.join(folder, name + ".csv")) for name in ("fluid_forces", "solid", "coupler"))
    for other in (solid, coupler):
        if len(other["t"]) != len(fluid["t"]) or abs(other["t"] - fluid["t"]).max() > 1e-9 * fluid["t"][-1]:
            sys.exit(f"{folder}: the series are not of the same steps")
    dt = fluid["dt"][:, None]
    vector = lambda series, name, between=" ": np.stack([series[name + between + axis] for axis in "xy"], axis=1)
    terms = {"change": change(vector(fluid, "start momentum"), vector(fluid, "momentum")) +
                       change(vector(solid, "start_momentum", "_"), vector(solid, "momentum", "_"))}
    for name in FLUID_TERMS:
        terms[name] = dt * vector(fluid, name)
    for name in boundaries(fluid):
        terms[name] = -dt * sum(vector(fluid, name + " " + part) for part in BOUNDARY_PARTS)
    terms["solids' weight"] = dt * vector(solid, "weight", "_")
    terms["solids' walls"], terms["solids' supports"] = vector(solid, "walls", "_"), vector(solid, "reaction", "_")
    terms["uplift"] = dt * vector(coupler, "uplift", "_")
    terms["inside"] = dt * (vector(coupler, "F", "_") - vector(coupler, "R", "_"))
    terms["rest"] = terms["change"] - sum(value for name, value in terms.items() if name != "change")
    terms["exchange"] = dt * (vector(fluid, "solid") + vector(coupler, "R", "_"))
    terms["load"] = dt * (vector(solid, "load", "_") - vector(coupler, "F", "_") - vector(coupler, "uplift", "_"))
    parts = [dt * vector(fluid, name + " " + part) for name in boundaries(fluid) for part in BOUNDARY_PARTS]
    parts += [dt * vector(fluid, "solid"), dt * vector(solid, "load", "_")]
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
    terms = terms_of(options.folder)
    for name, value in terms.items():
        if name != "scale":
            print("%-20s %11.3e %11.3e" % (name, *abs(value).max(axis=0)))
    largest = defect(terms).max()
    print("left over, of all terms of a step: %.1e" % largest)
    return options.bound is not None and not largest < options.bound


if __name__ == "__main__":
    sys.exit(main())
