#!/usr/bin/env bash
# The budget of momentum of fluid and solids together closes in each step to 1e-10 of its terms: a disc that falls, on one rank and on two, a bar that cracks, a column of
# water that collapses onto a square, meshes that adapt; a solid alone.  Usage: momentum.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
tight=(--set "fluid.petsc=-momentum_ksp_rtol 1e-13")
must disc 1:1:1 "${tight[@]}"
must two 2:1:2 "${tight[@]}"
must crack 1:1:1 "${tight[@]}" --set "solid.materials.disc=$brittle" --set "solid.bodies[0]=$bar" --set time.end=0.3
case=$here/phases.yaml
must column 1:1:1 "${tight[@]}" --set time.end=0.06
for label in disc two crack column; do "$python" "$root/scripts/momentum.py" "$scratch/$label" --bound 1e-10 || { echo "$label is not closed"; exit 1; }; done >"$scratch/report" || { cat "$scratch/report"; exit 1; }
# a block that slides on a floor, without a fluid
case=$root/tests/solid/alone.yaml must alone 1:1:2 --alone
"$python" "$root/scripts/momentum.py" "$scratch/alone" --bound 1e-11 >"$scratch/report" && grep -q "solids' walls" "$scratch/report" || { cat "$scratch/report"; exit 1; }
awk -F, 'NR == 1 {for (k = 1; k <= NF; k++) if ($k == "broken joints") c = k} END {exit !($c > 0)}' "$scratch/crack/solid.csv" || { echo "nothing has cracked"; exit 1; }
