#!/usr/bin/env bash
# A piston with plane faces moves through water and air in a box, whose vertices stand in columns: no step's force stands out where a face passes a column.  It did by 119 N of 46
# (coupler/terms/slip.c, PHASES_LEAST).  Usage: piston.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/piston.yaml must piston 1:1:1
"$python" - "$scratch" <<'E2'
from results import column
t, force = column("piston", "coupler", "t [s]"), column("piston", "coupler", "F_x [N]")
steady = [k for k in range(1, len(t) - 1) if t[k - 1] > 0.3]  # it moves with one velocity from then on
apart = max(abs(force[k] - 0.5 * (force[k - 1] + force[k + 1])) for k in steady)
assert len(steady) > 40 and apart < 6.0, "a step's force is %.1f N from that of its neighbours, of at most %.1f N" % (apart, max(map(abs, force)))
E2
