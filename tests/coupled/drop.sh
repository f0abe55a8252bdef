#!/usr/bin/env bash
# Discs and squares of 0.1 to 6 times the water's density are dropped into water: each enters; light ones float, heavy ones sink to the
# floor; no water is inside, none is made, momentum is closed, none drifts aside.
# Usage: [print=1] drop.sh ROOT BUILD SHAPE [DENSITY...]
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/drop.yaml shape=$1
shift
square="solid.bodies[0]={shape: rectangle, centre: [0.2, 0.25], width: 0.06, height: 0.06, size: 0.015, material: body}"
[ $# -gt 0 ] || set -- 100 500 2000 6000
for rho; do
  arguments=(--set "solid.materials.body.density=$rho")
  [ "$shape" = disc ] || arguments+=(--set "$square")
  must "$rho" 1:1:1 "${arguments[@]}"
done
"$python" - "$scratch" ${print:+print} <<'E2'
import numpy as np, os, sys
from results import rows, snapshots
G, LEVEL, HALF = 9.81, 0.2, 0.03
def column(label, part, name):
    return np.array([row[name] for row in rows(label, part)])
def inside(label):
    largest = 0.0
    for _, _, area, velocity in snapshots(label):
        solid = (area * velocity["cell/alpha"][:]).sum()
        if solid > 0.0:
            water = (area * np.maximum(velocity["cell/water"][:] + velocity["cell/alpha"][:] - 1.0, 0.0)).sum()
            largest = max(largest, water / solid)
    return largest
for label in sorted(os.listdir(sys.argv[1])):
    if not os.path.isdir(os.path.join(sys.argv[1], label)): continue
    rho = float(label)
    t, x, y, v = (column(label, "solid", n) for n in ("t [s]", "x0 [m]", "y0 [m]", "v0 [m/s]"))
    water, imbalance = inside(label), column(label, "coupler", "imbalance").max()
    made, drift = abs(column(label, "fluid", "water made [m2]")).max() / 0.08, abs(x - 0.2).max()
    report = "%g kg/m3: lowest %.4f, last %.4f m, fastest %.3f m/s, drift %.4f m, inside %.1e, water made %.1e, imbalance %.1e, %.2f iterations" % (
        rho, y.min(), y[-1], abs(v).max(), drift, water, made, imbalance, column(label, "coupler", "iterations").mean())
    if len(sys.argv) > 2: print(report)
    assert t[-1] > 0.399, report
    assert water < 1e-6 and made < 1e-12 and imbalance < 1e-10, report
    assert abs(v).max() < 1.1 * np.sqrt(2.0 * G * 0.25), report  # not faster than it fell from its centre to the floor
    assert drift < HALF, report
    if rho < 1000.0:
        # on its way out of the water, or where it floats
        assert y.min() < LEVEL + 0.8 * HALF and y.min() > HALF and y[-1] > LEVEL - HALF, report
    else:
        assert y.min() < 2.0 * HALF and y.min() > 0.8 * HALF, report
E2
