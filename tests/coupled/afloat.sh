#!/usr/bin/env bash
# A block let go where it floats stays there: the air that steps leave below it does not lift it.
# Usage: afloat.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/afloat.yaml
must afloat 1:1:1
"$python" - "$scratch" <<'E2'
from results import column, snapshots
t, y, x = (column("afloat", "solid", name) for name in ("t [s]", "y0 [m]", "x0 [m]"))
late = [k for k, at in enumerate(t) if at > t[-1] - 1.0]
rises = sum(y[k] for k in late) / len(late) - 0.154
drifts = max(abs(x[k] - 0.2) for k in late)
*_, (_, corners, areas, grid) = snapshots("afloat")
deep = corners[:, :, 1].mean(axis=1) < 0.145 # the block's lower face is at 0.134
air = (areas * (1.0 - grid["cell/water"][:] - grid["cell/alpha"][:]))[deep].sum()
report = "rises by %.4f mm, drifts by %.3f mm, %.2f mm2 of air under water" % (1e3 * rises, 1e3 * drifts, 1e6 * air)
print(report)
assert abs(rises) < 1.5e-4 and drifts < 2e-3 and abs(air) < 5e-6, report
E2
