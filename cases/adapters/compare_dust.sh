#!/usr/bin/env bash
# A template of a fluid keeps the contract, and a disc falls in it as in the one in C.  Usage: compare_dust.sh NAME ROOT BUILD
set -euo pipefail
name=$1
source "$2/tests/coupled/run.sh" "${@:2}"
program=$("$root/cases/adapters/build.sh" "$name" "$build")
mesh=(--set "fluid.mesh={lower: [0.0, 0.0], upper: [2.0, 2.0], size_max: 0.05}")
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --fluid "$program" "$root/tests/coupled/disc.yaml" "${mesh[@]}"
for density in 2000 300; do # one begins with a velocity
  sets=("${mesh[@]}" --set "solid.bodies[0].velocity=[1.0, 0.0]" --set solid.materials.disc.density=$density --set time.end=0.05)
  must c$density 1:1:1 "${sets[@]}" --fluid "$build/tests/route/dust"
  must other$density 2:1:1 "${sets[@]}" --fluid "$program"
  "$root/cases/adapters/compare.py" "$scratch/other$density" "$scratch/c$density" 1e-6
done
# the dust inside moves with the disc from the start: at rest it would halve the heavy disc's velocity in the first step
awk -F, 'NR == 2 {exit !($3 > 0.75)}' "$scratch/other2000/coupler.csv" || { echo 'the disc has lost its velocity'; exit 1; }
awk -F, 'NR > 1 && $NF > 1 {redone = 1} END {exit !redone}' "$scratch/other300/coupler.csv" || { echo 'no step was redone'; exit 1; }
