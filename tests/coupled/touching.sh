#!/usr/bin/env bash
# Two blocks that touch in one fluid of a two thousandth of their density have no energy from it: a block falls on another one at two angles, and slides over it.
# (With an inertia in the elements between them that was more than the blocks' own, 4 J became 5e6 J, and a nearly flat blow added 1.7 J.)
# Usage: touching.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/touching.yaml
must corner 1:1:1 --set time.walltime=60
must flat 1:1:1 --set time.walltime=60 --set "solid.bodies[1].angle=0.2"
must slides 1:1:1 --set time.walltime=60 --set time.end=0.03 --set time.dt_max=0.0005 --set "solid.bodies[0].width=0.3" \
  --set "solid.bodies[1].centre=[0.12, 0.0615]" --set "solid.bodies[1].angle=0.0" --set "solid.bodies[1].velocity=[2.0, 0.0]"
"$python" - "$scratch" <<'E2'
from results import rows
for label, end in ("corner", 0.22), ("flat", 0.22), ("slides", 0.03):
    steps = rows(label, "solid")
    work = sum(max(0.0, row["work [J/m]"]) for row in steps)
    report = "%s: %d steps to %.3f s, the fluid does %.4f J/m of positive work" % (label, len(steps), steps[-1]["t [s]"], work)
    print(report)
    assert steps[-1]["t [s]"] > 0.999 * end and work < 0.1, report
E2
