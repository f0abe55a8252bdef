#!/usr/bin/env bash
# One disc falls as FEMDEM's; a hundred settle as high as FEMDEM's.  Usage: test.sh ROOT BUILD
set -euo pipefail
source "$1/tests/coupled/run.sh"
program=$("$root/cases/adapters/build.sh" box2d "$build")
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --solid "$program" "$root/tests/coupled/disc.yaml" --set "solid.walls={lower: [0, 0], upper: [2, 2]}"
tank=(--set time.end=0.3 --set 'solid.walls={lower: [0, 0], upper: [2, 2]}')
must femdem 1:1:1 "${tank[@]}"
must disc 1:1:2 "${tank[@]}" --solid "$program"
"$root/cases/adapters/compare.py" "$scratch/disc" "$scratch/femdem" 0.01

case=$root/cases/adapters/box2d/case.yaml
must hundred 1:1:1 --solid "$program"
"$python" - "$scratch/hundred" <<'E2'
import csv, json, sys
solid = json.load(open(sys.argv[1] + "/summary.json"))["participants"]["solid"]
speed = abs(float(list(csv.DictReader(open(sys.argv[1] + "/coupler.csv")))[-1]["u_y [m/s]"]))
height, reference = solid["mean_height"], 0.521  # FEMDEM's, README.md
print(f"mean height {height:.4f} m, FEMDEM {reference} m; mean speed {speed:.4f} m/s; deepest overlap {solid['overlap']:.4f} radii")
assert abs(height / reference - 1) < 0.03 and speed < 0.02 and solid["overlap"] < 0.02
E2
