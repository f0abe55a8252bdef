#!/usr/bin/env bash
# A row of held discs that are tangent to each other, across a channel with 1000 Pa from one side to the other, in elements of 0.4 of a radius: the gaps, which are far narrower than an
# element, let through next to nothing.  (With all of the slip kept in an element between two held faces, what fills it ran with 2.2 m/s, and in a heap of stones on such
# a row without limit.)  Usage: row.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$scratch/row.yaml
cat >"$case" <<'E2'
case: row
gravity: [0.0, 0.0]
time: {end: 0.1, dt_max: 0.005, cfl: 1.0}
fluid:
  density: 1000.0
  viscosity: 0.001
  mesh: {lower: [-0.0003, -0.05], upper: [0.1003, 0.05], size_max: 0.02}
  adapt: {size_min: 0.004, size_max: 0.02, velocity_error: 0.02, every: 10}
  boundaries: {left: no_slip, right: no_slip, bottom: {pressure: 1000.0}, top: open}
solid:
  materials: {stone: {density: 2600.0, law: rigid, penalty: 1.0e6}}
  bodies:
    - {shape: disc, centre: [0.01, 0.0], radius: 0.01, size: 0.004, material: stone, fixed: true, repeat: {n: [5, 1], step: [0.02, 0.0]}}
coupler: {shell_thickness: 0.0002}
output: {folder: out/row, every: 0.02, checkpoint: 0}
E2
must row 1:1:1
"$python" - "$scratch/row/fluid.h5" <<'E2'
import sys
import h5py
import numpy as np
with h5py.File(sys.argv[1]) as file:
    for name in sorted(file["snapshot"]):
        grid = file["snapshot"][name]["velocity"]
        cells, speed = grid["cells"][:], np.linalg.norm(grid["node/velocity"][:], axis=1)
        at = grid["points"][:][cells].mean(axis=1)
        near = speed[cells].max(axis=1)[(abs(at[:, 0] - 0.05) < 0.035) & (abs(at[:, 1]) < 0.004)]
        report = "%.3f s: %.3f m/s at most and %.3f m/s on average in %d elements of the row" % (file["snapshot"][name].attrs["time"], near.max(), near.mean(), len(near))
        print(report)
        assert len(near) > 50 and near.max() < 1.0 and near.mean() < 0.12, report
E2
