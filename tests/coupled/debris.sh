#!/usr/bin/env bash
# A stone breaks in water; when its fragments have come to rest the water does, too.  Between fragments as small as elements it was set in motion again (slip.h, 2).
# Usage: debris.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
cp "$here/debris.yaml" "$scratch/debris.yaml"
gmsh -2 "$here/debris.geo" -o "$scratch/debris.msh" >/dev/null
case=$scratch/debris.yaml must debris 1:1:1
"$python" - "$scratch" <<'E2'
from results import column, rows
t, energy, speed = (column("debris", "fluid", key) for key in ("t [s]", "kinetic energy [J/m]", "max speed [m/s]"))
def within(values, start, end):
    return [v for a, v in zip(t, values) if start <= a <= end]
broken = rows("debris", "solid")[-1]["broken joints"]
before, last, fastest = max(within(energy, 2.0, 2.2)), max(within(energy, 2.8, 3.0)), max(within(speed, 2.5, 3.0))
report = "%d broken joints; energy %.3g J/m, then %.3g; at most %.2g m/s" % (broken, before, last, fastest)
assert broken > 10 and last < 0.9 * before and fastest < 0.7, report
E2
