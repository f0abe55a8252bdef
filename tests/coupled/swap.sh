#!/usr/bin/env bash
# Another solid in place of ours, one page of C: the rigid disc falls as the elastic one.  Usage: swap.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
must ours 1:1:1 --set time.end=0.3
must other 1:1:2 --set time.end=0.3 --solid "$build/tests/route/rigid_disc"
"$python" - "$scratch" <<'E2'
from results import column
u = [column(k, "coupler", "u_y [m/s]")[-1] for k in ("ours", "other")]
assert abs(u[0] / u[1] - 1) < 0.01, "ours falls at %g, the other at %g" % tuple(u)
E2
