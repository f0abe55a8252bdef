#!/usr/bin/env bash
# Joints on a physical curve with a material of their own: a bar of rock parts there and nowhere else, at their strength; what is pressed together there slides when more than their friction acts.
# Usage: bedding.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<E2
case: bedding
gravity: [8.0, 0.0]
time: {end: 0.5, dt_max: 0.01}
solid:
  materials:
    rock: {density: 1000.0, youngs_modulus: 1.0e7, poisson_ratio: 0.2, tensile_strength: 1.0e6, shear_strength: 1.0e6, fracture_energy: 100.0, damping: 0.5, penalty: 1.0e8}
    bedding: {law: joint, tensile_strength: 4.0e3, shear_strength: 4.0e3, fracture_energy: 0.5, internal_friction: 0.5, friction: 0.5, contact_damping: 0.3}
  bodies:
    - {mesh: $root/tests/solid/regions.msh, material: rock, fixed: [clamp], joints: [soft, {name: seam, material: bedding}]}
output: {folder: out/bedding, every: 1.0, checkpoint: 0}
E2
# 1 m2 of rock beyond the seam of 1 m hangs on it; at once, so that twice its weight acts
alone parts "$scratch/case.yaml"
alone holds "$scratch/case.yaml" --set 'gravity=[1, 0]'
alone rock "$scratch/case.yaml" --set 'solid.bodies[0].joints=[soft, seam]'
weak=(--set solid.materials.bedding.tensile_strength=1 --set solid.materials.bedding.shear_strength=1 --set solid.materials.bedding.fracture_energy=1e-6)
alone rests "$scratch/case.yaml" "${weak[@]}" --set 'gravity=[-10, -4]'
alone slides "$scratch/case.yaml" "${weak[@]}" --set 'gravity=[-10, -8]'
alone rough "$scratch/case.yaml" "${weak[@]}" --set 'gravity=[-10, -8]' --set solid.materials.bedding.friction=0.9
"$python" - "$scratch" <<'E2'
from results import column
last = lambda label, name: column(label, "solid", name)[-1]
for label, broken in (("parts", 1), ("holds", 0), ("rock", 0), ("rests", 1), ("slides", 1), ("rough", 1)):
    found = last(label, "broken joints")
    assert found == broken, "%s: %g joints are broken" % (label, found)
speed = -2.0*last("slides", "v0 [m/s]") # of the half that moves
assert 0.9 < speed/((8 - 0.5*10)*0.5) < 1.15, "slides with %g m/s" % speed
for label in ("rests", "rough"):
    assert abs(last(label, "v0 [m/s]")) < 0.1, "%s: slides with %g m/s" % (label, last(label, "v0 [m/s]"))
E2
