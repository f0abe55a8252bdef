#!/usr/bin/env bash
# Rigid discs touch as circles: they roll, at any angle, with 2/3 of the slope's acceleration (their moment of inertia is M R^2/2); two that strike each other at an angle keep momentum,
# angular momentum and energy; a column of discs, corner on corner, stands; ranks agree.  Usage: discs.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: discs
gravity: [0.0, 0.0]
time: {end: 1.0, dt_max: 0.01}
solid:
  materials:
    stone: {density: 2000.0, law: rigid, penalty: 1.0e8, friction: 0.5, contact_damping: 0.3}
    ice: {density: 2000.0, law: rigid, penalty: 1.0e6}
output: {folder: out/discs, every: 1.0, checkpoint: 0}
E2
disc='shape: disc, radius: 0.1, size: 0.03, material: stone'
walls='solid.walls={lower: [0, 0], upper: [9, 9]}'
for degrees in 0.5 5; do
  gravity=$("$python" -c "from math import *; a = radians($degrees); print('[%.17g, %.17g]' % (9.81*sin(a), -9.81*cos(a)))")
  alone "wall_$degrees" "$scratch/case.yaml" --set "gravity=$gravity" --set "$walls" --set "solid.bodies=[{$disc, centre: [0.2, 0.1]}]"
  alone "block_$degrees" "$scratch/case.yaml" --set "gravity=$gravity" --set \
    "solid.bodies=[{$disc, centre: [0.2, 0.1]}, {shape: rectangle, centre: [1, -0.05], width: 2, height: 0.1, size: 0.1, material: stone, fixed: true}]"
done
struck="{shape: disc, radius: 0.1, size: 0.03, material: ice, centre: [0, 0], velocity: [1, 0], angular_velocity: 3}, {shape: disc, radius: 0.15, size: 0.05, material: ice, centre: [0.35, 0.11]}"
for ranks in 1 2 3; do
  alone "struck_$ranks" "$scratch/case.yaml" --set time.end=0.3 --set "solid.bodies=[$struck]" --ranks "1:1:$ranks"
done
alone column "$scratch/case.yaml" --set 'gravity=[0, -9.81]' --set "$walls" --set "solid.bodies=[{$disc, centre: [1, 0.1], repeat: {n: [1, 5], step: [0, 0.2]}}]" --set time.end=0.3
"$python" - "$scratch" <<'E2'
from math import hypot, radians, sin
from results import column
for degrees in (0.5, 5):
    for place in ("wall", "block"):
        label = "%s_%g" % (place, degrees)
        speed = column(label, "solid", "u0 [m/s]")[-1]/(2/3*9.81*sin(radians(degrees)))
        assert abs(speed - 1) < 5e-3, "%s: %g of the speed of a disc that rolls" % (label, speed)
def at(label, name, time):
    return column(label, "solid", name)[time]
def momenta(time, label="struck_1"):
    sums = [0, 0, 0, 0]
    for b in (0, 1):
        x, y, u, v, w, m = (at(label, n % b, time) for n in ("x%d [m]", "y%d [m]", "u%d [m/s]", "v%d [m/s]", "omega%d [rad/s]", "mass%d [kg/m]"))
        inertia = 0.5*m*(0.1, 0.15)[b]**2
        for k, add in enumerate((m*u, m*v, m*(x*v - y*u) + inertia*w, 0.5*m*(u*u + v*v) + 0.5*inertia*w*w)):
            sums[k] += add
    return sums
before, after = momenta(0), momenta(-1)
assert hypot(at("struck_1", "u1 [m/s]", -1), at("struck_1", "v1 [m/s]", -1)) > 0.3, "they have not struck"
assert max(abs(a - b) for a, b in zip(before[:3], after)) < 1e-9*before[0], "momenta %s, %s before" % (after[:3], before[:3])
assert abs(after[3]/before[3] - 1) < 1e-3, "energy %g J/m, %g before" % (after[3], before[3])
assert abs(at("struck_1", "omega0 [rad/s]", -1) - 3) < 1e-9 and abs(at("struck_1", "omega1 [rad/s]", -1)) < 1e-9, "smooth discs have no moment on each other"
for ranks in (2, 3):
    for name in ("u0 [m/s]", "v1 [m/s]", "x1 [m]"):
        one, more = at("struck_1", name, -1), at("struck_%d" % ranks, name, -1)
        assert abs(one - more) < 1e-9, "%s on %d ranks: %.12g, %.12g on one" % (name, ranks, more, one)
for b in range(5):
    assert abs(at("column", "x%d [m]" % b, -1) - 1) < 1e-6 and abs(at("column", "y%d [m]" % b, -1) - 0.1 - 0.2*b) < 1e-3, "disc %d of the column at (%g, %g)" % (
        b, at("column", "x%d [m]" % b, -1), at("column", "y%d [m]" % b, -1))
E2
