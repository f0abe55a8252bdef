#!/usr/bin/env bash
# Small elements at the corners of a square that falls (fluid.adapt.corner_size), there and nowhere else, on any number of ranks, and along its way: adapted
# meshes come before corners leave theirs.  Usage: corner.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
square=(--set "solid.bodies=[{shape: rectangle, centre: [1.0, 1.1], width: 0.25, height: 0.25, size: 0.03, material: disc}]" --set time.end=0.25 --set time.dt_max=0.005
  --set fluid.adapt.size_min=0.02 --set fluid.adapt.size_max=0.25 --set fluid.adapt.velocity_error=0.01 --set "fluid.mesh.refine[0].size=0.2" --set time.cfl=2)
must without 1:1:1 "${square[@]}"
for ranks in 1:1:1 2:1:1; do must "${ranks//:/-}" "$ranks" "${square[@]}" --set fluid.adapt.corner_size=0.0025; done
"$python" - "$scratch" <<'E2'
import numpy as np
from results import column, snapshots
SIZE, CORNER, HALF = 0.02, 0.0025, 0.125
def longest(corners, at):
    """The longest edge of the elements whose middles are within CORNER of a point."""
    near = np.hypot(*(corners.mean(axis=1) - at).T) < CORNER
    assert near.any(), "no element has its middle within %g m of (%g, %g)" % (CORNER, *at)
    edges = corners[near] - np.roll(corners[near], 1, axis=1)
    return np.hypot(edges[..., 0], edges[..., 1]).max()
def count(label):
    *_, (key, corners, areas, grid) = snapshots(label)
    return len(areas)
for label in ("1-1-1", "2-1-1"):
    for key, corners, areas, grid in list(snapshots(label))[1:]:  # the first mesh is of before the first step
        fine = np.sqrt(areas) < 0.4 * SIZE
        x, y = (column(label, "solid", k)[-1] for k in ("x0 [m]", "y0 [m]"))
        middles = corners[fine].mean(axis=1)
        beside = np.abs(middles[:, 0] - x) - HALF
        assert np.abs(beside).max() < 4.0 * SIZE, "%s: small elements %g m beside the square" % (label, np.abs(beside).max())
    for sx in (-1, 1):
        for sy in (-1, 1):
            found = longest(corners, (x + sx * HALF, y + sy * HALF))
            assert found < 3.0 * CORNER, "%s: edges of %g m at a corner" % (label, found)
    assert count(label) < 2.5 * count("without"), "%s: %d triangles, %d without corners" % (label, count(label), count("without"))
    fall = column(label, "coupler", "u_y [m/s]")[-1] / column("1-1-1", "coupler", "u_y [m/s]")[-1]
    assert abs(fall - 1.0) < 0.005, "%s: falls %g times as fast as on one rank" % (label, fall)
    print(label, count(label), count("without"), column(label, "coupler", "u_y [m/s]")[-1], column("without", "coupler", "u_y [m/s]")[-1])
E2
