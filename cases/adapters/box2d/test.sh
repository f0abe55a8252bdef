#!/usr/bin/env bash
# One disc falls as FEMDEM's; heaps of a hundred are as high as FEMDEM's.  Usage: test.sh ROOT BUILD
set -euo pipefail
source "$1/tests/coupled/run.sh"
program=$("$root/cases/adapters/build.sh" box2d "$build")
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --solid "$program" "$root/tests/coupled/disc.yaml" --set "solid.walls={lower: [0, 0], upper: [2, 2]}"
tank=(--set time.end=0.3 --set 'solid.walls={lower: [0, 0], upper: [2, 2]}')
must femdem 1:1:1 "${tank[@]}"
must disc 1:1:2 "${tank[@]}" --solid "$program"
"$root/cases/adapters/compare.py" "$scratch/disc" "$scratch/femdem" 0.01

# The kept heaps are alike, and those of the first start, made anew, are such as they.
heaps=$root/cases/adapters/compare_heaps.py
"$python" "$heaps" check
"$python" "$heaps" run "$build" "$program" 1 "$scratch/heaps" || { tail -n 3 "$scratch"/heaps/*.log; exit 1; }
"$python" "$heaps" again "$scratch/heaps/heaps.csv"
