#!/usr/bin/env bash
# What substeps of changing length must not do: a rubber ball does not rise higher than it fell from, a bar that is let go keeps its energy; a slit does not
# close through itself; coordinates of maps do not turn a body or lift it off its floor; a step of more substeps than can be counted is refused.
# Usage: substeps.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: substeps
gravity: [0.0, -9.81]
time: {end: 4.0, dt_max: 0.005}
solid:
  walls: {lower: [-10, 0], upper: [10, 10]}
  materials:
    rubber: {density: 1000.0, youngs_modulus: 1.0e5, poisson_ratio: 0.3}
    stone: {density: 2000.0, law: rigid, penalty: 1.0e7}
  bodies:
    - {shape: disc, centre: [0, 1.1], radius: 0.1, size: 0.02, material: rubber}
output: {folder: out/substeps, every: 10, checkpoint: 0}
E2
alone ball "$scratch/case.yaml"
alone bar "$scratch/case.yaml" --set 'gravity=[0, 0]' --set time.end=1 --set time.dt_max=0.01 --set solid.materials.rubber.youngs_modulus=1e6 \
  --set 'solid.bodies=[{shape: rectangle, centre: [0, 5], width: 0.2, height: 0.05, size: 0.05, material: rubber, stretch: [1.5, 0.8]}]'
# the mouth of a slit of 4 mm between two arms of 1 m is pressed together, with steps in which they move much farther
slit='corners: [[0, -0.1], [1, -0.1], [1, -0.002], [0.1, 0], [1, 0.002], [1, 0.1], [0, 0.1]], sides: [below, end, slit, slit, end, above, left], size: 0.05'
alone slit "$scratch/case.yaml" --set 'gravity=[0, 0]' --set time.end=0.4 --set time.dt_max=0.1 --set solid.materials.rubber.youngs_modulus=1e7 --set 'solid.walls={lower: [-1, -1], upper: [2, 1]}' \
  --set "solid.bodies=[{shape: polygon, $slit, material: rubber, fixed: [left], loads: [{boundary: above, pressure: 1000}, {boundary: below, pressure: 1000}]}]" \
  --set 'solid.probes=[{name: upper, point: [0.995, 0.0022]}, {name: lower, point: [0.995, -0.0022]}]'
alone map "$scratch/case.yaml" --set time.end=1 --set time.dt_max=0.001 --set 'gravity=[0, 0]' --set 'solid.walls={lower: [0, 0], upper: [1e7, 1e7]}' \
  --set 'solid.bodies=[{shape: rectangle, centre: [5.0e5, 4.0e6], width: 0.02, height: 0.02, size: 0.01, material: stone, velocity: [10, -7]}]'
alone floor "$scratch/case.yaml" --set time.end=0.01 --set 'solid.walls={lower: [-1, 0.8], upper: [1, 10]}' \
  --set 'solid.bodies=[{shape: rectangle, centre: [0, 0.825], width: 0.3, height: 0.05, size: 0.05, material: stone}]'
! run_alone micro "$scratch/case.yaml" --set time.end=10 --set time.dt_max=5 --set solid.materials.rubber.youngs_modulus=5e10 \
  --set 'solid.bodies=[{shape: rectangle, centre: [0, 5], width: 2.0e-5, height: 1.0e-5, size: 5.0e-6, material: rubber}]' || { echo "a step of 1e10 substeps is accepted"; exit 1; }
grep -q "a step of 5 s would take .*e+10 substeps" "$scratch/micro.log" || { cat "$scratch/micro.log"; exit 1; }
"$python" - "$scratch" <<'E2'
from results import column
def energy(label, weight):
    names = ("kinetic0 [J/m]", "strain0 [J/m]", "y0 [m]")
    return [k + s + weight * y for k, s, y in zip(*(column(label, "solid", name) for name in names))]
mass = column("ball", "solid", "mass0 [kg/m]")[-1]
ball, bar = energy("ball", 9.81 * mass), energy("bar", 0.0)
report = "ball: %.4g J/m at first, %.4g at most; bar: %.4g, %.4g" % (ball[0], max(ball), bar[0], max(bar))
print(report)
assert max(ball) < 1.1 * ball[0] and max(bar) < 1.1 * bar[0], report  # 3.7 and 10 times, when lengths went up and down with the limit
gap = min(a - b + 0.0044 for a, b in zip(column("slit", "solid_probes", "upper_y [m]"), column("slit", "solid_probes", "lower_y [m]")))
assert gap > -0.002, "the arms of the slit pass through each other by %g m" % -gap
slit = energy("slit", 0.0)
work = sum(column("slit", "solid", "reaction work [J/m]"))
assert slit[-1] < 1.05 * work + 1e-3, "slit: energy %g J/m of work %g" % (slit[-1], work)
spin = column("map", "solid", "omega0 [rad/s]")[-1]
assert abs(spin) < 1e-4, "a body far from the origin spins up to %g rad/s" % spin
E2
