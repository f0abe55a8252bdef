#!/usr/bin/env bash
# More bodies than solid.csv has columns for: the snapshots have all of them as points, with what the series has of the first, on any ranks, and
# output.series_every thins the rows.  Usage: many.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: many
gravity: [0.0, -9.81]
time: {end: 0.05, dt_max: 0.002}
solid:
  walls: {lower: [0, 0], upper: [5, 5]}
  materials: {stone: {density: 2000.0, law: rigid, penalty: 1.0e7, friction: 0.5, contact_damping: 0.3}}
  bodies:
    - {shape: disc, centre: [0.06, 0.05], radius: 0.05, size: 0.04, material: stone, repeat: {n: [40, 30], step: [0.12, 0.11]}}
output: {folder: out/many, every: 0.05, series_every: 0.01, checkpoint: 0}
E2
for ranks in 1 2; do alone "$ranks" "$scratch/case.yaml" --ranks "1:1:$ranks"; done
"$python" - "$scratch" <<'E2'
import sys
import h5py
import numpy as np
from results import column
last = []
for ranks in ("1", "2"):
    times = column(ranks, "solid", "t [s]")
    assert np.allclose(times, [0.002, 0.01, 0.02, 0.03, 0.04, 0.05], atol=1e-9), "rows at %s" % times
    with h5py.File("%s/%s/solid.h5" % (sys.argv[1], ranks)) as file:
        snapshots = file["snapshot"]
        assert len(snapshots) == 2, "%d snapshots" % len(snapshots)
        grid = snapshots[max(snapshots)]["bodies"]
        points, node = grid["points"][:], {name: field[:] for name, field in grid["node"].items()}
    assert points.shape == (1200, 2), points.shape
    for name, of in (("x%d [m]", points[:, 0]), ("v%d [m/s]", node["velocity"][:, 1]), ("cy%d [N/m]", node["contact"][:, 1]), ("mass%d [kg/m]", node["mass"])):
        for body in (0, 40, 999):
            there = column(ranks, "solid", name % body)[-1]
            assert abs(of[body] - there) < 1e-8*max(1.0, abs(there)), "%s: %.12g, %.12g in the series" % (name % body, of[body], there)
    momentum = (node["mass"]*node["velocity"][:, 1]).sum()
    there = column(ranks, "solid", "momentum_y [N s/m]")[-1]
    assert abs(momentum/there - 1) < 1e-8, "momentum of the points %.12g, %.12g in the series" % (momentum, there)
    last.append(points)
assert np.abs(last[0] - last[1]).max() < 1e-9, "ranks differ by %g m" % np.abs(last[0] - last[1]).max()
E2
