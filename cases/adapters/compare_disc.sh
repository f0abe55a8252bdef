#!/usr/bin/env bash
# An adapter's disc falls as that of template_c, also when it is so light that steps are redone.  Usage: compare_disc.sh NAME ROOT BUILD
set -euo pipefail
name=$1
shift
source "$1/tests/coupled/run.sh"
program=$("$root/cases/adapters/build.sh" "$name" "$build")
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --solid "$program" "$root/tests/coupled/disc.yaml"
for density in 2000 300; do
  must c$density 1:1:1 --set solid.materials.disc.density=$density --set time.end=0.05 --solid "$build/tests/route/rigid_disc"
  must other$density 1:1:2 --set solid.materials.disc.density=$density --set time.end=0.05 --solid "$program"
  "$root/cases/adapters/compare.py" "$scratch/other$density" "$scratch/c$density" 1e-6
done
awk -F, 'NR > 1 && $NF > 1 {redone = 1} END {exit !redone}' "$scratch/other300/coupler.csv" || { echo 'no step was redone'; exit 1; }
