#!/usr/bin/env bash
# Prescribed motions of a case file: a rotation in rows, beside a table of velocities, too, copies of a body that turn about pivots of their own, a piston that starts at once, sides that
# share a corner with each other and with a fixed one; their work is the body's energy.  Usage: motions.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run_alone.sh"
cat >"$scratch/case.yaml" <<'E2'
case: motions
gravity: [0.0, 0.0]
time: {end: 0.05, dt_max: 0.01}
solid:
  materials:
    rubber: {density: 2000.0, youngs_modulus: 1.0e7, poisson_ratio: 0.25}
    stone: {density: 2000.0, law: rigid, penalty: 1.0e7}
output: {folder: out/motions, every: 1.0, checkpoint: 0}
E2
bar='{shape: rectangle, centre: [0, 0], width: 0.4, height: 0.1, size: 0.05, material: rubber, prescribed: '
alone turning "$scratch/case.yaml" --set "solid.bodies=[$bar [{velocity: [0, 0], angular_velocity: [[0, 1], [1, 1]], pivot: [0, 0]}], repeat: {n: [2, 1], step: [1, 0]}}]"
# a heaving and pitching foil: both in rows
alone foil "$scratch/case.yaml" --set "solid.bodies=[$bar [{name: foil, table: [[0, 0, 0.5], [0.02, 0, 1], [0.05, 0, -0.5]], angular_velocity: [[0, 0], [0.04, 2]], pivot: [-0.1, 0]}]}]"
# rigid: it is set turning, about a pivot outside of it; and it is held in place against a moment
bar_of() { echo "solid.bodies=[{shape: rectangle, centre: [0, 0], width: 0.4, height: 0.1, size: 0.05, material: stone, $1}]"; }
alone spun "$scratch/case.yaml" --set "$(bar_of 'prescribed: [{name: spun, angular_velocity: [[0, 0], [1, 20]], pivot: [-0.3, 0]}]')"
alone held "$scratch/case.yaml" --set "$(bar_of 'prescribed: [{name: held, velocity: [0, 0]}], loads: [{boundary: right, traction: [0, 1000]}]')"
alone rail "$scratch/case.yaml" --set "$(bar_of 'prescribed: [{name: rail, velocity: [0, 0], component: x}], loads: [{boundary: right, traction: [0, 1000]}]')"
# a rigid block that is struck by a rigid piston, 50 m/s from 0.1 s on; a force that sets in at once likewise
block='{shape: rectangle, centre: [0.3, 0], width: 0.1, height: 0.3, size: 0.05, material: stone}'
piston='{shape: rectangle, centre: [0, 0], width: 0.1, height: 0.4, size: 0.05, material: stone, '
alone struck "$scratch/case.yaml" --set time.end=0.13 --set "solid.bodies=[$piston prescribed: [{table: [[0, 0, 0], [0.1, 0, 0], [0.100001, 50, 0]]}]}, $block]"
alone pushed "$scratch/case.yaml" --set time.end=0.13 --set "solid.bodies=[$piston loads: [{boundary: left, pressure: [[0, 0], [0.1, 0], [0.100001, 1.0e6]]}]}, $block]"
# two sides with a common corner, and a third one that holds what they move
alone corner "$scratch/case.yaml" --set "solid.bodies=[$bar [{name: hold, boundary: left, velocity: [0.001, 0]}, {name: floor, boundary: bottom, velocity: [0, 0], component: y}, {name: pull, boundary: top, velocity: [0, 0]}]}]"
alone fixed "$scratch/case.yaml" --set "solid.bodies=[$bar [{boundary: bottom, velocity: [0, -0.1]}], fixed: [left]}]" --set 'solid.probes=[{name: corner, point: [-0.2, -0.05]}]'
"$python" - "$scratch" <<'E2'
from math import cos, sin
from results import column
spins = [column("turning", "solid", "omega%d [rad/s]" % b)[-1] for b in (0, 1)]
ways = [column("turning", "solid", "%s%d [m]" % (c, b))[-1] - at for b, at in ((0, 0.0), (1, 1.0)) for c, at in (("x", at), ("y", 0.0))]
assert all(abs(w - 1.0) < 1e-3 for w in spins) and max(map(abs, ways)) < 1e-9, "turning: %s rad/s, moved by %s" % (spins, ways)
angle = 0.5 * 2.0 * 0.04 + 2.0 * 0.01
foil = [column("foil", "solid", key)[-1] for key in ("angle0 [rad]", "x0 [m]", "y0 [m]", "v0 [m/s]")]
wanted = [angle, -0.1 + 0.1 * cos(angle), 0.015 + 0.0075 + 0.1 * sin(angle), -0.5 + 2.0 * 0.1 * cos(angle)]
assert all(abs(f - w) < e for f, w, e in zip(foil, wanted, (1e-4, 1e-4, 1e-4, 0.05))), "foil: %s, expected %s" % (foil, wanted)
kinetic, omega = column("spun", "solid", "kinetic0 [J/m]"), column("spun", "solid", "omega0 [rad/s]")[-1]
work, moment = sum(column("spun", "solid", "reaction work [J/m]")[1:]), column("spun", "solid_probes", "spun_moment [N]")[-1]
power = column("spun", "solid_probes", "spun_power [W/m]")[-1]
wanted = 20.0 * 2.0 * kinetic[-1] / omega**2  # the moment of inertia times the angular acceleration
energy = kinetic[-1] - kinetic[0]
assert abs(work / energy - 1.0) < 1e-3, "spun: work %g J/m, energy %g" % (work, energy)
assert abs(moment / wanted - 1.0) < 0.01, "spun: moment %g N, expected %g" % (moment, wanted)
turning = 20.0 * (0.045 - 0.5 * column("spun", "solid", "dt_s [s]")[-1])  # velocities are those of the middle of substeps
assert abs(power / (moment * turning) - 1.0) < 1e-3, "spun: power %g W/m, expected %g" % (power, moment * turning)
moment = column("held", "solid_probes", "held_moment [N]")[-1]
assert abs(moment + 0.2 * 100.0) < 1e-6, "held: moment %g N, expected -20" % moment
moment = column("rail", "solid_probes", "rail_moment [N]")[-1]
assert abs(moment + 0.2 * 100.0) < 1e-6, "rail: moment %g N, expected -20" % moment
for label in ("struck", "pushed"):
    ahead = min(b - a for a, b in zip(column(label, "solid", "x0 [m]"), column(label, "solid", "x1 [m]")))
    assert ahead > 0.05, "%s: the block's centre is %g m from the piston's" % (label, ahead)
u = column("struck", "solid", "u1 [m/s]")[-1]
assert 95.0 < u < 105.0, "struck by 50 m/s the block flies at %g m/s" % u
energy = [a + b for a, b in zip(column("corner", "solid", "kinetic0 [J/m]"), column("corner", "solid", "strain0 [J/m]"))]
work = sum(column("corner", "solid", "reaction work [J/m]")[1:])
assert abs(work / (energy[-1] - energy[0]) - 1.0) < 1e-3, "corner: work %g J/m, energy %g" % (work, energy[-1] - energy[0])
corner = column("fixed", "solid_probes", "corner_v [m/s]")
assert max(map(abs, corner)) == 0.0, "a fixed corner moves"
E2
