#!/usr/bin/env bash
# Prints the contact force across the slope on a wedge that slides under water on a held body or on a wall, N/m, mean of 6 steps, and its speed at 0.1,
# 0.2 ... s: the rows of README.md, beside wedge_reference.py; without arguments in water alone, with short steps, and beneath air, where what is in the elements that
# both solids share used to press on both.  Usage: wedge.sh ROOT BUILD [wall|air|HEIGHT|floor|slab [launch.sh arguments]]
# wall, air: water is 1.45 m deep, with air above it; HEIGHT: water alone up to there, m; wall: all is turned by 45 degrees, so that the slope is a wall
# floor, slab: turned, too, in a closed tank of water alone whose floor the slope is, or a held slab on its floor
set -euo pipefail
source "$(dirname "$0")/run.sh"
if ((!$#)); then
  bash "$0" "$root" "$build" 1.9 --set time.dt_max=0.001
  bash "$0" "$root" "$build" air
  exit
fi
cp "$here"/wedge*.geo "$here/wedge.yaml" "$scratch"
turned=$([[ $1 == wall || $1 == floor || $1 == slab ]] && echo 1 || echo 0)
for mesh in wedge wedge_slope wedge_water; do gmsh -2 -setnumber turned "$turned" "$scratch/$mesh.geo" -o "$scratch/$mesh.msh" >/dev/null; done
water='lower: [0.0, 0.0], upper: [5.0, 1.45]' case=$scratch/wedge.yaml sets=()
bodies='{mesh: wedge.msh, material: rock}' one=(--set fluid.density=1000 --set fluid.viscosity=1e-3)
phases=(--set 'fluid.phases=[{name: air, density: 1.2, viscosity: 1.8e-5}, {name: water, density: 1000.0, viscosity: 1.0e-3}]')
((!turned)) || sets=(--set 'gravity=[6.936717523440031, -6.936717523440031]')
case $1 in
  wall)
    water='point: [0.0, 1.470710678118655], normal: [-1.0, 1.0]' # 0.05 sqrt(2) above (0, 1.4), about which all is turned
    sets+=("${phases[@]}" --set 'fluid.mesh={file: wedge_water.msh}' --set 'fluid.boundaries.slope=free_slip' --set "solid.bodies=[$bodies]"
      --set 'solid.walls={lower: [-10.0, 1.4], upper: [10.0, 10.0]}') ;;&
  floor) lower=1.4 ;;&
  slab) lower=1.0 bodies+=', {shape: rectangle, centre: [1.1, 1.2], width: 3.0, height: 0.4, size: 0.06, material: rock, fixed: true}' ;;&
  floor | slab)
    tank="lower: [-0.4, $lower], upper: [2.6, 3.0]"
    sets+=("${one[@]}" --set "fluid.mesh={$tank, size_max: 0.15}" --set fluid.boundaries.top=free_slip --set "solid.bodies=[$bodies]" --set "solid.walls={$tank}") ;;
  air) sets+=("${phases[@]}") ;;&
  wall | air) sets+=(--set "fluid.regions=[{phase: air}, {phase: water, $water}]") ;;
  *) sets+=("${one[@]}" --set "fluid.mesh.upper=[5.0, $1]") ;;
esac
must wedge 1:1:1 --set time.end=0.1 "${sets[@]}" "${@:2}"
"$python" - "$scratch" "$1" "$turned" <<'E2'
import math, sys
from results import rows
kind, slope = sys.argv[2], 0.0 if sys.argv[3] == "1" else -math.pi / 4
expected = {"1.9": 831.0, "floor": 832.0, "slab": 832.0}.get(kind, 826.0)  # wedge_reference.py 1.9|tank|1.45 0.1
run = rows("wedge", "solid")
for k in range(1, round(run[-1]["t [s]"] / 0.1) + 1):
    late = [row for row in run if row["t [s]"] < 0.1 * k + 1e-6][-6:]
    fluid = sum(row["fy0 [N/m]"] * math.cos(slope) - row["fx0 [N/m]"] * math.sin(slope) for row in late) / len(late)
    speed = late[-1]["u0 [m/s]"] * math.cos(slope) + late[-1]["v0 [m/s]"] * math.sin(slope)
    contact = 250.0 * 9.81 / math.sqrt(2.0) - fluid
    print("%s, %.1f s: contact %.0f N/m, %.4f m/s along the slope" % (kind, 0.1 * k, contact, speed))
    assert k > 1 or abs(contact / expected - 1.0) < (0.2 if kind in ("wall", "air") else 0.15), "%.0f N/m expected" % expected
E2
