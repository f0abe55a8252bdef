#!/usr/bin/env bash
# A body held at rest in a fluid at rest feels rho g V.  Usage: held.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must held 1:1:1 --set 'solid.bodies[0].fixed=true'
"$python" - "$scratch" <<'E2'
import math
from results import rows
weight = 1000 * 9.81 * math.pi * 0.125**2
for row in rows("held", "coupler"):
    x, y = row["F_x [N]"], row["F_y [N]"]
    assert abs(y / weight - 1) < 1e-3 and abs(x) < 1e-3 * weight, "t %s: force (%g, %g), buoyancy %g" % (row["t [s]"], x, y, weight)
E2
