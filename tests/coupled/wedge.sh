#!/usr/bin/env bash
# Prints the contact force across the slope on a wedge that slides on a held body under water, N/m, mean of 6 steps up to 0.1 s, and its speed: the rows of
# README.md that name no wall.  No test: what it should be, 867 N/m, is not reached.  Usage: wedge.sh ROOT BUILD air|HEIGHT [launch.sh arguments]
# air: water is 1.45 m deep, with air above it; HEIGHT: water alone up to there, m
set -euo pipefail
source "$(dirname "$0")/run.sh"
cp "$here"/wedge*.geo "$here/wedge.yaml" "$scratch"
for mesh in wedge wedge_slope; do gmsh -2 "$scratch/$mesh.geo" -o "$scratch/$mesh.msh" >/dev/null; done
if [[ $1 == air ]]; then
  fluids=(--set 'fluid.phases=[{name: air, density: 1.2, viscosity: 1.8e-5}, {name: water, density: 1000.0, viscosity: 1.0e-3}]'
    --set 'fluid.regions=[{phase: air}, {phase: water, lower: [0.0, 0.0], upper: [5.0, 1.45]}]')
else
  fluids=(--set fluid.density=1000 --set fluid.viscosity=1e-3 --set "fluid.mesh.upper=[5.0, $1]")
fi
case=$scratch/wedge.yaml must wedge 1:1:1 --set time.end=0.1 "${fluids[@]}" "${@:2}"
"$python" - "$scratch" <<'E2'
import math
from results import rows
late = rows("wedge", "solid")[-6:]
fluid = sum(row["fx0 [N/m]"] + row["fy0 [N/m]"] for row in late) / len(late) / math.sqrt(2.0)
last = late[-1]
print("contact %.0f N/m, %.4f m/s along the slope" % (250.0 * 9.81 / math.sqrt(2.0) - fluid, (last["u0 [m/s]"] - last["v0 [m/s]"]) / math.sqrt(2.0)))
E2
