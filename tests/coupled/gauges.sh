#!/usr/bin/env bash
# Pressure gauges on a disc follow it and have the pressure of the fluid before its face: hydrostatic where it is held, nearly so where it moves
# slowly, the same on any number of ranks where it falls and the mesh adapts, and without a seam after a checkpoint.  Usage: gauges.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
gauges=(--set 'fluid.probes=[{name: foot, solid_point: [1.0, 0.9756]}, {name: head, solid_point: [1.0, 1.2244]}, {name: wall, point: [0, 1]}]')
falling=("${gauges[@]}" --set fluid.adapt.size_min=0.03 --set fluid.adapt.size_max=0.25 --set fluid.adapt.velocity_error=0.01 --set fluid.adapt.every=4)
still=("${gauges[@]}" --set 'fluid.probes[0].distance=0.04' --set 'fluid.probes[1].distance=0.02')
must held 1:1:1 "${still[@]}" --set 'solid.bodies[0].fixed=true'
# on a block, the gauge's distance away from its foot is in that: the pressure is that between them
must "on a block" 1:1:1 "${still[@]}" --set 'solid.bodies[0].fixed=true' \
  --set 'solid.bodies[1]={shape: rectangle, centre: [1.0, 0.875], width: 0.4, height: 0.2, size: 0.05, material: disc, fixed: true}'
# the pressure on the sides of a block: its buoyancy, and the moment on the left one
line() { echo "{name: $1, solid_line: {from: [$2], to: [$3], points: 10}, distance: 0.03}"; }
must sides 2:2:1 --set time.end=0.05 --set 'solid.bodies=[{shape: rectangle, centre: [1.0, 1.0], width: 0.4, height: 0.2, size: 0.05, material: disc, fixed: true}]' \
  --set "fluid.probes=[$(line left '0.8, 0.9' '0.8, 1.1'), $(line right '1.2, 1.1' '1.2, 0.9'), $(line top '0.8, 1.1' '1.2, 1.1'), $(line base '1.2, 0.9' '0.8, 0.9'), {name: wall, point: [0, 1]}]"
must moving 2:1:2 "${still[@]}" --set fluid.viscosity=0.1 --set 'solid.bodies[0].prescribed=[{boundary: boundary, velocity: [0.05, -0.05]}]'
must falling 1:1:1 "${falling[@]}"
must spread 2:2:2 "${falling[@]}"
must resumed 1:1:1 "${falling[@]}" --set time.end=0.05
must resumed 2:1:1 "${falling[@]}" --set resume=last
! run far 1:1:1 "${falling[@]}" --set 'fluid.probes[0].solid_point=[1.0, 1.05]' || { echo "a gauge inside of the disc is accepted"; exit 1; }
grep -q "error: .*disc.yaml: key 'fluid.probes\[0\]': expected a point of the solid's surface, (1, 1.05) is 0.07[0-9]* m away" "$scratch/far.log" ||
  { cat "$scratch/far.log"; exit 1; }
[ ! -e "$scratch/far" ] || { echo "a case that is refused has made output"; exit 1; }

"$python" - "$scratch" <<'E2'
import results
WEIGHT = 9810.0  # rho g, N/m3
def rows(label):
    table = results.rows(label, "fluid_probes")
    assert [round(r["t [s]"], 9) for r in table] == [round(0.01 * k, 9) for k in range(1, 11)], "%s: %s" % (label, [r["t [s]"] for r in table])
    return table
def above(r, name, distance):
    """The pressure at the gauge above the hydrostatic one, which is that of the wall at y = 1 m."""
    y = r[name + "_y [m]"] + (distance if name == "head" else -distance)
    return r[name + "_p [Pa]"] - r["wall_p [Pa]"] - WEIGHT * (1.0 - y)
for r in rows("held"):
    assert abs(above(r, "foot", 0.04)) < 0.01 and abs(above(r, "head", 0.02)) < 0.01, "held: %s" % r
for r in rows("on a block"):
    assert abs(above(r, "foot", 0.0)) < 0.1 * WEIGHT * 0.04, "on a block: %s" % r
r = results.rows("sides", "fluid_probes")[-1]
level = r["wall_p [Pa]"]  # of the middle
force = {side: [r["%s_force_%s [N/m]" % (side, c)] for c in "xy"] for side in ("left", "right", "top", "base")}
report = "sides: %s" % force
assert abs(force["left"][0] - 0.2 * level) < 1.0 and abs(force["right"][0] + 0.2 * level) < 1.0, report
assert abs(force["base"][1] - 0.4 * (level + 0.1 * WEIGHT)) < 4.0 and abs(force["top"][1] + 0.4 * (level - 0.1 * WEIGHT)) < 4.0, report
assert max(abs(force[side][c]) for side, c in (("left", 1), ("right", 1), ("top", 0), ("base", 0))) < 1e-9, report
# about its foot: -int p y dy
moment = -(0.2 ** 2 / 2.0 * (level + 0.1 * WEIGHT) - WEIGHT * 0.2 ** 3 / 3.0)
assert abs(r["left_moment [N]"] - moment) < 0.3, "left: moment %g, not %g" % (r["left_moment [N]"], moment)
moving = rows("moving")
for name, distance in (("foot", 0.04), ("head", 0.02)):
    start = moving[0][name + "_y [m]"] + 0.0005
    for r in moving:
        t = r["t [s]"]
        assert abs(r[name + "_x [m]"] - 1.0 - 0.05 * t) < 1e-9 and abs(r[name + "_y [m]"] - start + 0.05 * t) < 1e-9, "%s at %g s: %s" % (name, t, r)
    # 2450 Pa across the disc; that it begins at once gives a pressure which decays within steps, and as the gauge moves through elements of 0.04 m
    # it reads 44 to 56 Pa at the head until t = 0.3 s, whatever the disc's inside does
    assert abs(above(r, name, distance)) < 0.03 * 2450, "%s at %g s: %g Pa above hydrostatic" % (name, t, above(r, name, distance))
for label in ("spread", "resumed"):
    for r, s in zip(rows("falling"), rows(label)):
        for name in ("foot", "head"):
            assert abs(r[name + "_y [m]"] - s[name + "_y [m]"]) < 1e-5
            p, q = above(r, name, 0.03), above(s, name, 0.03)
            assert abs(p) > 200.0 and abs(p - q) < 0.02 * abs(p), "%s, %s at %g s: %g Pa, %g" % (label, name, r["t [s]"], q, p)
E2
