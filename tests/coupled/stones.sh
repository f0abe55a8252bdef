#!/usr/bin/env bash
# 24 stones, discs and turned squares, are dumped through 0.4 m of water, pile up, come to rest and press on the floor with their weight less the displaced
# water's; momentum and water are kept.  Usage: stones.sh ROOT BUILD
set -euo pipefail
limit=3000
source "$(dirname "$0")/run.sh"
case=$here/stones.yaml
stones=$("$python" - <<'E2'
import random
random.seed(3)
stones = []
for k in range(24):
    centre = "centre: [%.4f, %.4f]" % (0.3 + 0.075 * (k % 6) + 0.01 * random.random(), 0.05 + 0.075 * (k // 6))
    shape = "shape: disc, radius: 0.03" if k % 2 else "shape: rectangle, width: 0.045, height: 0.045, angle: %.3f" % random.random()
    stones.append("{%s, %s, size: 0.015, material: rock}" % (shape, centre))
print("[%s]" % ", ".join(stones))
E2
)
must stones 1:1:1 --set "solid.bodies=$stones"
"$python" "$root/scripts/momentum.py" "$scratch/stones" --bound 1e-7 >"$scratch/report" || { cat "$scratch/report"; exit 1; }
"$python" - "$scratch" <<'E2'
import math
from results import rows
series = rows("stones", "solid")
last, first = series[-1], next(k for k, row in enumerate(series) if row["t [s]"] > series[-1]["t [s]"] - 0.4)
force = sum(row["walls_y [N s/m]"] for row in series[first:]) / (last["t [s]"] - series[first - 1]["t [s]"])
weight = 12 * (math.pi * 0.03 ** 2 + 0.045 ** 2) * 1600.0 * 9.81
speed = max(math.hypot(last["u%d [m/s]" % b], last["v%d [m/s]" % b]) for b in range(24))
made = max(abs(row["water made [m2]"]) for row in rows("stones", "fluid"))
report = "%.1f N/m on the floor, of %.1f; the fastest stone has %.1f mm/s; water made %.1e m2" % (force, weight, 1e3 * speed, made)
print(report)
assert abs(force / weight - 1.0) < 0.05 and speed < 1e-2 and made < 1e-9, report
E2
