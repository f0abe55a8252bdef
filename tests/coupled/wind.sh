#!/usr/bin/env bash
# A cylinder in a channel (Schaefer and Turek 2D-1, D/le = 12.5) that is free to move, of 10 000 times the fluid's density: it has the drag of
# a fixed one, with any steps; of 1e9 times it the run goes on, too.  Usage: wind.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/channel.yaml
coarse=(--set fluid.adapt.size_min=0.008 --set fluid.adapt.velocity_error=0.0024 --set time.end=1.2)
free=(--set solid.materials.steel.density=1e4 --set solid.materials.steel.youngs_modulus=1e8 --set 'solid.bodies[0].fixed=false')
must fixed 1:1:1 "${coarse[@]}"
must free 1:1:1 "${coarse[@]}" "${free[@]}"
must heaviest 2:1:1 "${coarse[@]}" "${free[@]}" --set solid.materials.steel.density=1e9 --set solid.materials.steel.youngs_modulus=1e13 --set time.end=0.2
must short 1:1:1 "${coarse[@]}" "${free[@]}" --set time.dt_max=0.004
"$python" - "$scratch" <<'E2'
from results import rows
def drag(label):
    force = [r["fx0 [N/m]"] for r in rows(label, "solid") if r["t [s]"] > 0.8]
    return 500.0 * sum(force) / len(force)
fixed = drag("fixed")
for label in "free", "short":
    print("%s: drag %.4f, fixed %.4f" % (label, drag(label), fixed))
    assert abs(drag(label) / fixed - 1.0) < 0.015, "%s: the drag is %.4f, that of a fixed cylinder %.4f" % (label, drag(label), fixed)
E2
