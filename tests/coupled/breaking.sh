#!/usr/bin/env bash
# A small block in a channel, struck by a disc that is thrown: it comes apart and its pieces fly apart; momentum and energy balance, cracks cost their energy,
# files stay readable while nodes and elements grow in number, and two ranks of the solid agree.  Usage: breaking.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$root/cases/breaking_block/case.yaml
for ranks in 1:1:1 1:1:2; do
  must "${ranks//:/-}" "$ranks" --set time.end=0.3 --set "fluid.petsc=-momentum_ksp_rtol 1e-13" --set fluid.adapt.size_min=0.02 --set fluid.adapt.velocity_error=0.1 --set output.every=0.01 \
    --set 'fluid.boundaries.left={velocity: [0.5, 0.0], profile: parabolic, rise: 0.2}' \
    --set 'solid.bodies[0]={shape: rectangle, centre: [0.7, 0.08], width: 0.06, height: 0.16, size: 0.02, material: block, joints: all, fixed: [bottom]}' \
    --set 'solid.bodies[1]={shape: disc, centre: [0.45, 0.1], radius: 0.05, size: 0.02, material: projectile, prescribed: [{boundary: boundary, table: [[0.16, 0, 0], [0.2, 6, 0]], release: 0.2}]}'
done
"$python" "$root/scripts/momentum.py" "$scratch/1-1-1" --bound 1e-10 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
"$python" "$root/tests/coupled/breaking.py" "$root/cases/breaking_block" "$scratch/1-1-1" "$scratch/1-1-2"
