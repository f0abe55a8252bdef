#!/usr/bin/env bash
# The coupling has no length of a step in it: a disc falls alike with steps of 5 ms and a quarter of that.  It did not while each step
# mixed the solid's velocity into the fluid beside it (coupler/slip.h): 3.3 % slower with the short steps.
# Usage: time_step.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must long 1:1:1 --set solid.materials.disc.density=1050 --set time.dt_max=0.005
must short 1:1:1 --set solid.materials.disc.density=1050 --set time.dt_max=0.00125
"$python" - "$scratch" <<'E2'
import csv, sys
u = [float(list(csv.DictReader(open("%s/%s/coupler.csv" % (sys.argv[1], label))))[-1]["u_y [m/s]"]) for label in ("long", "short")]
assert abs(u[1] / u[0] - 1) < 0.006, "velocities with long and short steps: %s" % u
E2
