#!/usr/bin/env bash
# A half-sunk block floats at Archimedes' draught, upright, on a force that is its weight; no water inside, and what is around it
# stays at rest (0.02 J/m of kinetic energy without the solid's forces in FluidPredictPressure).
# Usage: floating.sh ROOT BUILD [long]     long: half the size, to the bounds of issue 12
set -euo pipefail
long=${3:-}
source "$(dirname "$0")/run.sh"
case=$here/floating.yaml
if [ "$long" ]; then
  limit=1200
  must rest 1:1:1 --set fluid.adapt.size_min=0.006 --set time.dt_max=0.001
else
  must rest 1:1:1 --set time.end=0.5
fi
"$python" - "$scratch" "$long" <<'E2'
import numpy as np, sys
from results import rows, snapshots
long = sys.argv[2]
TANK, WIDTH, HEIGHT, LEVEL, WATER, AIR, G = 0.6, 0.12, 0.06, 0.2, 1000.0, 1.2, 9.81
DRAUGHT, WEIGHT = 0.5 * HEIGHT, 500.0 * WIDTH * HEIGHT * G
def column(name, part):
    return np.array([row[name] for row in rows("rest", part)])
t, y, force = (column(name, "solid") for name in ("t [s]", "y0 [m]", "fy0 [N/m]"))
# it starts where it floats, at rest, and stays there but for a little heave
late = t > 0.5 * t[-1]
draught = DRAUGHT + (LEVEL - y[late].mean()) / (1.0 - WIDTH / TANK)  # the level rises with it
mean = np.average(force[1:], weights=np.diff(t))
tilt = abs(column("left_y [m]", "solid_probes") - column("right_y [m]", "solid_probes")).max() / WIDTH
inside = 0.0
for _, _, area, velocity in snapshots("rest"):
    inside = max(inside, (area * np.maximum(velocity["cell/water"][:] + velocity["cell/alpha"][:] - 1.0, 0.0)).sum())
kinetic = column("kinetic energy [J/m]", "fluid").max()
error = (draught / DRAUGHT - 1.0, mean / WEIGHT - 1.0, tilt, inside / (WIDTH * HEIGHT), kinetic)
bound = (0.005, 0.001, 0.005, 1e-6, 2e-4) if long else (0.015, 0.005, 0.005, 1e-6, 5e-3)
report = "draught %+.2g, force %+.2g, tilt %.2g, water inside %.2g, kinetic energy %.2g J/m" % error
if long: print(report)
assert all(abs(e) < b for e, b in zip(error, bound)), report
E2
