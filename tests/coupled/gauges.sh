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
must moving 2:1:2 "${still[@]}" --set fluid.viscosity=0.1 --set 'solid.bodies[0].prescribed=[{boundary: boundary, velocity: [0.05, -0.05]}]'
must falling 1:1:1 "${falling[@]}"
must spread 2:2:2 "${falling[@]}"
must resumed 1:1:1 "${falling[@]}" --set time.end=0.05
must resumed 2:1:1 "${falling[@]}" --set resume=last
! run far 1:1:1 "${falling[@]}" --set 'fluid.probes[0].solid_point=[1.0, 1.05]' || { echo "a gauge inside of the disc is accepted"; exit 1; }
grep -q "error: .*disc.yaml: key 'fluid.probes\[0\].solid_point': expected a point of the solid's surface, (1, 1.05) is 0.07[0-9]* m away" "$scratch/far.log" ||
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
