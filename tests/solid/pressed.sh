#!/usr/bin/env bash
# The strength of a jointed rock pressed between platens without friction, over Mohr and Coulomb's: a row of README.md.
# Usage: pressed.sh ROOT BUILD G_II EDGE SIDES [launch.sh arguments]      J/m2, m, MPa on the sides; peak of the mean of five rows of solid.csv
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
energy=$3 edge=$4 sides=$5
shift 5
cat >"$scratch/rock.geo" <<'E2'
w = 0.05; h = 0.1;
Point(1) = {-w/2, -h/2, 0, s}; Point(2) = {w/2, -h/2, 0, s}; Point(3) = {w/2, h/2, 0, s}; Point(4) = {-w/2, h/2, 0, s};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("left") = {4}; Physical Curve("right") = {2}; Physical Surface("rock") = {1};
E2
gmsh -2 -algo del2d -setnumber s "$edge" "$scratch/rock.geo" -o "$scratch/rock.msh" >/dev/null
cat >"$scratch/pressed.yaml" <<E2
case: pressed
gravity: [0.0, 0.0]
time: {end: $([ "$sides" = 0 ] && echo 1.2e-3 || echo 1.8e-3), dt_max: 4.0e-6}
solid:
  materials:
    rock: {density: 2600.0, youngs_modulus: 2.0e10, poisson_ratio: 0.2, damping: 0.3, friction: 0.5, tensile_strength: 5.0e6, shear_strength: 1.0e7,
           internal_friction: 0.7, fracture_energy: 50.0, shear_fracture_energy: $energy}
    steel: {density: 7800.0, youngs_modulus: 5.0e10, poisson_ratio: 0.3, damping: 0.3}
  contact: [{between: [rock, steel], friction: 0.0, damping: 0.0}]
  bodies:
    - {mesh: rock.msh, material: rock, joints: all, loads: [{boundary: left, pressure: [[0, 0], [1.0e-4, ${sides}.0e6]]}, {boundary: right, pressure: [[0, 0], [1.0e-4, ${sides}.0e6]]}]}
    - {shape: rectangle, centre: [0.0, -0.056], width: 0.07, height: 0.012, size: 0.006, material: steel, prescribed: [{velocity: [0.0, 0.15], rise: 2.0e-4}]}
    - {shape: rectangle, centre: [0.0, 0.056], width: 0.07, height: 0.012, size: 0.006, material: steel, prescribed: [{velocity: [0.0, -0.15], rise: 2.0e-4}]}
output: {folder: out/pressed, every: 1.0}
E2
"$root/scripts/launch.sh" --bin "$build" --alone --ranks 1:1:1 "$scratch/pressed.yaml" --set "output.folder=$scratch/out" "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
"$python" - "$scratch/out/solid.csv" "$sides" <<'E2'
import csv, math, sys
force = [-float(row["ry2 [N/m]"]) for row in csv.DictReader(open(sys.argv[1]))]
peak = max(sum(force[k:k + 5]) for k in range(len(force) - 4)) / 5 / 0.05
passive = math.tan(math.pi / 4 + math.atan(0.7) / 2)
theory = 2.0 * 10.0e6 * passive + float(sys.argv[2]) * 1e6 * passive ** 2
print("%.1f MPa, %.2f of Mohr and Coulomb's" % (peak / 1e6, peak / theory))
E2
