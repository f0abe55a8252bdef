#!/usr/bin/env bash
# Prints the contact force across the slope on a wedge that slides on a held body under water and air, N/m, mean of 6 steps up to 0.1 s, and its speed: the
# rows of README.md that name no wall.  No test: what it should be, 867 N/m, is not reached.  Usage: wedge.sh ROOT BUILD [launch.sh arguments]
set -euo pipefail
source "$(dirname "$0")/run.sh"
cp "$here"/wedge*.geo "$here/wedge.yaml" "$scratch"
for mesh in wedge wedge_slope; do gmsh -2 "$scratch/$mesh.geo" -o "$scratch/$mesh.msh" >/dev/null; done
case=$scratch/wedge.yaml must wedge 1:1:1 --set time.end=0.1 "$@"
"$python" - "$scratch" <<'E2'
import math
from results import rows
late = rows("wedge", "solid")[-6:]
fluid = sum(row["fx0 [N/m]"] + row["fy0 [N/m]"] for row in late) / len(late) / math.sqrt(2.0)
last = late[-1]
print("contact %.0f N/m, %.4f m/s along the slope" % (250.0 * 9.81 / math.sqrt(2.0) - fluid, (last["u0 [m/s]"] - last["v0 [m/s]"]) / math.sqrt(2.0)))
E2
