#!/usr/bin/env bash
# Water beside a fixed block whose sides lie along element edges, and whose top lies just below others, sloshes as faintly as it was pushed: none of
# what fills the block comes into it.  (Air came into elements beside the block, which nothing took out again, and drove a jet of 0.14 m/s.)
# Usage: aligned.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/aligned.yaml
must aligned 1:1:1
"$python" - "$scratch" <<'E2'
import numpy
from results import snapshots
for key, corners, areas, grid in snapshots("aligned"):
    under = (corners[:, :, 1].max(axis=1) < 0.45) & (grid["cell/alpha"][:] < 0.01)
    speed = numpy.hypot(*grid["node/velocity"][:][grid["cells"][:]][under][:, :, :2].reshape(-1, 2).T).max()
    air = (grid["cell/air"][:] - grid["cell/alpha"][:])[under].max()
    report = "snapshot %s: %.4f m/s, %.1e of an element is air under water" % (key, speed, air)
    print(report)
    assert speed < 0.015 and air < 1e-3, report
E2
