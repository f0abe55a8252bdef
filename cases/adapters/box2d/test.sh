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

# Packings of discs are random: starts 1 mm apart give heights with a standard deviation of 2 % (Box2D) and 1 % (FEMDEM), so that the fractions of
# the heap that is solid may differ by three times both together.
case=$root/cases/adapters/box2d/case.yaml
must hundred 1:1:1 --solid "$program"
limit=600 must femdem_hundred 1:1:1
"$python" - "$scratch" <<'E2'
import csv, json, math, sys
START, WIDTH, RADIUS, SIDES = 1.155, 2.0, 0.07, 18  # mean height at the start, the tank, the discs of case.yaml; sides of FEMDEM's
def heap(run, area):
    """Mean height after the last step, fraction of the heap that is solid, and the last velocity."""
    rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(f"{sys.argv[1]}/{run}/coupler.csv"))]
    u = [0.0] + [row["u_y [m/s]"] for row in rows]
    height = START + sum(0.5 * (a + b) * row["dt [s]"] for a, b, row in zip(u, u[1:], rows))
    return height, 100 * area / (2 * WIDTH * height), u[-1]
ours = heap("hundred", math.pi * RADIUS**2)
femdem = heap("femdem_hundred", 0.5 * SIDES * RADIUS**2 * math.sin(2 * math.pi / SIDES))
overlap = json.load(open(sys.argv[1] + "/hundred/summary.json"))["participants"]["solid"]["overlap"]
for name, (height, fraction, speed) in (("Box2D", ours), ("FEMDEM", femdem)):
    print(f"{name}: mean height {height:.4f} m, solid fraction {fraction:.3f}, mean velocity {speed:.4f} m/s")
assert abs(ours[1] / femdem[1] - 1) < 0.06 and abs(ours[2]) < 0.02 and overlap < 0.02, overlap
E2
