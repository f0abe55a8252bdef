#!/usr/bin/env bash
# Strengths that are lowered at a resume are those that joints have, also where they already carry more: a bar that is pulled by 10 kPa, at rest, tears along its middle with a
# tensile strength of 9 kPa, and bears with 11.  Usage: lowered.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: lowered
gravity: [0.0, 0.0]
time: {end: 0.2, dt_max: 0.005}
solid:
  decay_rate: 200.0
  materials: {rock: {density: 2000.0, youngs_modulus: 1.0e7, poisson_ratio: 0.0, damping: 0.2, tensile_strength: 1.0e6, shear_strength: 1.0e6, fracture_energy: 1.0}}
  bodies:
    - {shape: rectangle, centre: [0.0, 0.1], width: 0.2, height: 0.2, size: 0.05, material: rock, fixed: [bottom], joints: [{lower: [-1.0, 0.055], upper: [1.0, 0.145]}],
       loads: [{boundary: top, pressure: -1.0e4}]}
output: {folder: out/lowered, every: 1.0}
E2
alone rest "$scratch/case.yaml"
for strength in 0.9e4 1.1e4; do
  alone "at_$strength" "$scratch/case.yaml" --set "resume=$scratch/rest/checkpoint" --set time.end=0.4 --set "solid.materials.rock.tensile_strength=$strength"
done
"$python" - "$scratch" <<'E2'
from results import column
bars = {strength: (column("at_" + strength, "solid", "broken joints")[-1], column("at_" + strength, "solid", "pieces")[-1]) for strength in ("0.9e4", "1.1e4")}
assert bars["0.9e4"][0] >= 4 and bars["0.9e4"][1] == 2, "of a bar too weak %g joints are broken, it has %g pieces" % bars["0.9e4"]
assert bars["1.1e4"] == (0, 1), "of a bar strong enough %g joints are broken, it has %g pieces" % bars["1.1e4"]
assert abs(column("rest", "solid", "ry0 [N/m]")[-1]) < 20.0, "it is not at rest"
E2
