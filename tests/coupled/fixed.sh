#!/usr/bin/env bash
# Water that strikes a block that does not move keeps its volume, and no element holds more than its area: what moves the phases is the
# velocity that the projection has made free of divergence.  A wall that holds back water bears its pressure, and nothing passes.  A caisson at
# the floor, on it or nearer than an element, bears the weight of the water that it displaces, above the water, too, and still water stays still.
# What moves as prescribed has its momentum from the equations as solved: a closed pipe half full of water that is shaken.
# Usage: fixed.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/fixed.yaml
must one 1:1:1
"$python" - "$scratch" <<'E2'
import numpy as np
from results import snapshots
WATER, BLOCK = 0.04, 0.0036
covered = 0.0
for key, x, area, velocity in snapshots("one"):
    water, solid = velocity["cell/water"][:], velocity["cell/alpha"][:]
    made, inside = abs((area * water).sum() / WATER - 1.0), (area * np.maximum(water + solid - 1.0, 0.0)).sum() / BLOCK
    report = "%s: water made %.1e of it, inside %.1e of the block, fractions %.1e to 1 %+.1e" % (key, made, inside, water.min(), water.max() - 1.0)
    assert made < 1e-8 and inside < 1e-8 and water.min() > -1e-8 and water.max() < 1.0 + 1e-8, report
    wet = water[x[:, :, 0].mean(1) > 0.3]
    covered = max(covered, wet.max())
assert covered > 0.9, "the water has not come to the block"
E2
moves=(--set 'solid.bodies[0]={shape: ring, centre: [0.3, 0.2], outer_radius: 0.12, inner_radius: 0.09, size: 0.015, material: square, prescribed: [{velocity: [0.5, 0.0], period: 0.8}]}'
  --set 'fluid.regions=[{phase: air}, {phase: water, centre: [0.3, 0.2], radius: 0.09}, {phase: air, lower: [0.0, 0.2], upper: [0.6, 0.4]}]')
for ranks in 1:1:1 2:1:1; do must "moves ${ranks//:/-}" $ranks "${moves[@]}" --set time.end=0.1; done
"$python" - "$scratch" <<'E2'
from results import column
for label in "one", "moves 1-1-1", "moves 2-1-1":
    defect, iterations = (max(column(label, "fluid", name)) for name in ("momentum defect", "momentum iterations"))
    # the default tolerance, 1e-6 of the velocity, leaves as much of the momentum in the fluid, in the solid a thousand times that
    assert defect < 3e-6 and iterations < 20, "%s: momentum defect %.1e, %d iterations" % (label, defect, iterations)
E2
case=$here/dam.yaml
must "dam 1-1-1" 1:1:1
must "dam 2-1-2" 2:1:2 --set time.end=0.35
"$python" - "$scratch" <<'E2'
import numpy as np
from results import rows, snapshots
for ranks in "1-1-1", "2-1-2":
    force = np.mean([row["fx0 [N/m]"] for row in rows("dam " + ranks, "solid") if row["t [s]"] > 0.25])
    *_, (_, corner, area, velocity) = snapshots("dam " + ranks)
    passed = (area * velocity["cell/water"][:])[corner[:, :, 0].mean(1) > 0.55].sum() / 0.25
    report = "%s: force %.1f of %.1f N/m, %.1e of the water behind the wall" % (ranks, force, 500.0 * 9.81 * 0.25, passed)
    print(report)
    assert abs(force / (500.0 * 9.81 * 0.25) - 1.0) < 0.01 and passed < 1e-9, report
E2
case=$here/floor.yaml
caisson() { # label ranks height_of_its_centre level [x [right end of the water]]
  must "$1" $2 --set time.end=0.1 --set time.dt_max=0.01 --set "solid.bodies[0]={shape: rectangle, centre: [${5:-0.503}, $3], width: 0.4, height: 0.1, size: 0.02, material: rock, fixed: true}" \
    --set "fluid.regions[1].upper=[${6:-3.0}, $4]"
}
caisson "above the floor" 1:1:1 0.055 0.25
caisson "on the floor" 1:1:1 0.05 0.25
caisson "above the water" 2:2:2 0.05 0.06
caisson "on the mesh's lines" 1:1:1 0.05 0.06 0.5
caisson "a sill" 1:1:1 0.05 0.06 0.503 0.5
"$python" - "$scratch" <<'E2'
from results import column
def last(label, file, name):
    return column(label, file, name)[-1]
for label, height, still in ("above the floor", 0.1, 1e-6), ("on the floor", 0.1, 1e-6), ("above the water", 0.06, 1e-3), ("on the mesh's lines", 0.06, 1e-6):
    expected = 1000.0 * 9.81 * 0.4 * height
    x, y = (last(label, "solid", "f%s0 [N/m]" % c) for c in "xy")
    energy = last(label, "fluid", "kinetic energy [J/m]")
    report = "%s: force %.2f, %.2f of %.2f N/m, kinetic energy %.1e J/m" % (label, x, y, expected, energy)
    print(report)
    assert abs(y / expected - 1.0) < 5e-3 and abs(x / expected) < 5e-3 and energy < still, report
x, y = (last("a sill", "solid", "f%s0 [N/m]" % c) / (1000.0 * 9.81 * 0.06 * 0.5) for c in "xy")
print("a sill: force %.4f, uplift %.4f of the expected" % (x / 0.06, y / 0.4))
assert abs(x / 0.06 - 1.0) < 1e-2 and abs(y / 0.4 - 1.0) < 1e-2, "a sill: force %g, uplift %g of the expected" % (x / 0.06, y / 0.4)
E2
