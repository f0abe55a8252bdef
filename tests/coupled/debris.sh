#!/usr/bin/env bash
# A stone breaks in water; when its fragments have come to rest the water does, too.  Between fragments as small as elements it was set in motion again (slip.h, 2).
# Usage: debris.sh ROOT BUILD [long]     long: in a fluid of five times the viscosity, too
set -euo pipefail
source "$(dirname "$0")/run.sh"
cp "$here/debris.yaml" "$scratch/debris.yaml"
gmsh -2 "$here/debris.geo" -o "$scratch/debris.msh" >/dev/null
case=$scratch/debris.yaml must thin 1:1:1 --set fluid.viscosity=0.01
[[ ${1:-} != long ]] || case=$scratch/debris.yaml must debris 1:1:1
"$python" - "$scratch" <<'E2'
import os, sys
from statistics import median
from results import column, rows
for label in ("debris", "thin"):
    if not os.path.exists(sys.argv[1] + "/" + label): continue
    t, energy, speed = (column(label, "fluid", key) for key in ("t [s]", "kinetic energy [J/m]", "max speed [m/s]"))
    def within(values, start, end):
        return [v for a, v in zip(t, values) if start <= a <= end]
    broken = rows(label, "solid")[-1]["broken joints"]
    before, last, fastest = median(within(energy, 2.0, 2.2)), median(within(energy, 2.8, 3.0)), median(within(speed, 2.5, 3.0))
    report = "%s: %d broken joints; energy %.3g J/m, then %.3g; %.2g m/s" % (label, broken, before, last, fastest)
    print(report)
    assert broken > 10 and last < before and fastest < 0.7, report
E2
