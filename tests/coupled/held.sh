#!/usr/bin/env bash
# A body held at rest in a fluid at rest feels rho g V.  Usage: held.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must held 1:1:1 --set 'solid.bodies[0].fixed=true'
"$python" - "$scratch/held/coupler.csv" <<'E2'
import csv, math, sys
rows = list(csv.DictReader(open(sys.argv[1])))
weight = 1000 * 9.81 * math.pi * 0.125**2
for row in rows:
    x, y = float(row["F_x [N]"]), float(row["F_y [N]"])
    assert abs(y / weight - 1) < 1e-3 and abs(x) < 1e-3 * weight, "t %s: force (%g, %g), buoyancy %g" % (row["t [s]"], x, y, weight)
E2
