#!/usr/bin/env bash
# Rigid bodies (solid/rigid.h) in a fluid and among phases move as stiff elastic ones: a disc that falls, on any ranks; a block that floats, rolls and drags
# on a mooring line.  They take ten substeps a step without contact, have no strain energy, and momentum is closed.  Usage: rigid.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
fall=(--set time.end=0.2 --set time.dt_max=0.01)
must disc_elastic 1:1:1 "${fall[@]}"
must disc_rigid 1:1:1 "${fall[@]}" --set solid.materials.disc.law=rigid
must disc_ranks 2:2:3 "${fall[@]}" --set solid.materials.disc.law=rigid
case=$here/floating.yaml
moored=(--set time.end=0.4 --set 'solid.springs=[{name: line, point: [0.25, 0.2], anchor: [0.1, 0.0], stiffness: 500.0, length: 0.22, acts: pull}]'
  --set 'solid.bodies=[{shape: rectangle, centre: [0.3, 0.2], width: 0.12, height: 0.06, angle: 0.1, size: 0.01, material: block}]')
# its lumped moment of inertia is 2 % too large with these elements
must moored_elastic 1:1:1 "${moored[@]}" --set solid.materials.block.youngs_modulus=2.0e7
must moored_rigid 1:1:1 "${moored[@]}" --set solid.materials.block.law=rigid
"$python" - "$scratch" <<'E2'
from results import column
def last(label, name): return column(label, "solid", name)[-1]
speed = [last("disc_" + label, "v0 [m/s]") for label in ("elastic", "rigid", "ranks")]
print("speeds of the disc", speed)
assert abs(speed[1] / speed[0] - 1) < 1e-3 and abs(speed[2] / speed[1] - 1) < 5e-3, "speeds of the disc: %s" % speed
assert set(column("disc_rigid", "solid", "substeps")) == {10}, "substeps: %s" % column("disc_rigid", "solid", "substeps")
for name, bound in ("x0 [m]", 2e-4), ("y0 [m]", 2e-4), ("angle0 [rad]", 4e-3):
    a, b = last("moored_elastic", name), last("moored_rigid", name)
    print(name, a, b)
    assert abs(a - b) < bound, "%s of an elastic and a rigid float: %g and %g" % (name, a, b)
assert abs(last("moored_rigid", "angle0 [rad]")) > 0.01, "the float does not roll"
for label in "disc_rigid", "disc_ranks", "moored_rigid":
    assert max(column(label, "coupler", "imbalance")) < 1e-10 and max(column(label, "solid", "strain0 [J/m]")) == 0.0, label
    for c in "x", "y":
        t = column(label, "solid", "t [s]")
        m = [column(label, "solid", k % c) for k in ("momentum_%s [N s/m]", "start_momentum_%s [N s/m]", "walls_%s [N s/m]", "reaction_%s [N s/m]", "load_%s [N/m]", "weight_%s [N/m]")]
        scale = max(abs(v) for v in m[0]) + 1e-3
        for k in range(1, len(t)):
            dt = t[k] - t[k - 1]
            error = m[0][k] - m[1][k] - m[2][k] - m[3][k] - dt * (m[4][k] + m[5][k])
            assert abs(error) < 1e-9 * scale, "%s: momentum %s off by %g" % (label, c, error)
E2
