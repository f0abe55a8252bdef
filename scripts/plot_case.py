#!/usr/bin/env python3
"""The meshes of a case before its run.  Usage: plot_case.py FOLDER PICTURE, where FOLDER has fluid.h5 and solid.h5 as --draw writes them.

Left the whole domain, right the bodies; warns of bodies that reach out of the fluid.
"""
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

from snapshot import Window, paint_mesh, read_snapshot


def main(folder, picture):
    fluid = read_snapshot(os.path.join(folder, "fluid.h5"))[1]["velocity"]
    solid = read_snapshot(os.path.join(folder, "solid.h5"))[1]["solid"]
    domain, bodies = Window.around(fluid.points), Window.around(solid.points)
    if (bodies.lower < domain.lower).any() or (bodies.upper > domain.upper).any():
        print(f"note: bodies in {bodies.lower} .. {bodies.upper} m reach out of the fluid's {domain.lower} .. {domain.upper} m")
    margin = 0.25 * bodies.size.max()
    near = Window(np.maximum(bodies.lower - margin, domain.lower), np.minimum(bodies.upper + margin, domain.upper))
    figure, axes = plt.subplots(1, 2, figsize=(12, 6), layout="constrained")
    paint_mesh(axes[0], fluid, domain, solid)
    paint_mesh(axes[1], fluid, near, solid, inside=True)
    for axis, title in zip(axes, ("fluid: %d triangles" % len(fluid.cells), "bodies: %d triangles" % len(solid.cells))):
        axis.set(title=title, xlabel="x, m", ylabel="y, m")
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
