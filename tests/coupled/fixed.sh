#!/usr/bin/env bash
# Water that strikes a block that does not move keeps its volume, and no element holds more than its area: what moves the phases is the
# velocity that the projection has made free of divergence.  Usage: fixed.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/fixed.yaml
must one 1:1:1
"$python" - "$scratch/one" <<'E2'
import h5py, numpy as np, sys
WATER, BLOCK = 0.04, 0.0036
grid, covered = h5py.File(sys.argv[1] + "/fluid.h5")["snapshot"], 0.0
for key in sorted(grid):
    velocity = grid[key]["velocity"]
    if "points" in velocity:
        x, cells = velocity["points"][:], velocity["cells"][:]
    a, b, c = (x[cells[:, k]] for k in range(3))
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    water, solid = velocity["cell/water"][:], velocity["cell/alpha"][:]
    made, inside = abs((area * water).sum() / WATER - 1.0), (area * np.maximum(water + solid - 1.0, 0.0)).sum() / BLOCK
    report = "%s: water made %.1e of it, inside %.1e of the block, fractions %.1e to 1 %+.1e" % (key, made, inside, water.min(), water.max() - 1.0)
    assert made < 1e-8 and inside < 1e-8 and water.min() > -1e-8 and water.max() < 1.0 + 1e-8, report
    wet = water[(x[cells][:, :, 0].mean(1) > 0.3)]
    covered = max(covered, wet.max())
assert covered > 0.9, "the water has not come to the block"
E2
