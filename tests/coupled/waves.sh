#!/usr/bin/env bash
# A wave maker: a piston that stands in the water moves as a table says, and the waves are those of potential theory (waves.py).  At the start there is
# no water where the piston is: what a region has there does not come out of it.  A piston that does not move leaves the water at rest, also with a
# surface tension that the mesh does not resolve (40 J/m of kinetic energy in half a second when what was held was to the pressure what fills it).
# Usage: waves.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/waves.yaml
must waves 1:1:1 --set "solid.bodies[0].prescribed=[{table: $("$python" "$here/waves.py")}]"
"$python" "$here/waves.py" "$scratch/waves" 0.1
must rest 2:1:2 --set time.end=0.1
must fixed 1:1:1 --set time.end=0.25 --set "solid.bodies[0]={shape: rectangle, centre: [0.3, 0.35], width: 0.1, height: 0.7, size: 0.02, material: steel, fixed: true}"
must tension 1:1:1 --set time.end=0.5 --set fluid.surface_tension=0.072
"$python" - "$scratch" <<'E2'
from results import column
for run in "rest", "fixed", "tension":
    kinetic = max(column(run, "fluid", "kinetic energy [J/m]"))
    print("%s: kinetic energy %.1e J/m" % (run, kinetic))
    assert kinetic < 1e-2, "%s: water in motion, kinetic energy %g J/m" % (run, kinetic)
E2
